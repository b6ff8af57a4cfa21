"""The particle spacing told from the particles alone, however they lie and are turned."""

from __future__ import annotations

from functools import cache
from itertools import product
from typing import Any

import numpy as np

from sphear.errors import SphearError

Array = np.ndarray[Any, Any]

REACH = 2.0  # spacings: of the weight that neighbours are counted with
NEAREST = {1: 4, 2: 14, 3: 44}  # that are looked at: more than a lattice has within reach
LOOKED_AT = 2000  # particles, where there are more
FLAT = 1e-9  # of the usual extent: less is no extent
OUTSIDE = 1e4  # usual extents: where stray particles are put that are farther still


def spacing_of(positions: Array) -> float:
    """The spacing of the cubic lattice in which a particle has as many neighbours as here.

    Neighbours are counted with the weight (1 - (r / 2 dx)^2)^2. Of the values of all particles the median is taken of
    the smaller ones, as many as a cube has particles that are not on its surface. On a lattice of three or more
    particles along each axis it is exact; particles on a line or in a plane are taken as such.

    Args:
        positions: (N, d), finite.

    Raises:
        SphearError: fewer than two places.
    """
    from scipy.spatial import cKDTree

    points, size = _in_own_axes(positions)
    count, dimension = points.shape
    if not dimension:
        raise SphearError("the particle spacing cannot be told from these positions: give spacing, volumes or a kernel")
    tree = cKDTree(points, leafsize=32, balanced_tree=False, compact_nodes=False)
    looked_at = points
    if count > LOOKED_AT:
        looked_at = points[np.random.default_rng(0).choice(count, LOOKED_AT, replace=False)]
    nearest = min(NEAREST[dimension], count - 1)
    distances = np.asarray(tree.query(looked_at, k=np.arange(2, nearest + 2))[0])
    if count < 3**dimension:
        found = float(np.median(distances[:, 0]))
    else:
        inner = max(1, round(len(looked_at) * (1.0 - 2.0 / count ** (1.0 / dimension)) ** dimension))
        found = float(np.median(np.sort(_local(distances, dimension))[:inner]))
    if not found > 0.0:
        raise SphearError("the particle spacing cannot be told from these positions: give spacing, volumes or a kernel")
    return found * size


def _in_own_axes(positions: Array) -> tuple[Array, float]:
    """Places along the axes that they extend over, of order one, and what they were divided by."""
    centred = positions - positions[len(positions) // 2]
    distances = np.abs(centred).max(axis=1)
    size = float(np.median(distances)) or float(distances.max())
    if size == 0.0:
        return centred[:, :0], 1.0
    centred = np.clip(centred, -OUTSIDE * size, OUTSIDE * size) / size
    centred -= centred.mean(axis=0)
    extents, axes = np.linalg.eigh(centred.T @ centred)
    rounding = 4.0 * np.finfo(np.float64).eps * float(np.median(np.abs(positions).max(axis=1))) / size
    used = np.sqrt(np.maximum(extents, 0.0) / len(centred)) > max(FLAT, rounding)
    # of the squares, rounding leaves eight digits: what seems flat is measured once more
    for axis in np.flatnonzero(~used | (extents < 1e-12 * extents[-1])):
        used[axis] = float(np.sqrt(np.mean((centred @ axes[:, axis]) ** 2))) > max(FLAT, rounding)
    return (centred if used.all() else centred @ axes[:, used]), size


def _local(distances: Array, dimension: int) -> Array:
    """The spacing at each particle, (M,), from the distances to its nearest neighbours (M, k), by bisection."""
    wanted = _count(np.asarray(_lattice(dimension)), 1.0)
    low, high = np.full(len(distances), 0.0), distances[:, -1].copy()
    for _ in range(50):
        middle = 0.5 * (low + high)
        enough = _count(distances.T, np.maximum(middle, np.finfo(np.float64).tiny)) >= wanted
        high, low = np.where(enough, middle, high), np.where(enough, low, middle)
    return high


def _count(distances: Array, spacing: Array | float) -> Array:
    q2 = (distances / (REACH * spacing)) ** 2
    return np.asarray((np.maximum(1.0 - q2, 0.0) ** 2).sum(axis=0))


@cache
def _lattice(dimension: int) -> tuple[float, ...]:
    """The distances of a lattice's particles from one of them."""
    steps = product(range(-2, 3), repeat=dimension)
    return tuple(float(np.hypot.reduce(np.array((*step, 0.0)))) for step in steps if any(step))
