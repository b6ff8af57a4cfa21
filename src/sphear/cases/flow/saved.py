"""What a run needs to go on, in a file."""

from __future__ import annotations

from pathlib import Path
from tokenize import TokenError
from typing import Any
from zipfile import BadZipFile
from zlib import error as CompressionError

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from sphear.errors import SphearError

Array = np.ndarray[Any, Any]

UNREADABLE = (  # what damage makes NumPy and what is below it raise
    OSError, EOFError, ValueError, LookupError, TypeError, RuntimeError, SyntaxError, BadZipFile, TokenError,
    CompressionError,
)  # fmt: skip


class About(BaseModel):
    """What is saved beside the state of the flow.

    Attributes:
        case: what is computed.
        settings: how.
        history: a row for each output.
        seconds: spent in the time loop.
    """

    model_config = ConfigDict(ser_json_inf_nan="constants")

    case: str
    settings: dict[str, Any]
    history: list[dict[str, int | float]]
    seconds: float = Field(ge=0, allow_inf_nan=False)

    @property
    def reached(self) -> tuple[float, int]:
        """The time, in the unit of the case, and the steps."""
        return (self.history[-1]["time"], int(self.history[-1]["steps"])) if self.history else (0.0, 0)


def write(path: Path, about: About, state: dict[str, Array]) -> None:
    """Write an `.npz` of NumPy; a run that is killed meanwhile leaves the file before."""
    temporary = path.with_suffix(".tmp")
    with temporary.open("wb") as file:
        np.savez(file, allow_pickle=False, about=np.array(about.model_dump_json()), **state)
    temporary.replace(path)


def read(path: Path) -> tuple[About, dict[str, Array]]:
    """What was written.

    Raises:
        SphearError: the file cannot be read, or is damaged.
    """
    nothing = SphearError(f"there is no saved run in {path} that could be gone on with")
    try:
        with path.open("rb") as raw, np.load(raw, allow_pickle=False) as file:
            state = dict(file)
        about = About.model_validate_json(str(state.pop("about")))
        _ = about.reached
    except (*UNREADABLE, ValidationError):
        raise nothing from None
    for values in state.values():
        if values.dtype.kind not in "fb" or not np.isfinite(values).all():
            raise nothing
    return about, state
