"""The arrays of a program, kept from step to step, and their addresses."""

from __future__ import annotations

from typing import Any

import numpy as np

from sphear.engine.backends.cpu import sizes
from sphear.engine.backends.cpu.sizes import (
    CELL_ROOM,
    ENTRY_ROOM,
    LISTED,
    MORE_CELLS,
    MORE_ENTRIES,
    PAIR_ROOM,
    PARTICLES,
    PARTS,
    WANTED,
)
from sphear.neighbours.cells import PADDING, REACH
from sphear.neighbours.pair_list import BALL, SLACK, selection_table_once

Array = np.ndarray[Any, Any]

CACHE_LINE = 64  # bytes


class Memory:
    """The arrays of a program by name: those of the flow, which are its own, and those between its stages.

    Args:
        fields: arrays of the flow, written in place.
        space: arrays and numbers of the box and its fineness, see `sphear.engine.backends.cpu.program.Space`.
        fluid: particles of the fluid.
        total: and of walls.
        dimension: 2 or 3.
        parts: of the pair list.

    Attributes:
        sizes: see `sphear.engine.backends.cpu.sizes`.
    """

    def __init__(
        self, fields: dict[str, Array], space: dict[str, Any], fluid: int, total: int, dimension: int, parts: int
    ) -> None:
        self._fields = fields
        # of a particle inside the fluid
        self._neighbours = BALL[dimension] * (space["support"] / space["spacing"]) ** dimension
        self.sizes = np.zeros(sizes.COUNT, np.int64)
        of_axes = (2 * REACH + 1) ** (dimension - 1)
        for place, number in (
            (sizes.DIMENSION, dimension), (sizes.FLUID, fluid), (PARTICLES, total), (PARTS, parts),
            (ENTRY_ROOM, total + total // 4 + 100), (sizes.OFFSETS, of_axes),
        ):  # fmt: skip
            self.sizes[place] = number
        self._made: dict[str, Array] = {
            "selection": selection_table_once(),
            "offsets": np.empty(of_axes, np.int64),
            "bounds": np.empty(parts + 1, np.int64),
            "enough": np.empty(parts, np.int64),
            **{name: np.atleast_1d(np.ascontiguousarray(values)) for name, values in space.items()},
        }
        self._of_entries: dict[str, tuple[int, Any]] = {
            "positions": (dimension, np.float64),
            "coordinates": (dimension, np.float64),
            "wall": (1, np.uint8),
            **dict.fromkeys(("source", "order", "cell", "unsorted", "entry", "target", "numbers"), (1, np.int32)),
        }
        self._make_for_entries()
        self._make_for_cells(1000)
        self._make_for_pairs(0)

    def add_numbers(self, array: Array) -> str:
        """Keep an array of numbers that does not change; its name."""
        name = f"numbers {len(self._made)}"
        self._made[name] = np.ascontiguousarray(array)
        return name

    def number(self, name: str) -> float:
        """A number of the space."""
        return float(self._made[name][0])

    def for_entries(self, name: str, columns: int) -> None:
        """Have a table with a row for each entry; several may use one after the other, with columns of their own."""
        columns = max(columns, self._of_entries.get(name, (1, None))[0])
        self._of_entries[name] = (columns, np.float64)
        self._made[name] = _aligned((int(self.sizes[ENTRY_ROOM]) + PADDING) * columns, np.float64)

    def address(self, name: str) -> int:
        """The place of an array in memory."""
        array = self._fields[name] if name in self._fields else self._made[name]
        return int(array.ctypes.data)

    def grow(self, status: int) -> None:
        """Make room for as many rows as a stage wanted; what was in the arrays is lost, and computed again."""
        wanted = int(self.sizes[WANTED])
        if status == MORE_ENTRIES:
            self.sizes[ENTRY_ROOM] = wanted
            self._make_for_entries()
            self._make_for_pairs(0)
        elif status == MORE_CELLS:
            self._make_for_cells(wanted)
        else:
            share = int(self.sizes[LISTED]) // int(self.sizes[PARTS]) + 1
            self._make_for_pairs(max(wanted, int(1.05 * share * self._neighbours)))

    def _make_for_entries(self) -> None:
        room = int(self.sizes[ENTRY_ROOM]) + PADDING
        for name, (columns, dtype) in self._of_entries.items():
            self._made.pop(name, None)  # before the new one is made
            self._made[name] = _aligned(room * columns, dtype)

    def _make_for_cells(self, room: int) -> None:
        self.sizes[CELL_ROOM] = room
        for name in ("start", "following"):
            self._made[name] = np.empty(room + 1, np.int64)

    def _make_for_pairs(self, room: int) -> None:
        parts, entries = int(self.sizes[PARTS]), int(self.sizes[ENTRY_ROOM])
        self.sizes[PAIR_ROOM] = room
        self._made.pop("neighbour", None)
        self._made["neighbour"] = np.empty((parts, room + SLACK), np.int32)
        self._made["first"] = np.empty((parts, entries // parts + 2), np.int64)


def _aligned(count: int, dtype: Any) -> Array:
    """Zeros that begin at a cache line: records are loaded by whole vectors."""
    memory = np.zeros(count * np.dtype(dtype).itemsize + CACHE_LINE, np.uint8)
    offset = -memory.ctypes.data % CACHE_LINE
    return memory[offset : len(memory) - CACHE_LINE + offset].view(dtype)
