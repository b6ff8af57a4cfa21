"""The cell sort: entries (particles and their periodic images) ordered by the cell of a background grid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from sphear.engine.cache import compiled

Array = np.ndarray[Any, Any]

REACH = 2  # cells of half a support: fewer candidates than whole ones, see benchmarks/lanes.py
PADDING = 8  # room behind the last entry, so that eight candidates can always be read at once


@dataclass(frozen=True)
class CellSort:
    """Entries in the order of their cells.

    Attributes:
        coordinates: (d, E + 8), one row an axis, in the order of the cells.
        order: (E,), the entry of the input that each one is.
        cell: (E,), its cell.
        start: (cells + 1,), the first entry of each cell.
        rows: offsets to the rows of cells within reach of a cell; a row runs from cell - REACH to cell + REACH.
    """

    coordinates: Array
    order: Array
    cell: Array
    start: Array
    rows: Array


@compiled
def _bounds(positions, lower, upper):  # type: ignore[no-untyped-def]
    for axis in range(positions.shape[1]):
        low, high = np.inf, -np.inf
        for entry in range(positions.shape[0]):
            low, high = min(low, positions[entry, axis]), max(high, positions[entry, axis])
        lower[axis], upper[axis] = low, high


@compiled
def _count(positions, lower, inverse_size, strides, offset, cell, count):  # type: ignore[no-untyped-def]
    for entry in range(positions.shape[0]):
        number = offset
        for axis in range(positions.shape[1]):
            number += np.int64((positions[entry, axis] - lower[axis]) * inverse_size) * strides[axis]
        cell[entry] = number
        count[number + 1] += 1


@compiled
def _place(positions, cell, following, coordinates, order, sorted_cell):  # type: ignore[no-untyped-def]
    for entry in range(positions.shape[0]):
        place = following[cell[entry]]
        following[cell[entry]] += 1
        order[place] = entry
        sorted_cell[place] = cell[entry]
        for axis in range(positions.shape[1]):
            coordinates[axis, place] = positions[entry, axis]


def cell_sort(positions: Array, support: float) -> CellSort:
    """Sort positions (E, d) into cells of half a support, or larger ones where that would leave most cells empty."""
    entries, dimension = positions.shape
    lower, upper = np.zeros(dimension), np.zeros(dimension)
    if entries:
        _bounds(positions, lower, upper)
    extent = upper - lower
    size = support / REACH * (1 + 1e-9)
    with np.errstate(over="ignore"):
        while np.prod(extent / size + 2 * REACH + 1) > 8 * entries + 1000:
            size *= 1.5
    # an empty border of REACH cells on each side: rows of neighbouring cells never leave the grid
    shape = (extent / size).astype(np.int64) + 1 + 2 * REACH
    strides = np.ones(dimension, np.int64)  # the first axis runs fastest
    strides[1:] = np.cumprod(shape[:-1])
    cells = int(np.prod(shape))

    cell = np.empty(entries, np.int32)
    start = np.zeros(cells + 1, np.int64)
    _count(positions, lower, 1.0 / size, strides, REACH * int(strides.sum()), cell, start)
    np.cumsum(start, out=start)
    coordinates = np.empty((dimension, entries + PADDING))
    coordinates[:, entries:] = np.inf
    order, sorted_cell = np.empty(entries, np.int32), np.empty(entries, np.int32)
    _place(positions, cell, start[:-1].copy(), coordinates, order, sorted_cell)

    steps = np.arange(-REACH, REACH + 1)
    rows = np.zeros(1, np.int64)
    for stride in strides[1:]:
        rows = (steps[:, None] * stride + rows[None, :]).ravel()
    return CellSort(coordinates, order, sorted_cell, start, rows)
