"""Particles on a lattice over the unit square or cube, moved at random by a given fraction of their spacing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from sphear.cases.size import check_count
from sphear.errors import SphearError

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class Lattice:
    """Particles near the nodes (i, j, ...) dx, dx = 1 / intervals.

    Attributes:
        positions: (N, d).
        inside: (N,), how many intervals a particle's node lies inside the nearest edge; negative outside.
        spacing: dx.
    """

    positions: Array
    inside: Array
    spacing: float

    @property
    def volume(self) -> float:
        """dx^d, the volume of each particle."""
        return float(self.spacing ** self.positions.shape[1])


def lattice(intervals: int, dimension: int, *, layers: int = 0, jitter: float = 0.0, seed: int = 0) -> Lattice:
    """A lattice of nodes 0 ... intervals along each axis, with `layers` more beyond each edge.

    Each particle is moved along each axis by jitter (R - 1/2) dx, with R uniform in (0, 1).

    Args:
        intervals: dx is one over it; at least 1.
        dimension: 1, 2 or 3.
        layers: how far the lattice goes on beyond the edges.
        jitter: in spacings, from 0 to 1: above 1 two particles can meet.
        seed: of the random numbers.

    Raises:
        SphearError: a size or a jitter that is not allowed.
    """
    if intervals < 1:
        raise SphearError(f"a lattice needs at least 1 interval, not {intervals}")
    if not 0 <= jitter <= 1:
        raise SphearError(f"the jitter must be from 0 to 1 spacings, above which particles can meet, not {jitter}")
    count = (intervals + 2 * layers + 1) ** dimension
    if count > np.iinfo(np.int32).max:
        raise SphearError(
            f"{intervals} intervals a side, with {layers} beyond each edge, are too many for a lattice in {dimension}-D"
        )
    check_count(count, f"a lattice of {intervals} intervals a side", dimension, "a size", intervals)
    spacing = 1.0 / intervals
    ticks = np.arange(-layers, intervals + layers + 1, dtype=np.int32)
    depth = np.minimum(ticks, intervals - ticks)
    shape = (len(ticks),) * dimension
    positions = np.empty((count, dimension))
    inside = np.full(shape, np.iinfo(np.int32).max, np.int32)
    for axis in range(dimension):
        along = [1] * dimension
        along[axis] = -1
        positions[:, axis] = np.broadcast_to(ticks.reshape(along) * spacing, shape).ravel()
        np.minimum(inside, depth.reshape(along), out=inside)
    if jitter:
        random = np.random.default_rng(seed)
        for axis in range(dimension):
            positions[:, axis] += jitter * spacing * (random.random(len(positions)) - 0.5)
    return Lattice(positions, inside.ravel(), spacing)
