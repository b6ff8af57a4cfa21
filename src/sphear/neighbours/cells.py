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
def sorted_cells(positions, support):  # type: ignore[no-untyped-def]
    """The attributes of `CellSort` for positions (E, d), in their order; compiled, so that a time loop can call it."""
    entries, dimension = positions.shape
    lower, extent = np.zeros(dimension), np.zeros(dimension)
    for axis in range(dimension):
        low, high = np.inf, -np.inf
        for entry in range(entries):
            low, high = min(low, positions[entry, axis]), max(high, positions[entry, axis])
        if entries:
            lower[axis], extent[axis] = low, high - low

    # cells of half a support, or larger ones where that would leave most cells empty
    size = support / REACH * (1 + 1e-9)
    wanted = np.inf
    while wanted > 8 * entries + 1000:
        wanted = 1.0
        for axis in range(dimension):
            wanted *= extent[axis] / size + 2 * REACH + 1
        size *= 1.0 if wanted <= 8 * entries + 1000 else 1.5
    inverse = 1.0 / size
    # an empty border of REACH cells on each side: rows of neighbouring cells never leave the grid
    strides = np.ones(dimension, np.int64)  # the first axis runs fastest
    cells, border = np.int64(1), np.int64(0)
    for axis in range(dimension):
        strides[axis] = cells
        border += REACH * cells
        cells = cells * np.int64(extent[axis] * inverse + 1 + 2 * REACH)

    cell = np.empty(entries, np.int32)
    start = np.zeros(cells + 1, np.int64)
    for entry in range(entries):
        number = border
        for axis in range(dimension):
            number += np.int64((positions[entry, axis] - lower[axis]) * inverse) * strides[axis]
        cell[entry] = number
        start[number + 1] += 1
    for number_before in range(cells):
        start[number_before + 1] += start[number_before]

    following = start[:-1].copy()
    coordinates = np.full((dimension, entries + PADDING), np.inf)
    order, sorted_cell = np.empty(entries, np.int32), np.empty(entries, np.int32)
    for entry in range(entries):
        place = following[cell[entry]]
        following[cell[entry]] += 1
        order[place] = entry
        sorted_cell[place] = cell[entry]
        for axis in range(dimension):
            coordinates[axis, place] = positions[entry, axis]

    rows = np.zeros(1, np.int64)
    for axis in range(1, dimension):
        before = rows
        rows = np.empty(len(before) * (2 * REACH + 1), np.int64)
        for step in range(2 * REACH + 1):
            for k in range(len(before)):
                rows[step * len(before) + k] = (step - REACH) * strides[axis] + before[k]
    return coordinates, order, sorted_cell, start, rows


def cell_sort(positions: Array, support: float) -> CellSort:
    """Sort positions (E, d) into cells of half a support, or larger ones where that would leave most cells empty."""
    return CellSort(*sorted_cells(positions, support))
