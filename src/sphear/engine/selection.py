"""Keeps the numbers of those candidates, eight at a time, whose squared distance is within bounds: the pair list."""

from __future__ import annotations

from typing import Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from sphear.engine.lanes import INT32, INT64, Lanes, as_lanes, splat

WIDTH = 8
INT8 = ir.IntType(8)


def selection_table() -> np.ndarray[Any, Any]:
    """For each of the 256 sets of eight candidates: the positions of those in the set, first. Shape (256, 8)."""
    table = np.zeros((256, WIDTH), np.uint8)
    for chosen in range(256):
        positions = [bit for bit in range(WIDTH) if chosen >> bit & 1]
        table[chosen, : len(positions)] = positions
    return table


@intrinsic
def load_lanes(typingctx, row, j):  # type: ignore[no-untyped-def]
    """Elements j ... j + 7 of a contiguous array."""
    lanes = Lanes(row.dtype, WIDTH)

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        array = context.make_array(sig.args[0])(context, builder, args[0])
        vector = context.get_value_type(lanes)
        value = builder.load(builder.bitcast(builder.gep(array.data, [args[1]]), vector.as_pointer()))
        value.align = 8
        return value

    return lanes(row, types.int64), codegen


@intrinsic
def between(typingctx, value, low, high, count):  # type: ignore[no-untyped-def]
    """A bit for each of the first `count` lanes, set where low < value < high."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        lanes = sig.args[0]
        below, above = (as_lanes(context, builder, args[k], sig.args[k], lanes) for k in (1, 2))
        numbers = ir.Constant(ir.VectorType(INT64, WIDTH), list(range(WIDTH)))
        kept = builder.and_(builder.fcmp_ordered(">", args[0], below), builder.fcmp_ordered("<", args[0], above))
        kept = builder.and_(kept, builder.icmp_signed("<", numbers, splat(builder, args[3], WIDTH)))
        return builder.zext(builder.bitcast(kept, ir.IntType(WIDTH)), INT64)

    return types.int64(value, types.float64, types.float64, types.int64), codegen


@intrinsic
def once_only(typingctx, image, j, i):  # type: ignore[no-untyped-def]
    """A bit for each of the candidates j ... j + 7, set for those after i and for periodic images.

    A pair of particles is then listed from one side only, a pair with an image from the side of the particle.
    """

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        array = context.make_array(sig.args[0])(context, builder, args[0])
        bytes_ = builder.load(
            builder.bitcast(builder.gep(array.data, [args[1]]), ir.VectorType(INT8, WIDTH).as_pointer()), align=1
        )
        is_image = builder.icmp_unsigned("!=", bytes_, ir.Constant(bytes_.type, None))
        numbers = ir.Constant(ir.VectorType(INT64, WIDTH), list(range(WIDTH)))
        after = builder.icmp_signed(">", numbers, splat(builder, builder.sub(args[2], args[1]), WIDTH))
        return builder.zext(builder.bitcast(builder.or_(is_image, after), ir.IntType(WIDTH)), INT64)

    return types.int64(image, types.int64, types.int64), codegen


@intrinsic
def population(typingctx, bits):  # type: ignore[no-untyped-def]
    """The number of bits that are set."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return builder.ctpop(args[0])

    return types.int64(types.int64), codegen


@intrinsic
def store_selected(typingctx, numbers, at, first, bits, table):  # type: ignore[no-untyped-def]
    """Write the numbers first + (positions of the set bits) to numbers[at:].

    All eight are written, without a branch; those that are not selected are overwritten by the next call.
    """

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        target = context.make_array(sig.args[0])(context, builder, args[0])
        lookup = context.make_array(sig.args[4])(context, builder, args[4])
        row = builder.gep(lookup.data, [builder.mul(args[3], ir.Constant(INT64, WIDTH))])
        positions = builder.load(builder.bitcast(row, ir.VectorType(INT8, WIDTH).as_pointer()))
        positions.align = WIDTH
        vector = ir.VectorType(INT32, WIDTH)
        chosen = builder.add(builder.zext(positions, vector), splat(builder, builder.trunc(args[2], INT32), WIDTH))
        address = builder.bitcast(builder.gep(target.data, [args[1]]), vector.as_pointer())
        builder.store(chosen, address).align = 4
        return context.get_dummy_value()

    return types.void(numbers, types.int64, types.int64, types.int64, table), codegen


__all__ = ["WIDTH", "between", "load_lanes", "population", "selection_table", "store_selected"]
