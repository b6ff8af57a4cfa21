"""Cells of a background grid, and entries (particles and their periodic images) put into their order."""

from __future__ import annotations

import numpy as np

from sphear.engine.cache import compiled, inlined

REACH = 2  # cells of half a support: fewer candidates than whole ones, see benchmarks/lanes.py
FARTHEST = 1e15  # cells: beyond, neighbouring floating-point numbers are no neighbours
PADDING = 8  # room behind the last entry, so that eight candidates can always be read at once


@inlined
def fold(along, count):  # type: ignore[no-untyped-def]
    """The cell 0 ... count - 1 of a place given in cells, on an axis that is folded like a fan.

    Folding never moves two cells apart, so whatever is near stays near; what comes to lie there from elsewhere is
    sorted out by its distance.
    """
    cell = np.int64(min(along, FARTHEST)) % (2 * count)
    return min(cell, 2 * count - 1 - cell)


@inlined
def grid_counts(extent, inverse, entries):  # type: ignore[no-untyped-def]
    """The cells along each axis: as many as the entries extend over, but not many more in all than entries.

    Longer axes are folded: one far entry, or a thin diagonal line of them, costs no more than others. Folds of
    different lengths keep a diagonal from being folded onto itself.
    """
    dimension = len(extent)
    counts = np.empty(dimension, np.int64)
    most = 8.0 * entries + 1000.0
    longest = most
    while True:
        cells = 1.0
        for axis in range(dimension):
            wanted = extent[axis] * inverse + 1.0
            counts[axis] = np.int64(min(wanted, longest + axis))
            cells *= counts[axis] + 2 * REACH
        if cells <= most or longest < 4.0:
            return counts
        longest *= 0.8


@inlined
def grid(positions, support):  # type: ignore[no-untyped-def]
    """The lower corner and extent of the box around entries (E, d), one over the size of a cell, cells along axes."""
    entries, dimension = positions.shape
    lower, extent = np.zeros(dimension), np.zeros(dimension)
    for axis in range(dimension):
        low, high = np.inf, -np.inf
        for entry in range(entries):
            low, high = min(low, positions[entry, axis]), max(high, positions[entry, axis])
        if entries:
            lower[axis], extent[axis] = low, high - low
    inverse = 1.0 / (support / REACH * (1 + 1e-9))
    return lower, extent, inverse, grid_counts(extent, inverse, entries)


@inlined
def cell_total(counts):  # type: ignore[no-untyped-def]
    """All cells of a grid with `counts` along the axes, those of its empty border among them."""
    cells = np.int64(1)
    for axis in range(len(counts)):
        cells *= counts[axis] + 2 * REACH
    return cells


@inlined
def fill_offsets(counts, offsets):  # type: ignore[no-untyped-def]
    """Write the (5^(d - 1),) offsets to the rows of cells within reach of a cell."""
    number, stride = 1, counts[0] + 2 * REACH
    offsets[0] = 0
    for axis in range(1, len(counts)):
        for step in range(2 * REACH, -1, -1):  # the first of them last: the others are made of it
            for k in range(number):
                offsets[step * number + k] = (step - REACH) * stride + offsets[k]
        number *= 2 * REACH + 1
        stride *= counts[axis] + 2 * REACH


@inlined
def number_cells(  # type: ignore[no-untyped-def]
    positions, begin, end, lower, extent, inverse, counts, unsorted, found
):
    """Write the cell of each of the entries begin ... end to `unsorted`, and how many are in each cell to `found`."""
    dimension = positions.shape[1]
    # an empty border of REACH cells on each side: rows of neighbouring cells never leave the grid
    strides = np.ones(dimension, np.int64)  # the first axis runs fastest
    cells, border = np.int64(1), np.int64(0)
    for axis in range(dimension):
        strides[axis] = cells
        border += REACH * cells
        cells = cells * (counts[axis] + 2 * REACH)
    folded = np.empty(dimension, np.bool_)
    for axis in range(dimension):
        folded[axis] = extent[axis] * inverse >= counts[axis]

    for number_of_cell in range(cells):
        found[number_of_cell] = 0
    for entry in range(begin, end):
        number = border
        for axis in range(dimension):
            along = (positions[entry, axis] - lower[axis]) * inverse
            if folded[axis]:
                number += fold(along, counts[axis]) * strides[axis]
            else:
                number += np.int64(along) * strides[axis]
        unsorted[entry] = number
        found[number] += 1


