"""Rows of particles on the contours of a distance, behind walls that bend too often for rows of their own."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from contourpy import LineType, contour_generator

from sphear.boundaries.shapes.base import Array
from sphear.boundaries.shapes.rows import behind

if TYPE_CHECKING:
    from sphear.boundaries.shapes.base import Primitive

CELLS = 4  # of the grid of distances, in a spacing
MOST_CELLS = 4_000_000


def contour_rows(shape: Primitive, spacing: float, depth: float, inverted: bool) -> list[Array]:
    """Particles spaced evenly on the contours s = -(k + 1/2) spacing of the distance of a bounded shape.

    Args:
        shape: with finite bounds.
        spacing: of the particles.
        depth: up to which rows stand behind its walls.
        inverted: whether the solid is inside instead of outside.
    """
    low, high = (np.array(corner) for corner in shape.bounds)
    low, high = low - depth - spacing, high + depth + spacing
    step = max(spacing / CELLS, float(np.sqrt(np.prod(high - low) / MOST_CELLS)))
    x, y = (np.arange(a, b + step, step) for a, b in zip(low, high, strict=True))
    points = np.stack(np.meshgrid(x, y), axis=2).reshape(-1, 2)
    distance = shape.distance(points).reshape(len(y), len(x))
    generator = contour_generator(x, y, distance, line_type=LineType.Separate)
    found = [np.empty((0, 2))]
    for below in behind(spacing, depth):
        level = below if inverted else -below
        for line in generator.lines(level):
            places = evenly(np.asarray(line), spacing)
            foot = shape.foot(places)
            found.append(places + (level - foot.distance)[:, None] * foot.normal)  # the grid knows it only nearly
    return [np.concatenate(found)]


def evenly(line: Array, spacing: float) -> Array:
    """Points evenly spaced on a closed line (N, 2), as many as come nearest the spacing."""
    lengths = np.hypot(*np.diff(line, axis=0).T)
    upto = np.concatenate(([0.0], np.cumsum(lengths)))
    count = round(upto[-1] / spacing)
    if count == 0:
        return np.empty((0, 2))
    at = (np.arange(count) + 0.5) * upto[-1] / count
    return np.column_stack([np.interp(at, upto, line[:, axis]) for axis in range(2)])
