"""Checks of the parameters of exact solutions."""

from __future__ import annotations

import math

from sphear.errors import SphearError


def check_positive(**parameters: float) -> None:
    """Refuse parameters that are not positive, finite numbers.

    Raises:
        SphearError: one is not; it is called by its name.
    """
    for name, value in parameters.items():
        if not 0 < value < math.inf:
            raise SphearError(f"the {name.replace('_', ' ')} must be positive, not {value}")


def check_finite(**parameters: float) -> None:
    """Refuse parameters that are not finite numbers.

    Raises:
        SphearError: one is not; it is called by its name.
    """
    for name, value in parameters.items():
        if not math.isfinite(value):
            raise SphearError(f"the {name.replace('_', ' ')} must be finite, not {value}")


def check_time(time: float) -> None:
    """Refuse a time that is not from 0 to infinity.

    Raises:
        SphearError: it is negative, or no number.
    """
    if not time >= 0:
        raise SphearError(f"the time must not be negative, it is {time}")
