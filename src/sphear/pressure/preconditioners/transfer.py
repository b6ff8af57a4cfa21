"""Between particles and the nodes of a background grid: multilinear interpolation and its transpose, compiled."""

from __future__ import annotations

from typing import Any

import numpy as np

from sphear.engine.cache import compiled

Array = np.ndarray[Any, Any]


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
def interpolate_and_add(nodes, weights, grid, factor, vector):  # type: ignore[no-untyped-def]
    """P grid + factor vector, in one walk over the particles."""
    result = np.empty(len(vector))
    for i in range(len(vector)):
        total = factor[i] * vector[i]
        for k in range(nodes.shape[1]):
            total += weights[i, k] * grid[nodes[i, k]]
        result[i] = total
    return result
