"""Settings that a user gives, checked: the first that is wrong in one sentence."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from math import isfinite, isnan, nan
from typing import Any

import numpy as np

from sphear.errors import SphearError, quoted


@contextmanager
def checked(what: str = "") -> Iterator[None]:
    """Turn what Pydantic says of the first wrong setting into a SphearError, with `what` before the setting's name.

    What a model itself says of settings that contradict each other stays as it is.
    """
    from pydantic import ValidationError

    try:
        yield
    except ValidationError as error:
        first = error.errors()[0]
        if isinstance(own := first.get("ctx", {}).get("error"), SphearError):
            raise own from None
        name = str(first["loc"][0]) if what else str(first["loc"][0]).replace("_", "-")
        if first["type"] == "extra_forbidden":
            raise SphearError(f"there is no setting named {quoted(name)}") from None
        raise SphearError(f"{what}{name} {first['msg'].removeprefix('Input ')}, not {quoted(first['input'])}") from None


def number(value: object, finite: bool = True) -> float:
    """A real number as a float, finite unless said so; NaN for anything else, as text, arrays and truth values are."""
    if not isinstance(value, int | float | np.integer | np.floating | np.ndarray) or isinstance(value, bool):
        return nan
    if isinstance(value, np.ndarray) and (value.ndim or value.dtype.kind not in "iuf" or _masked(value)):
        return nan
    try:
        found = float(value)
    except OverflowError:
        return nan
    return found if isfinite(found) or not finite else nan


def numbers(value: Any, finite: bool = True) -> tuple[float, ...]:
    """Several real numbers as a tuple of floats, finite unless said so; an empty one for anything else."""
    if isinstance(value, str | bytes | dict | set) or not hasattr(value, "__len__") or np.ndim(value) == 0:
        return ()
    found = tuple(number(each, finite) for each in value)
    return () if any(map(isnan, found)) else found


def real_array(value: Any) -> np.ndarray[Any, Any] | None:
    """An array of real numbers; None for what is not, as masked values, text, truth values and complex numbers."""
    try:
        found = np.asarray(value)
    except (TypeError, ValueError):  # of rows of different length
        return None
    return found if found.dtype.kind in "iuf" and not _masked(value) else None


def _masked(value: Any) -> bool:
    return isinstance(value, np.ma.MaskedArray) and bool(np.ma.getmaskarray(value).any())
