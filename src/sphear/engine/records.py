"""Neighbours' records: all that a pair needs of a particle, side by side in memory, loaded whole into lanes."""

from __future__ import annotations

from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from sphear.engine.cache import compiled
from sphear.engine.flags import FASTMATH
from sphear.engine.lanes import INT64, Lanes, shuffle

CHUNK = 4  # columns that are loaded and transposed together


def record_loader(width: int, columns: int) -> Any:
    """A compiled function (records, neighbour, k) -> `columns` lanes, of the neighbours k ... k + width - 1.

    Each record is read with whole-vector loads; 4 x 4 transposes in registers turn the records of `width` neighbours
    into columns. This replaces one gather a column, and is what makes a sweep over a pair list fast.
    """

    @intrinsic
    def load(typingctx, records, neighbour, k):  # type: ignore[no-untyped-def]
        lanes = Lanes(records.dtype, width)
        size = 8 if records.dtype == types.float64 else 4

        def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            table = context.make_array(sig.args[0])(context, builder, args[0])
            listed = context.make_array(sig.args[1])(context, builder, args[1])
            stride = builder.sdiv(builder.extract_value(table.strides, 0), ir.Constant(INT64, size))
            base = builder.gep(listed.data, [args[2]])
            numbers = [builder.load(builder.gep(base, [ir.Constant(INT64, lane)])) for lane in range(width)]
            rows = [builder.gep(table.data, [builder.mul(builder.zext(n, INT64), stride)]) for n in numbers]
            result: list[Any] = []
            for begin in range(0, columns, CHUNK):
                chunk = [_load(builder, row, begin, context.get_value_type(records.dtype), size) for row in rows]
                result += _transposed(builder, chunk)
            return context.make_tuple(builder, sig.return_type, result[:columns])

        return types.UniTuple(lanes, columns)(records, neighbour, types.int64), codegen

    return load


def record_adder(width: int, columns: int) -> Any:
    """A compiled function (sums, neighbour, k, lanes) that adds `columns` lanes to the neighbours' rows of `sums`.

    The way back of `record_loader`: columns are transposed into one vector of 4 numbers a neighbour. The neighbours of
    one particle are all different, so no two lanes add to the same row.
    """

    @intrinsic
    def add(typingctx, sums, neighbour, k, values):  # type: ignore[no-untyped-def]
        def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            table = context.make_array(sig.args[0])(context, builder, args[0])
            listed = context.make_array(sig.args[1])(context, builder, args[1])
            base = builder.gep(listed.data, [args[2]])
            lanes = [builder.extract_value(args[3], column) for column in range(columns)]
            stride = ir.Constant(INT64, -(-columns // CHUNK) * CHUNK)
            for begin in range(0, columns, CHUNK):
                chunk = lanes[begin : begin + CHUNK]
                chunk += [ir.Constant(chunk[0].type, None)] * (CHUNK - len(chunk))
                for lane in range(width):
                    group = lane - lane % CHUNK
                    if lane == group:
                        picked = list(range(group, group + CHUNK))
                        rows = _transposed(builder, [shuffle(builder, x, x, picked) for x in chunk])
                    number = builder.load(builder.gep(base, [ir.Constant(INT64, lane)]))
                    row = builder.gep(table.data, [builder.mul(builder.zext(number, INT64), stride)])
                    address = builder.bitcast(
                        builder.gep(row, [ir.Constant(INT64, begin)]), rows[lane - group].type.as_pointer()
                    )
                    before = builder.load(address)
                    after = builder.fadd(before, rows[lane - group], flags=FASTMATH)
                    stored = builder.store(after, address)
                    before.align = stored.align = CHUNK * (8 if sums.dtype == types.float64 else 4)
            return context.get_dummy_value()

        return types.void(sums, neighbour, types.int64, values), codegen

    return add


def _load(builder: Any, row: Any, begin: int, scalar: Any, size: int) -> Any:
    vector = ir.VectorType(scalar, CHUNK)
    address = builder.bitcast(builder.gep(row, [ir.Constant(INT64, begin)]), vector.as_pointer())
    value = builder.load(address)
    value.align = CHUNK * size
    return value


def _transposed(builder: Any, rows: list[Any]) -> list[Any]:
    """From one vector of 4 columns a neighbour to one vector of all neighbours a column."""
    parts = []
    for a, b, c, d in zip(*(rows[k::CHUNK] for k in range(CHUNK)), strict=True):
        even_ab, odd_ab = shuffle(builder, a, b, [0, 4, 2, 6]), shuffle(builder, a, b, [1, 5, 3, 7])
        even_cd, odd_cd = shuffle(builder, c, d, [0, 4, 2, 6]), shuffle(builder, c, d, [1, 5, 3, 7])
        parts.append(
            [shuffle(builder, x, y, pattern) for pattern in ([0, 1, 4, 5], [2, 3, 6, 7])
             for x, y in ((even_ab, even_cd), (odd_ab, odd_cd))]
        )  # fmt: skip
    while len(parts) > 1:
        parts = [
            [shuffle(builder, x, y, list(range(2 * x.type.count))) for x, y in zip(low, high, strict=True)]
            for low, high in zip(parts[::2], parts[1::2], strict=True)
        ]
    return parts[0]


@compiled
def _pack(records, column, values, source, begin, end):  # type: ignore[no-untyped-def]  # pragma: no cover
    for entry in range(begin, end):
        i = np.uint64(source[entry])  # unsigned, so that no index is tested for wrapping around
        for k in range(values.shape[1]):
            records[entry, column + k] = values[i, k]


@compiled
def copy_columns(values, column, target, out):  # type: ignore[no-untyped-def]  # pragma: no cover
    """Write columns of values (M, m), as many as `out` has and from `column` on, to the rows `target` (M,) of it."""
    for row in range(len(values)):
        for k in range(out.shape[1]):
            out[target[row], k] = values[row, column + k]


@compiled
def _pack_positions(records, coordinates, middle):  # type: ignore[no-untyped-def]  # pragma: no cover
    for axis in range(len(coordinates)):
        origin = coordinates[axis, middle]
        for entry in range(len(records)):
            records[entry, axis] = coordinates[axis, entry] - origin


def record_width(columns: int) -> int:
    """Columns rounded up to whole chunks."""
    return -(-columns // CHUNK) * CHUNK


def empty_records(entries: int, columns: int, dtype: str) -> np.ndarray[Any, Any]:
    """Uninitialised records, (entries, columns rounded up to whole chunks), aligned to cache lines."""
    columns = record_width(columns)
    if not columns:
        return np.empty((entries, 0), dtype)
    item = np.dtype(dtype).itemsize
    memory = np.empty(entries * columns * item + 64, np.uint8)
    offset = -memory.ctypes.data % 64
    return memory[offset : offset + entries * columns * item].view(dtype).reshape(entries, columns)


def pack(
    records: np.ndarray[Any, Any], column: int, values: np.ndarray[Any, Any], source: np.ndarray[Any, Any]
) -> None:
    """Copy the field `values`, (N,) or (N, k), into the records from `column` on."""
    if values.ndim == 1:
        values = values[:, None]
    _pack(records, column, values, source, 0, len(records))


def pack_positions(records: np.ndarray[Any, Any], coordinates: np.ndarray[Any, Any]) -> None:
    """Copy coordinates, (d, entries or more), into the first columns of the records.

    They are taken from some particle in their midst, so that single precision spends no digits on a common offset.
    """
    if len(records):
        _pack_positions(records, coordinates, len(records) // 2)
