"""Particles of a flow on a lattice, half a spacing away from the sides."""

from __future__ import annotations

from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]


def staggered_from_walls(resolution: int, width: float, centred: bool = True) -> tuple[Array, float]:
    """resolution x resolution particles in a square of this width, and their spacing.

    The square begins at x = 0, and at y = 0 or, centred, at y = -width / 2.
    """
    spacing = width / resolution
    ticks = (np.arange(resolution) + 0.5) * spacing
    positions = np.stack(np.meshgrid(ticks, ticks, indexing="ij"), axis=-1).reshape(-1, 2)
    return positions - np.array([0.0, width / 2 if centred else 0.0]), spacing
