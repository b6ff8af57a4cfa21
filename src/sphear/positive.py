"""Positive numbers, of whatever type Python and NumPy have for them."""

from __future__ import annotations

from math import inf
from typing import Any


def is_positive(value: Any) -> bool:
    """True if a value is a positive finite number; text, truth values and numbers beyond floats are none."""
    if isinstance(value, str | bytes | bool):
        return False
    try:
        return 0.0 < float(value) < inf
    except (TypeError, ValueError, OverflowError):
        return False
