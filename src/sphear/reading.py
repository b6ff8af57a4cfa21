"""Arrays that a user gives, read: real numbers as they are; what would lose its meaning is refused."""

from __future__ import annotations

from decimal import Decimal
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from sphear.errors import SphearError

Array = np.ndarray[Any, Any]


def real_numbers(values: ArrayLike, name: str) -> Array:
    """An array of float64, of the shape of what is given.

    Args:
        values: an array, nested sequences or anything that NumPy makes an array of.
        name: of the argument, for the error.

    Raises:
        SphearError: masked values, units, the order of an index, complex numbers, dates, text: whatever a conversion to
            plain numbers would drop without a word; and what is no number at all.
    """
    if type(values) is np.ndarray and values.dtype == np.float64:
        return np.ascontiguousarray(values)
    if (lost := _lost(values)) is not None:
        raise SphearError(f"{name} must be plain numbers, but {lost}")
    try:
        array = np.asarray(values)
        if array.dtype.kind == "O":
            if not all(isinstance(x, Real | Decimal) for x in array.flat):
                raise TypeError
        elif array.dtype.kind not in "biuf":
            raise TypeError
        with np.errstate(over="ignore"):  # of longer floats than 64 bits: an infinity is refused as such
            return np.ascontiguousarray(array, dtype=np.float64)
    except OverflowError:
        raise SphearError(f"{name} holds a number that is too large for floating point") from None
    except (TypeError, ValueError, RuntimeError):
        raise SphearError(
            f"{name} must be an array of real numbers, which this {type(values).__name__} is not"
        ) from None


def positive_number(value: Any, name: str) -> float:
    """One positive, finite number; a SphearError for anything else."""
    try:
        plain = not isinstance(value, str | bytes | np.ma.MaskedArray) and _lost(value) is None
        number = float(value) if plain else np.nan
    except (TypeError, ValueError, OverflowError):
        number = np.nan
    if not 0 < number < np.inf:
        raise SphearError(f"{name} must be a positive number, not {value!r}")
    return number


def _lost(values: Any) -> str | None:
    """The meaning that a conversion to an array would drop, in words; None if nothing."""
    if isinstance(values, np.ma.MaskedArray):
        masked = int(np.ma.getmaskarray(values).sum())
        return f"{masked} of its {values.size} values are masked: leave these particles out" if masked else None
    if isinstance(values, list | tuple):
        # one look at each type of elements; rows are looked into
        kinds = set(map(type, values))
        if kinds <= {float, int, bool}:
            return None
        return next((lost for item in values if (lost := _lost(item)) is not None), None)
    if isinstance(values, float | int | np.generic) or type(values) is np.ndarray:
        return None
    for attribute in ("units", "unit"):
        if (unit := getattr(values, attribute, None)) is not None and not callable(unit):
            return f"it has the unit {str(unit)[:40]!r}, which results would not have: give its values in one system"
    if hasattr(values, "iloc") and not _counts(values.index):
        return "it has an index, whose order would not be followed: give .to_numpy(), in the order of the positions"
    return None


def _counts(index: Any) -> bool:
    """True if an index only counts 0, 1, 2, ..."""
    return bool(np.array_equal(np.asarray(index), np.arange(len(index))))
