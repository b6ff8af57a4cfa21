"""Dummy particles: rows of them behind the walls of a shape."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from sphear.boundaries.shapes.base import Array, Foot, Shape, number
from sphear.boundaries.shapes.feet import true_feet
from sphear.boundaries.shapes.repeated import repeated
from sphear.boundaries.shapes.rows import SLACK
from sphear.errors import SphearError
from sphear.neighbours.domain import Domain

NEAR_WALL = 0.25  # spacings behind the wall from which there are dummies
TOO_NEAR = 0.5  # spacings apart


class Dummies(NamedTuple):
    """The particles behind the walls.

    Attributes:
        positions: (M, 2).
        depths: (M,), behind the nearest wall, positive.
        normals: (M, 2), unit vectors from them into the fluid.
        velocities: (M, 2), of the wall at their feet.
    """

    positions: Array
    depths: Array
    normals: Array
    velocities: Array

    @property
    def feet(self) -> Array:
        """(M, 2), the points of the walls that are nearest to them."""
        return np.asarray(self.positions + self.depths[:, None] * self.normals)


def dummies(shape: Shape, spacing: float, depth: float, box: Domain) -> Dummies:
    """Rows of particles behind the walls of a shape, at the depths (k + 1/2) spacing.

    Behind straight walls along the axes they continue a lattice that starts half a spacing in front of the walls;
    around circles they are rings. Where the walls of several shapes meet, each shape's rows fill the part of the solid
    whose nearest wall is its own, and of two particles nearer than half a spacing the deeper one is left out.

    Args:
        shape: the region of fluid.
        spacing: of the particles, dx.
        depth: up to which there are particles behind the walls.
        box: the window of interest: the rows repeat with it along its periodic axes, and end `depth` beyond it along
            the others.

    Raises:
        SphearError: the spacing or depth is not positive, or the shape cannot repeat as the window does.
    """
    if number("the spacing of dummy particles", spacing) <= 0 or number("their depth", depth) <= 0:
        raise SphearError(f"the spacing and depth of dummy particles are positive, not {spacing:g} and {depth:g}")
    whole = repeated(shape, box)
    low, high = np.array(box.lower), np.array(box.upper)
    for axis in set(range(2)) - set(box.periodic_axes):
        low[axis] -= depth
        high[axis] += depth
    slack = SLACK * spacing
    places, part_of = [np.empty((0, 2))], [np.empty(0, np.int64)]
    for primitive, inverted in shape.primitives():
        for rows in primitive.rows(spacing, depth, box, inverted):
            own = np.abs(primitive.distance(rows))
            wrapped = box.wrapped(rows)
            distance = whole.distance(wrapped)
            kept = (distance <= -NEAR_WALL * spacing) & (distance >= -depth - slack) & (own <= -distance + slack)
            kept &= (own >= -distance - slack) & ((wrapped >= low - slack) & (wrapped <= high + slack)).all(axis=1)
            places.append(wrapped[kept])
            part_of.append(np.full(int(kept.sum()), len(part_of)))
    positions, part = np.concatenate(places), np.concatenate(part_of)
    foot = true_feet(shape, whole, positions, spacing, box)
    seen = foot.distance >= -depth - slack
    positions, part, foot = positions[seen], part[seen], Foot(*(array[seen] for array in foot))
    kept = spread(positions, part, -foot.distance, TOO_NEAR * spacing, box)
    return Dummies(positions[kept], -foot.distance[kept], foot.normal[kept], foot.velocity[kept])


def spread(positions: Array, part: Array, depths: Array, apart: float, box: Domain) -> Array:
    """True for particles that stay, (N,): of two of different parts nearer than `apart`, the shallower one."""
    kept = np.ones(len(positions), bool)
    if len(positions) < 2:
        return kept
    order = np.argsort((depths / apart).round(6), kind="stable")
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    periods = [box.upper[axis] - box.lower[axis] if axis in box.periodic_axes else 0.0 for axis in range(2)]
    inside = positions - np.array(box.lower)
    for axis in box.periodic_axes:  # rounding may have put one just on the end
        inside[:, axis] = np.where(inside[:, axis] >= periods[axis], 0.0, inside[:, axis])
    tree = cKDTree(inside, boxsize=np.array(periods))
    pairs = tree.query_pairs(apart * (1.0 - SLACK), output_type="ndarray")
    pairs = pairs[part[pairs[:, 0]] != part[pairs[:, 1]]]
    pairs = np.take_along_axis(pairs, np.argsort(rank[pairs], axis=1), axis=1)  # the shallower first
    for first, second in pairs[np.lexsort((rank[pairs[:, 1]], rank[pairs[:, 0]]))]:
        if kept[first]:
            kept[second] = False
    return kept
