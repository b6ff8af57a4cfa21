"""Weights of pairs: what an interaction gives for each listed pair, kept pair by pair: the rows of a sparse matrix."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np
from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from sphear.engine.cache import generated_module
from sphear.engine.formula import Shape, TracedFormula
from sphear.engine.kept_records import Records
from sphear.engine.lanes import INT64, Lanes, as_lanes
from sphear.engine.program import weights_text
from sphear.engine.sweep import FAR, Sweep
from sphear.engine.threads import on_threads

if TYPE_CHECKING:
    from sphear.neighbours import Chunk, Neighbours

Array = np.ndarray[Any, Any]

SLACK = 16  # numbers that are written behind those of the last pair


def lane_storer(width: int, components: int) -> Any:
    """A compiled function (values, k, numbers) that writes lanes to values[c, k : k + width], one row a component."""

    @intrinsic
    def store(typingctx, values, k, numbers):  # type: ignore[no-untyped-def]
        lanes = Lanes(values.dtype, width)

        def codegen(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            table = context.make_array(sig.args[0])(context, builder, args[0])
            size = ir.Constant(INT64, 8 if values.dtype == types.float64 else 4)
            stride = builder.sdiv(builder.extract_value(table.strides, 0), size)
            for component in range(components):
                number = builder.extract_value(args[2], component)
                value = as_lanes(context, builder, number, sig.args[2][component], lanes)
                row = builder.gep(table.data, [builder.mul(stride, ir.Constant(INT64, component))])
                address = builder.bitcast(builder.gep(row, [args[1]]), value.type.as_pointer())
                stored = builder.store(value, address)
                stored.align = 8 if values.dtype == types.float64 else 4
            return context.get_dummy_value()

        return types.void(values, types.int64, numbers), codegen

    return store


@cache
def _compiled(formula: TracedFormula, title: str, dimension: int, dtype: str) -> ModuleType:
    return generated_module(weights_text(formula, title, dimension, dtype))


class PairWeights(Sweep):
    """The weights that an interaction's `pair` gives for each listed pair, one row of numbers a component.

    Used as a `Sweep`; the interaction is a `Weights`.
    """

    def _module(self) -> ModuleType:
        return _compiled(self.formula, type(self.interaction).__name__, self.neighbours.dimension, self.dtype)

    def of(self, chunk: Chunk, own: Array | None = None) -> Array:
        """The weights of a chunk's pairs, (components, pairs), in the order of its list.

        Args:
            chunk: a part of the pair list.
            own: (rows of the chunk, m), the prepared coefficients.
        """
        values = np.empty((len(self.formula.pair_outputs), chunk.pairs + SLACK), self.dtype)
        if own is None:
            own = np.empty((0, 0), self.dtype)
        self.module.weights(
            self.parameters, FAR * self.neighbours.support, self.records, self.private, own, values,
            self.neighbours.entry, chunk.first, chunk.neighbour, chunk.begin, chunk.end, chunk.begin,
        )  # fmt: skip
        return values[:, : chunk.pairs]


def chunk_weights(
    interaction: Any,
    neighbours: Neighbours,
    fields: Mapping[str, Array],
    *,
    own: tuple[Shape, ...] = (),
    prepared: Sequence[Array] = (),
    packing: Records | None = None,
) -> list[Array]:
    """The weights of the pairs of each chunk of the pair list, (components, pairs).

    Args:
        interaction: gives the weights.
        neighbours: the pairs.
        fields: arrays (N,) or (N, k), by name.
        own: structure of the prepared coefficients.
        prepared: their numbers, one array (rows, m) a chunk.
        packing: keeps what stays from sweep to sweep; None packs all anew.
    """
    weights = PairWeights(interaction, neighbours, fields, own, packing=packing)
    numbered = list(enumerate(neighbours.chunks))
    return on_threads(
        lambda item: weights.of(item[1], prepared[item[0]] if prepared else None), numbered, neighbours.threads
    )