@inlined
def first_places(found, start):  # type: ignore[no-untyped-def]
    """Write the first entry of each cell to `start`; in place of how many a part has `found` in it, its first there.

    Args:
        found: (parts, cells), of parts whose entries follow each other.
        start: (cells + 1,).
    """
    place = np.int64(0)
    for number_of_cell in range(found.shape[1]):
        start[number_of_cell] = place
        for part in range(len(found)):
            number = found[part, number_of_cell]
            found[part, number_of_cell] = place
            place += number
    start[found.shape[1]] = place


@inlined
def place_entries(  # type: ignore[no-untyped-def]
    positions, begin, end, unsorted, following, coordinates, order, cell
):
    """Put the entries begin ... end where they are sorted to: each cell's next place is `following`."""
    dimension = positions.shape[1]
    for entry in range(begin, end):
        place = following[unsorted[entry]]
        following[unsorted[entry]] += 1
        order[place] = entry
        cell[place] = unsorted[entry]
        for axis in range(dimension):
            coordinates[axis, place] = positions[entry, axis]


@inlined
def fill_cells(  # type: ignore[no-untyped-def]
    positions, lower, extent, inverse, counts, coordinates, order, cell, start, unsorted, following
):
    """Sort entries into the cells of a grid.

    Args:
        positions: (E, d), of the entries.
        lower, extent, inverse, counts: of `grid`.
        coordinates: (d, at least E + 8), written: in the order of the cells.
        order: (E,), written: the entry of the input that each one is.
        cell: (E,), written: its cell.
        start: (cells + 1,), written: the first entry of each cell.
        unsorted: (E,), written over.
        following: (cells,), written over.
    """
    entries = len(positions)
    number_cells(positions, 0, entries, lower, extent, inverse, counts, unsorted, following)
    first_places(following.reshape((1, len(following))), start)
    place_entries(positions, 0, entries, unsorted, following, coordinates, order, cell)
    for axis in range(positions.shape[1]):
        for place in range(entries, entries + PADDING):
            coordinates[axis, place] = np.inf


@compiled
def sorted_cells(positions, support):  # type: ignore[no-untyped-def]
    """The attributes of a `CellSort` for positions (E, d), in their order."""
    entries, dimension = positions.shape
    lower, extent, inverse, counts = grid(positions, support)
    cells = cell_total(counts)
    coordinates = np.empty((dimension, entries + PADDING))
    order, cell, unsorted = np.empty(entries, np.int32), np.empty(entries, np.int32), np.empty(entries, np.int32)
    start, following = np.empty(cells + 1, np.int64), np.empty(cells, np.int64)
    fill_cells(positions, lower, extent, inverse, counts, coordinates, order, cell, start, unsorted, following)
    offsets = np.empty((2 * REACH + 1) ** (dimension - 1), np.int64)
    fill_offsets(counts, offsets)
    return coordinates, order, cell, start, offsets


@compiled
def point_cells(points, positions, support):  # type: ignore[no-untyped-def]
    """The cell of each point (M, d) in the grid of `sorted_cells`; of one outside, the nearest in the box of entries.

    That is no farther from any entry's cell than the point's own would be.
    """
    lower, extent, inverse, counts = grid(positions, support)
    cell = np.empty(len(points), np.int32)
    for point in range(len(points)):
        number, stride = np.int64(0), np.int64(1)
        for axis in range(len(lower)):
            along = min(max(points[point, axis] - lower[axis], 0.0), extent[axis]) * inverse
            number += (fold(along, counts[axis]) + REACH) * stride
            stride *= counts[axis] + 2 * REACH
        cell[point] = number
    return cell
