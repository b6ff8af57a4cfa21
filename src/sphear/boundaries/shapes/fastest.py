"""The largest speed of the walls of a shape."""

from __future__ import annotations

import numpy as np

from sphear.boundaries.shapes.base import Shape, slipping
from sphear.neighbours.domain import Domain


def fastest(shape: Shape, spacing: float, window: Domain) -> float:
    """The greatest speed of the walls of a shape, at points a spacing apart; 0 where nothing moves."""
    speeds = [0.0]
    for primitive, _ in shape.primitives():
        walls = primitive.outline(spacing, window)
        if len(walls):
            velocities = primitive.wall_velocity(walls)
            speeds.append(float(np.hypot(*velocities[~slipping(velocities)].T).max(initial=0.0)))
    return max(speeds)
