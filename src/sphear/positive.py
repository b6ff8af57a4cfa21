"""Finite numbers, of whatever type Python and NumPy have for them."""

from __future__ import annotations

from math import inf, nan
from typing import Any


def as_number(value: Any) -> float:
    """A finite number as a float; NaN for text, truth values and numbers beyond floats."""
    if isinstance(value, str | bytes | bool):
        return nan
    try:
        found = float(value)
    except (TypeError, ValueError, OverflowError):
        return nan
    return found if abs(found) < inf else nan


def is_positive(value: Any) -> bool:
    """True if a value is a positive finite number; text, truth values and numbers beyond floats are none."""
    return as_number(value) > 0.0
