"""Records that stay from sweep to sweep over the same neighbours."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.engine.records import empty_records, pack, pack_positions, record_width
from sphear.engine.threads import on_threads, ranges

if TYPE_CHECKING:
    from sphear.neighbours import Neighbours

Array = np.ndarray[Any, Any]
Fields = Mapping[str, Array]
Columns = tuple[tuple[str, int], ...]

SHARE = 4096  # entries that a thread packs at least


@lru_cache(maxsize=512)
def runs(columns: Columns) -> list[tuple[str, int, int, int]]:
    """Columns of one field with components that follow each other: field, components from and to, first column.

    One copy packs a run.
    """
    found = []
    for (name, _), run in groupby(enumerate(columns), key=lambda cell: (cell[1][0], cell[1][1] - cell[0])):
        cells = [(column, component) for column, (_, component) in run]
        found.append((name, cells[0][1], cells[-1][1] + 1, cells[0][0]))
    return found


class Records:
    """Packs what sweeps need of the entries of one pair list.

    Places and the first fields, where these are among those that stay, are packed once for all sweeps whose records are
    as wide; so a sweep is to be made before the next one is prepared.

    Args:
        neighbours: the pairs.
        lasting: arrays (N,) or (N, k) that stay as they are, by name.
        dtype: "float64" or "float32".
    """

    def __init__(self, neighbours: Neighbours, lasting: Fields, dtype: str = "float64") -> None:
        self.neighbours, self.lasting, self.dtype = neighbours, lasting, dtype
        self._kept: dict[tuple[Columns, int, bool], Array] = {}

    def packed(self, columns: Columns, fields: Fields, with_position: bool = False) -> Array:
        """The columns, (field, component), of each entry side by side, (entries, columns)."""
        begin = self.neighbours.dimension if with_position else 0
        entries = len(self.neighbours.source)
        if not begin + len(columns):
            return np.empty((entries, 0), self.dtype)
        stay = 0
        while stay < len(columns) and fields[columns[stay][0]] is self.lasting.get(columns[stay][0]):
            stay += 1
        key = columns[:stay], record_width(begin + len(columns)), with_position
        records = self._kept.get(key)
        if records is None:
            records = empty_records(entries, begin + len(columns), self.dtype)
            if with_position:
                pack_positions(records, self.neighbours.coordinates)
            self._pack(records, begin, columns[:stay], fields)
            if stay or with_position:
                self._kept[key] = records
        self._pack(records, begin + stay, columns[stay:], fields)
        return records

    def _pack(self, records: Array, begin: int, columns: Columns, fields: Fields) -> None:
        if not columns:
            return
        source, threads = self.neighbours.source, self.neighbours.threads
        parts = max(1, min(threads, len(source) // SHARE))
        for name, first, last, column in runs(columns):
            values = fields[name]
            values = values.reshape(len(values), -1)[:, first:last]
            if parts == 1:
                pack(records, begin + column, values, source)
                continue

            def job(part: tuple[int, int], values: Array = values, column: int = begin + column) -> None:
                pack(records[slice(*part)], column, values, source[slice(*part)])

            on_threads(job, ranges(len(source), parts), threads)
