"""Saved states: the file that a run goes on from, and the one before it; whatever happens, one of them is whole."""

from __future__ import annotations

import hashlib
from pathlib import Path
from tokenize import TokenError
from typing import Any
from zipfile import BadZipFile
from zlib import error as CompressionError

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from sphear.errors import SphearError
from sphear.whole import whole

Array = np.ndarray[Any, Any]

UNREADABLE = (  # what damage makes NumPy and what is below it raise
    OSError, EOFError, ValueError, LookupError, TypeError, RuntimeError, SyntaxError, BadZipFile, TokenError,
    CompressionError, AttributeError, MemoryError,
)  # fmt: skip

FREE = ("until", "max_steps", "threads", "force")  # settings that do not change what is computed


class About(BaseModel):
    """The record that is saved beside the state of the flow.

    Attributes:
        case: what is computed.
        settings: by name, as JSON.
        history: a row for each output.
        seconds: spent in the time loop.
        end: of a run that has ended; empty while it goes on.
    """

    model_config = ConfigDict(ser_json_inf_nan="constants")

    case: str
    settings: dict[str, Any]
    history: list[dict[str, int | float]]
    seconds: float = Field(ge=0, allow_inf_nan=False)
    end: str = ""


def write(path: Path, about: About, state: dict[str, Array]) -> None:
    """Write an `.npz` of NumPy; the file before is kept beside it.

    Raises:
        OSError: it cannot be written; the file before is what it was.
    """
    try:
        _write(path, about, state)
    except OSError:
        if not earlier(path).exists():
            raise
        earlier(path).unlink()  # a full disk has room again, and `path` is whole
        _write(path, about, state)


def _write(path: Path, about: About, state: dict[str, Array]) -> None:
    members = {"about": np.array(about.model_dump_json()), **state}
    with whole(path, before=earlier(path)) as partial, partial.open("wb") as file:
        np.savez(file, allow_pickle=False, checksum=np.array(checksum(members)), **members)


def earlier(path: Path) -> Path:
    """The path of the state before the one in a file."""
    return path.with_name(f"{path.stem}-before{path.suffix}")


def forget(path: Path) -> None:
    """Remove a state and the one before it."""
    earlier(path).unlink(missing_ok=True)
    path.unlink(missing_ok=True)


def checksum(members: dict[str, Array]) -> str:
    """A hash of names, kinds, shapes and bytes."""
    found = hashlib.blake2b(digest_size=16)
    for name in sorted(members):
        values = np.ascontiguousarray(members[name])
        found.update(f"{name} {values.dtype.str} {np.shape(members[name])} ".encode())
        found.update(values.reshape(-1).view(np.uint8).data)
    return found.hexdigest()


def read(path: Path) -> tuple[About, dict[str, Array]]:
    """Read a state and its record.

    Raises:
        SphearError: the file cannot be read, or is damaged.
    """
    nothing = SphearError(f"there is no saved run in {path} that could be gone on with")
    try:
        with path.open("rb") as raw, np.load(raw, allow_pickle=False) as file:
            state = dict(file)
        said = str(state.pop("checksum"))
        if said != checksum(state):
            raise nothing
        about = About.model_validate_json(str(state.pop("about")))
        if about.history:
            _ = about.history[-1]["time"], about.history[-1]["steps"]
        clock = state["clock"]
        _ = float(clock[0]), int(clock[1])
    except (*UNREADABLE, ValidationError):
        raise nothing from None
    for values in state.values():
        if values.dtype.kind not in "fb" or not np.isfinite(values).all():
            raise nothing
    return about, state


def check(path: Path, about: About, case: str, settings: dict[str, Any], reached: dict[str, float]) -> None:
    """Refuse what was saved of another run.

    Args:
        path: where it is.
        about: what was saved.
        case: of the run.
        settings: of the run, as JSON.
        reached: what settings that end a run must not be less than.

    Raises:
        SphearError: it is of another case, has other settings, or is beyond the end.
    """
    was = about.settings
    changed = [key for key, value in settings.items() if was.get(key) != value and key not in FREE]
    if about.case != case:
        raise SphearError(f"the saved run in {path} is of {about.case}, not of {case}")
    if changed:
        key = changed[0]
        raise SphearError(f"the saved run in {path} has {key} = {was.get(key)}, not {settings[key]}")
    for name, there in reached.items():
        if settings[name] is not None and there > settings[name]:
            raise SphearError(f"the saved run in {path} is already at {there:g}, beyond {name} = {settings[name]:g}")


def recover(path: Path) -> str | None:
    """Put the state before in the place of one that is damaged or missing; what is said of it, else None."""
    try:
        read(path)
    except SphearError:
        damaged = path.exists()
        try:
            read(earlier(path))
        except SphearError:
            return None
        earlier(path).replace(path)
        return f"the state in {path} was {'damaged' if damaged else 'missing'}: the one before it is taken"
    return None
