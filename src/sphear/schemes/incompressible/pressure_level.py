"""The level of the pressure between walls, which its equation leaves open and some gradients tell from another."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

Array = np.ndarray[Any, Any]
Level = Literal["free", "corner", "least", "cut"]


def levelled(pressures: Array, level: Level, positions: Array) -> Array:
    """The pressures (N + W,) at a level; those of the fluid at `positions` (N, d) come first.

    Args:
        pressures: of the fluid and behind walls, up to a constant.
        level: "free", as they were solved for; zero at the particle nearest to the lower "corner"; raised until the
            "least" of the fluid is zero; or "cut", where negative ones are zero.
        positions: of the fluid.
    """
    if level == "cut":
        cut: Array = np.maximum(pressures, 0.0)
        return cut
    zero = 0.0
    if level == "corner":
        zero = float(pressures[int(np.argmin(positions.sum(axis=1)))])
    elif level == "least":
        zero = float(pressures[: len(positions)].min())
    return pressures - zero if zero else pressures
