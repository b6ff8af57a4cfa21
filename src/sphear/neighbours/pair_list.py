"""The pair list: for each particle the entries within the support, built from the cells once for all sweeps."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from types import ModuleType
from typing import Any

import numpy as np

from sphear.engine.cache import generated_module
from sphear.engine.flags import options_text
from sphear.engine.selection import selection_table
from sphear.neighbours.cell_sort import CellSort
from sphear.neighbours.cells import REACH

Array = np.ndarray[Any, Any]

BALL = {1: 2.0, 2: np.pi, 3: 4 * np.pi / 3}  # the volume of the unit ball by dimension
SLACK = 16  # entries that may be written or read behind the last listed one

_BUILD = """
from sphear.engine.cache import njit
from sphear.engine.selection import between, load_lanes, once_only, population, store_selected


@njit({options})
def build({axes}, image, start, rows, cell, entry, first, neighbour, count, low, high, table, row, origin, end, most):
    '''List the entries j with low < |r_i - r_j|^2 < high for the rows row ... end, as far as there is room.

    Returns the first row not listed, the number of entries listed and of those at no distance.
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
                near = between(r2, -1.0, high, stop - j){once}
                kept = between(r2, low, high, stop - j){once}
                at_no_distance += population(near) - population(kept)
                store_selected(neighbour, count, j, kept, table)
                count += population(kept)
                j += 8
        row += 1
        first[row - origin] = count
    return row, count, at_no_distance
"""


@lru_cache
def list_module(dimension: int, once: bool = False) -> ModuleType:
    """The module whose `build` lists neighbours, all of each row or each pair once."""
    names = "xyz"[:dimension]
    text = _BUILD.format(
        options=options_text(),
        axes=", ".join(names),
        own="; ".join(f"{a}_i = {a}[i]" for a in names),
        differences="; ".join(f"d{a} = load_lanes({a}, j) - {a}_i" for a in names),
        square=" + ".join(f"d{a} * d{a}" for a in names),
        reach=REACH,
        once=" & once_only(image, j, i)" if once else "",
    )
    return generated_module(text)


@dataclass(frozen=True)
class Chunk:
    """The pair list of the rows begin ... end: neighbours of row begin + k are neighbour[first[k]:first[k + 1]].

    In a list of pairs listed once, those of a row are the entries after its own, and periodic images.
    """

    begin: int
    end: int
    first: Array
    neighbour: Array

    @property
    def pairs(self) -> int:
        """The number of listed pairs."""
        return int(self.first[-1])


def list_capacity(cells: CellSort, rows: int, once: bool) -> tuple[int, int]:
    """Estimate the number of entries in a list of so many rows, and the largest number of candidates in a row.

    The first is a guess from the mean density of the cells in use: a list grows where it does not suffice.
    """
    start, dimension = cells.start, len(cells.coordinates)
    most = int((start[2 * REACH + 1 :] - start[: -2 * REACH - 1]).max()) * len(cells.rows) + SLACK
    used = max(1, int(np.count_nonzero(np.diff(start))))
    ball = BALL[dimension] * REACH**dimension
    share = 0.5 if once else 1.0
    return int(1.1 * share * rows * len(cells.order) / used * ball) + most, most


def build_chunk(
    cells: CellSort,
    image: Array,
    entry: Array,
    begin: int,
    end: int,
    support: float,
    neighbour: Array,
    most: int,
    *,
    once: bool = False,
    keep_coincident: bool = False,
) -> tuple[Chunk, int]:
    """List the neighbours of rows begin ... end; also how many pairs of them lie at one place.

    "At one place" is nearer than 1e-9 supports. Such pairs are listed only with `keep_coincident`.

    Args:
        cells: the sorted entries.
        image: (E + 8,), whether an entry is a periodic image.
        entry: (N,), the entry of each row.
        begin: the first row.
        end: the row after the last.
        support: the distance within which two particles are neighbours.
        neighbour: where the list is written, int32; if it is too short, a longer one takes its place.
        most: candidates that a row has at most.
        once: list each pair from one side only.
        keep_coincident: list pairs at one place too.
    """
    build = list_module(len(cells.coordinates), once).build
    # the cells before a particle's own hold no entries after it
    cell_rows = cells.rows[cells.rows >= 0] if once and not image.any() else cells.rows
    rows = end - begin
    first = np.zeros(rows + 1, np.int64)
    low = -1.0 if keep_coincident else (1e-9 * support) ** 2
    row, count, coincident = begin, 0, 0
    while True:
        row, count, found = build(
            *cells.coordinates, image, cells.start, cell_rows, cells.cell, entry, first, neighbour, count, low,
            support**2,
            selection_table_once(), row, begin, end, most,
        )  # fmt: skip
        coincident += found
        if row == end:
            break
        neighbour = np.concatenate((neighbour[:count], np.empty(len(neighbour) // 2 + most, np.int32)))
    neighbour[count : count + SLACK] = entry[end - 1]  # lanes without a neighbour stay within the chunk
    itself = 0 if once or keep_coincident else rows  # each particle is at no distance of itself
    return Chunk(begin, end, first, neighbour), coincident - itself


@lru_cache
def selection_table_once() -> Array:
    """The table of `sphear.engine.selection`, made once."""
    return selection_table()
