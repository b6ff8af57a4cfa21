"""Explicit vector lanes for Numba: a number type that is one LLVM vector, one neighbour in each lane.

The loop vectoriser of a compiler turns a sum over listed neighbours into gathers, which are slow. With lanes the
engine says itself what is done on 4, 8 or 16 neighbours at once, loads their records whole and transposes them in
registers (`records.py`). Arithmetic and the elementary functions of `sphear.algebra` work on lanes as they do on
floats, and on mixtures of both.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.imputils import lower_builtin
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import intrinsic, models, register_model

from sphear.engine.flags import FASTMATH

INT32, INT64 = ir.IntType(32), ir.IntType(64)


class Lanes(types.Type):
    """The Numba type of `width` numbers of the type `scalar`."""

    def __init__(self, scalar: types.Float, width: int) -> None:
        self.scalar, self.width = scalar, width
        super().__init__(f"Lanes({scalar}, {width})")


@register_model(Lanes)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, manager: Any, lanes: Lanes) -> None:
        scalar = manager.lookup(lanes.scalar).get_value_type()
        super().__init__(manager, lanes, ir.VectorType(scalar, lanes.width))


def integers(values: list[int]) -> ir.Constant:
    """A constant vector of 32-bit integers, as shuffles take it."""
    return ir.Constant(ir.VectorType(INT32, len(values)), values)


def shuffle(builder: Any, a: Any, b: Any, pattern: list[int]) -> Any:
    """The lanes of a and b, one after the other, picked by number."""
    return builder.shuffle_vector(a, b, integers(pattern))


def splat(builder: Any, value: Any, width: int) -> Any:
    """The same value in every lane."""
    empty = ir.Constant(ir.VectorType(value.type, width), ir.Undefined)
    return shuffle(builder, builder.insert_element(empty, value, ir.Constant(INT32, 0)), empty, [0] * width)


def as_lanes(context: Any, builder: Any, value: Any, given: types.Type, lanes: Lanes) -> Any:
    """A value of any number type, in every lane unless it is in lanes already."""
    if isinstance(given, Lanes):
        return value
    return splat(builder, context.cast(builder, value, given, lanes.scalar), lanes.width)


def _first_lanes(arguments: Any) -> Lanes | None:
    if all(isinstance(t, Lanes | types.Number) for t in arguments):
        return next((t for t in arguments if isinstance(t, Lanes)), None)
    return None


def _binary(operation: Callable[..., Any], instruction: str) -> None:
    @infer_global(operation)
    class _Typing(AbstractTemplate):
        key = operation

        def generic(self, args: Any, kws: Any) -> Any:
            lanes = _first_lanes(args)
            return signature(lanes, *args) if lanes and len(args) == 2 else None

    def lower(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        x, y = (as_lanes(context, builder, v, t, sig.return_type) for v, t in zip(args, sig.args, strict=True))
        return getattr(builder, instruction)(x, y, flags=FASTMATH)

    for pair in ((Lanes, Lanes), (Lanes, types.Number), (types.Number, Lanes)):
        lower_builtin(operation, *pair)(lower)


for _operation, _instruction in (("add", "fadd"), ("sub", "fsub"), ("mul", "fmul"), ("truediv", "fdiv")):
    _binary(getattr(operator, _operation), _instruction)


@infer_global(operator.neg)
class _Negation(AbstractTemplate):
    key = operator.neg

    def generic(self, args: Any, kws: Any) -> Any:
        return signature(args[0], args[0]) if isinstance(args[0], Lanes) else None


@lower_builtin(operator.neg, Lanes)
def _negate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    return builder.fneg(args[0], flags=FASTMATH)


def _on_lanes_or_floats(compute: Callable[..., Any]) -> Any:
    """An intrinsic of 1 to 4 numbers that is computed in lanes if any of them is, else on plain floats."""

    def result(arguments: Any) -> Any:
        return _first_lanes(arguments) or next((t for t in arguments if isinstance(t, types.Float)), types.float64)

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        def convert(value: Any, given: types.Type) -> Any:
            if isinstance(sig.return_type, Lanes):
                return as_lanes(context, builder, value, given, sig.return_type)
            return context.cast(builder, value, given, sig.return_type)

        return compute(builder, *(convert(v, t) for v, t in zip(args, sig.args, strict=True)))

    def one(typingctx, a):  # type: ignore[no-untyped-def]
        return result((a,))(a), codegen

    def two(typingctx, a, b):  # type: ignore[no-untyped-def]
        return result((a, b))(a, b), codegen

    def four(typingctx, a, b, c, d):  # type: ignore[no-untyped-def]
        return result((a, b, c, d))(a, b, c, d), codegen

    return intrinsic({2: one, 3: two, 5: four}[compute.__code__.co_argcount])


def _llvm_function(builder: Any, name: str, argument: Any) -> Any:
    kind = argument.type
    width = f"v{kind.count}" if isinstance(kind, ir.VectorType) else ""
    scalar = kind.element if width else kind
    suffix = f"{width}f{32 if isinstance(scalar, ir.FloatType) else 64}"
    function = cgutils.get_or_insert_function(builder.module, ir.FunctionType(kind, [kind]), f"llvm.{name}.{suffix}")
    return builder.call(function, [argument], fastmath=FASTMATH)


def _sqrt(builder: Any, x: Any) -> Any:
    return _llvm_function(builder, "sqrt", x)


def _exp(builder: Any, x: Any) -> Any:
    return _llvm_function(builder, "exp", x)


def _positive_part(builder: Any, x: Any) -> Any:
    zero = ir.Constant(x.type, None) if isinstance(x.type, ir.VectorType) else ir.Constant(x.type, 0.0)
    return builder.select(builder.fcmp_ordered(">", x, zero), x, zero)


def _where_less(builder: Any, a: Any, b: Any, yes: Any, no: Any) -> Any:
    return builder.select(builder.fcmp_ordered("<", a, b), yes, no)


# the elementary functions of sphear.algebra, under the same names
sqrt = _on_lanes_or_floats(_sqrt)
exp = _on_lanes_or_floats(_exp)
positive_part = _on_lanes_or_floats(_positive_part)
where_less = _on_lanes_or_floats(_where_less)


@intrinsic
def lanes_sum(typingctx, lanes):  # type: ignore[no-untyped-def]
    """The sum over the lanes, by halves."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        value, half = args[0], sig.args[0].width // 2
        while half:
            low, high = list(range(half)), list(range(half, 2 * half))
            value = builder.fadd(
                shuffle(builder, value, value, low), shuffle(builder, value, value, high), flags=FASTMATH
            )
            half //= 2
        return builder.extract_element(value, ir.Constant(INT32, 0))

    return lanes.scalar(lanes), codegen


@intrinsic
def first_lanes(typingctx, lanes, count, beyond):  # type: ignore[no-untyped-def]
    """The first `count` lanes as they are, the scalar `beyond` in the others."""

    def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        width = sig.args[0].width
        kept = builder.icmp_signed("<", ir.Constant(ir.VectorType(INT64, width), list(range(width))),
                                   splat(builder, args[1], width))  # fmt: skip
        return builder.select(kept, args[0], as_lanes(context, builder, args[2], sig.args[2], sig.args[0]))

    return lanes(lanes, types.int64, types.float64), codegen


def lane_zeros(dtype: str, width: int) -> Any:
    """A compiled function of nothing: zero in every lane."""
    lanes = Lanes(getattr(types, dtype), width)

    @intrinsic
    def zeros(typingctx):  # type: ignore[no-untyped-def]
        def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            # vectors spilled to a stack of 16-byte alignment cost up to a quarter of a sweep, depending on the call's
            # depth; llvmlite writes alignstack only beside another attribute, and nothing here unwinds
            builder.function.attributes.add("nounwind")
            builder.function.attributes.alignstack = 64
            return ir.Constant(context.get_value_type(lanes), None)

        return lanes(), codegen

    return zeros
