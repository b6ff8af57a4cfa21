"""The pair list: for each particle the entries within the support, built from the cells once for all sweeps."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from sphear.engine.cache import generated_module
from sphear.engine.flags import options_text
from sphear.engine.selection import selection_table
from sphear.neighbours.cells import REACH, CellSort

Array = np.ndarray[Any, Any]

SLACK = 16  # entries that may be written or read behind the last listed one

_BUILD = """
from numba import njit
from sphear.engine.selection import between, load_lanes, population, store_selected


@njit({options})
def build({axes}, start, rows, cell, entry, first, neighbour, count, low, high, table, row, origin, end, most):
    '''List the entries j with low < |r_i - r_j|^2 < high for the rows row ... end, as far as there is room.

    Returns the first row not listed, the number of entries listed and of those at no distance (each row counts one).
    '''
    at_no_distance = 0
    while row < end and count + most <= len(neighbour):
        i = entry[row]
        {own}
        for k in range(len(rows)):
            center = cell[i] + rows[k]
            j, stop = start[center - {reach}], start[center + {reach} + 1]
            while j < stop:
                {differences}
                r2 = {square}
                near = between(r2, -1.0, high, stop - j)
                kept = between(r2, low, high, stop - j)
                at_no_distance += population(near) - population(kept)
                store_selected(neighbour, count, j, kept, table)
                count += population(kept)
                j += 8
        row += 1
        first[row - origin] = count
    return row, count, at_no_distance
"""


@lru_cache
def _builder(dimension: int) -> Any:
    names = "xyz"[:dimension]
    text = _BUILD.format(
        options=options_text(),
        axes=", ".join(names),
        own="; ".join(f"{a}_i = {a}[i]" for a in names),
        differences="; ".join(f"d{a} = load_lanes({a}, j) - {a}_i" for a in names),
        square=" + ".join(f"d{a} * d{a}" for a in names),
        reach=REACH,
    )
    return generated_module(text).build


@dataclass(frozen=True)
class Chunk:
    """The pair list of the rows begin ... end: neighbours of row begin + k are neighbour[first[k]:first[k + 1]]."""

    begin: int
    end: int
    first: Array
    neighbour: Array

    @property
    def pairs(self) -> int:
        """The number of listed pairs, each seen from its first particle."""
        return int(self.first[-1])


def build_chunk(
    cells: CellSort, entry: Array, begin: int, end: int, support: float, keep_coincident: bool
) -> tuple[Chunk, int]:
    """List the neighbours of rows begin ... end; also how many pairs of them lie at one place.

    "At one place" is nearer than 1e-9 supports. Such pairs are listed only with `keep_coincident`.
    """
    build = _builder(len(cells.coordinates))
    start, dimension = cells.start, len(cells.coordinates)
    run = start[2 * REACH + 1 :] - start[: -2 * REACH - 1]
    most = int(run.max()) * len(cells.rows) + SLACK
    rows = end - begin
    # a first guess from the mean density of the cells in use; grown when it does not suffice, never overflowed
    used = max(1, int(np.count_nonzero(np.diff(start))))
    ball = {1: 2.0, 2: np.pi, 3: 4 * np.pi / 3}[dimension] * REACH**dimension
    neighbour = np.empty(int(1.1 * rows * len(cells.cell) / used * ball) + most, np.int32)
    first = np.zeros(rows + 1, np.int64)
    low = -1.0 if keep_coincident else (1e-9 * support) ** 2
    row, count, coincident = begin, 0, 0
    while True:
        row, count, found = build(
            *cells.coordinates, start, cells.rows, cells.cell, entry, first, neighbour, count, low, support**2,
            selection_table_once(), row, begin, end, most,
        )  # fmt: skip
        coincident += found
        if row == end:
            break
        neighbour = np.concatenate((neighbour[:count], np.empty(len(neighbour) // 2 + most, np.int32)))
    neighbour[count : count + SLACK] = 0
    return Chunk(begin, end, first, neighbour), coincident - (0 if keep_coincident else rows)


@lru_cache
def selection_table_once() -> Array:
    """The table of `sphear.engine.selection`, made once."""
    return selection_table()
