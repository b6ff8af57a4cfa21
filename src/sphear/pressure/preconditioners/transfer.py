"""Between particles and the nodes of a background grid: multilinear interpolation and its transpose, compiled."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from sphear.engine.cache import compiled
from sphear.engine.threads import on_threads, ranges

Array = np.ndarray[Any, Any]

BLOCK, MOST_BLOCKS = 15000, 8  # particles of a block, at least, and how many blocks at most


@compiled
def surrounding_nodes(positions, lower, size, counts, periodic):  # type: ignore[no-untyped-def]
    """The nodes (n, 2^d) around each particle and their weights (n, 2^d).

    Node k of an axis is at the middle of cell k, lower + (k + 1/2) size. The field is even about a wall, so that it is
    constant from the outermost node to the wall and beyond.
    """
    particles, dimension = positions.shape
    number = 1 << dimension
    nodes = np.empty((particles, number), np.int32)
    weights = np.empty((particles, number))
    for i in range(particles):
        for k in range(number):
            nodes[i, k] = 0
            weights[i, k] = 1.0
        for axis in range(dimension):
            count = counts[axis]
            place = (positions[i, axis] - lower[axis]) / size[axis] - 0.5
            if periodic[axis]:
                place -= count * np.floor(place / count)
            else:
                place = min(max(place, 0.0), count - 1.0)
            below = min(int(place), count - 1)
            part = place - below
            above = below + 1
            if above == count:
                above = 0 if periodic[axis] else below
            for k in range(number):
                up = (k >> axis) & 1
                nodes[i, k] = nodes[i, k] * count + (above if up else below)
                weights[i, k] *= part if up else 1.0 - part
    return nodes, weights


@compiled
def deposit(nodes, weights, vector, grid):  # type: ignore[no-untyped-def]
    """grid = P^T vector, the transpose of interpolation; grid (nodes,) is flat."""
    grid[:] = 0.0
    for i in range(len(vector)):
        value = vector[i]
        for k in range(nodes.shape[1]):
            grid[nodes[i, k]] += weights[i, k] * value


@compiled
def interpolate_and_add(nodes, weights, grid, factor, vector, result):  # type: ignore[no-untyped-def]
    """result = P grid + factor vector, in one walk over the particles."""
    for i in range(len(vector)):
        total = factor[i] * vector[i]
        for k in range(nodes.shape[1]):
            total += weights[i, k] * grid[nodes[i, k]]
        result[i] = total


class Transfer:
    """Between n particles and the nodes of a grid, on threads.

    Particles are shared out in as many blocks as there are enough of them for, each with a grid of its own to deposit
    on; so what is added in which order depends on the number of particles only.

    Args:
        positions: (n, d).
        lower: (d,), the corner of the box.
        size: (d,), the distance of nodes along each axis.
        counts: (d,), nodes along each axis.
        periodic: (d,), whether an axis repeats.
        threads: to compute on.
    """

    def __init__(
        self,
        positions: Array,
        lower: Sequence[float],
        size: Sequence[float],
        counts: Sequence[int],
        periodic: Sequence[bool],
        threads: int,
    ) -> None:
        box = np.array(lower), np.array(size), np.array(counts), np.array(periodic)
        blocks = min(max(len(positions) // BLOCK, 1), MOST_BLOCKS)
        self.threads = min(threads, blocks)
        self.blocks = [slice(*ends) for ends in ranges(len(positions), blocks)]
        self._grids = np.empty((blocks, int(np.prod(counts))))
        self._around = on_threads(lambda block: surrounding_nodes(positions[block], *box), self.blocks, self.threads)

    def deposit(self, vector: Array) -> Array:
        """P^T vector (n,), (nodes,); the memory is written over by the next call."""

        def onto(number: int) -> None:
            deposit(*self._around[number], vector[self.blocks[number]], self._grids[number])

        on_threads(onto, range(len(self.blocks)), self.threads)
        total: Array = self._grids[0] if len(self.blocks) == 1 else np.add.reduce(self._grids)
        return total

    def interpolate_and_add(self, grid: Array, factor: Array, vector: Array) -> Array:
        """P grid + factor vector, (n,), of a grid (nodes,), factors (n,) and a vector (n,)."""
        result = np.empty(len(vector))

        def onto(number: int) -> None:
            block = self.blocks[number]
            interpolate_and_add(*self._around[number], grid, factor[block], vector[block], result[block])

        on_threads(onto, range(len(self.blocks)), self.threads)
        return result
