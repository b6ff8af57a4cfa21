"""A flow that repeats."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Periodic:
    """The flow repeats along an axis, "x" or "y", with the extent of the region as its period.

    Example:
        >>> import sphear
        >>> boundaries = {"x": sphear.Periodic(), "upper": sphear.NoSlip(velocity=(1.0, 0.0))}
    """
