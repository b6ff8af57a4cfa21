"""The cell sort: entries (particles and their periodic images) ordered by the cell of a background grid."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from sphear.engine.threads import on_threads, ranges
from sphear.neighbours.cells import (
    PADDING,
    REACH,
    cell_total,
    fill_offsets,
    first_places,
    grid,
    number_cells,
    place_entries,
    sorted_cells,
)

Array = np.ndarray[Any, Any]

WORTH_SORTING = 4096  # entries, that a thread sorts at least


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


def cell_sort(positions: Array, support: float, threads: int = 1) -> CellSort:
    """Sort positions (E, d) into cells of half a support; in the same order on any number of threads."""
    entries, dimension = positions.shape
    parts = min(threads, entries // WORTH_SORTING)
    if parts < 2:
        return CellSort(*sorted_cells(positions, support))
    lower, extent, inverse, counts = grid(positions, support)
    cells = cell_total(counts)
    coordinates = np.empty((dimension, entries + PADDING))
    order, cell, unsorted = np.empty(entries, np.int32), np.empty(entries, np.int32), np.empty(entries, np.int32)
    start, found = np.empty(cells + 1, np.int64), np.empty((parts, cells), np.int64)
    shares = [(part, *share) for part, share in enumerate(ranges(entries, parts))]

    def number(share: tuple[int, int, int]) -> None:
        part, begin, end = share
        number_cells(positions, begin, end, lower, extent, inverse, counts, unsorted, found[part])

    def place(share: tuple[int, int, int]) -> None:
        part, begin, end = share
        place_entries(positions, begin, end, unsorted, found[part], coordinates, order, cell)

    on_threads(number, shares, threads)
    first_places(found, start)
    on_threads(place, shares, threads)
    coordinates[:, entries:] = np.inf
    offsets = np.empty((2 * REACH + 1) ** (dimension - 1), np.int64)
    fill_offsets(counts, offsets)
    return CellSort(coordinates, order, cell, start, offsets)
