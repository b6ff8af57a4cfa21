"""Numbers that the environment may change."""

from __future__ import annotations

import math
import os

from sphear.errors import SphearError


def seconds(name: str, usual: float) -> float:
    """The seconds that a variable of the environment says; what is usual where it is not set.

    Raises:
        SphearError: it says no number, or a negative one.
    """
    text = os.environ.get(name, "")
    if not text.strip():
        return usual
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not value >= 0:
        raise SphearError(f"the environment variable {name} must be a number of seconds, not {text[:80]!r}")
    return value
