"""One sweep: an interaction summed over the pairs of particles, compiled once for each kind of interaction."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, lru_cache
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.engine.cache import generated_module
from sphear.engine.formula import Interaction, Shape, TracedFormula, traced
from sphear.engine.kept_records import Fields, Records
from sphear.engine.program import sweep_text
from sphear.engine.records import empty_records
from sphear.engine.structure import parameters
from sphear.engine.threads import on_threads

if TYPE_CHECKING:
    from sphear.neighbours import Chunk, Neighbours

Array = np.ndarray[Any, Any]

FAR = 1.001  # supports: where lanes without a neighbour are put


@cache
def _compiled(formula: TracedFormula, title: str, dimension: int, dtype: str) -> ModuleType:
    return generated_module(sweep_text(formula, title, dimension, dtype))


@lru_cache(maxsize=512)
def _ready(
    interaction: Interaction, dimension: int, shared: tuple[Shape, ...], own: tuple[Shape, ...], once: bool, dtype: str
) -> tuple[TracedFormula, Array]:
    """The traced formula of an interaction and its parameters: looked up in every step of a small flow."""
    formula = traced(interaction, dimension, shared, own, both_sides=once)
    return formula, np.array(parameters(interaction) or [0.0], dtype)


def shape_of(values: Array) -> Any:
    """The structure of one particle's value: 0.0 for an array (N,), a tuple of zeros for (N, k)."""
    return 0.0 if values.ndim == 1 else (0.0,) * values.shape[1]


@dataclass
class Sweep:
    """An interaction with the fields of all particles, ready to be summed over any chunk of the pair list.

    Args:
        interaction: what is summed.
        neighbours: the pairs.
        fields: arrays (N,) or (N, k) by the names under which the interaction knows them.
        own: structure of the prepared coefficients, by name; their arrays are given chunk by chunk.
        each_pair_once: compute both sides of a pair together; not with prepared coefficients, which are of one side.
        dtype: "float64" or "float32": what the sums are computed in.
        packing: keeps what stays from sweep to sweep, in numbers of the same dtype; None packs all anew.
    """

    interaction: Interaction
    neighbours: Neighbours
    fields: Fields
    own: tuple[Shape, ...] = ()
    each_pair_once: bool = False
    dtype: str = "float64"
    packing: Records | None = None

    def __post_init__(self) -> None:
        shared = tuple((name, shape_of(values)) for name, values in self.fields.items())
        dimension = self.neighbours.dimension
        interaction: Any = self.interaction  # a frozen dataclass, which is hashable
        self.formula, self.parameters = _ready(
            interaction, dimension, shared, self.own, self.each_pair_once, self.dtype
        )
        self.module = self._module()
        packing = Records(self.neighbours, {}, self.dtype) if self.packing is None else self.packing
        self.records = packing.packed(self.formula.columns, self.fields, with_position=True)
        self.private = packing.packed(self.formula.private, self.fields)

    def _module(self) -> ModuleType:
        """The compiled code."""
        return _compiled(self.formula, type(self.interaction).__name__, self.neighbours.dimension, self.dtype)

    @property
    def outputs(self) -> int:
        """The number of numbers in the result of a particle."""
        return len(self.formula.finish_outputs)

    def over(self, chunk: Chunk, out: Array, target: Array, own: Array | None = None) -> None:
        """Sum over one chunk and write each row's result to a row of `out`.

        Args:
            chunk: a part of the pair list.
            out: (any, outputs), written to.
            target: (rows of the chunk,), which row of `out`.
            own: (rows of the chunk, m), the prepared coefficients.
        """
        if own is None:
            own = np.empty((0, 0), self.dtype)
        self.module.sweep(
            self.parameters, FAR * self.neighbours.support, self.records, self.private, own, out, target,
            self.neighbours.entry, chunk.first, chunk.neighbour, chunk.begin, chunk.end, chunk.begin,
        )  # fmt: skip

    def everywhere(self) -> Array:
        """The result of all particles, (N, outputs), in their own order."""
        out = np.empty((self.neighbours.count, self.outputs), self.dtype)
        if self.each_pair_once:
            self._once(out)
            return out

        def job(chunk: Chunk) -> None:
            self.over(chunk, out, self.neighbours.particles(chunk))

        on_threads(job, self.neighbours.chunks, self.neighbours.threads)
        return out

    def _once(self, out: Array) -> None:
        """Add up both sides of all pairs, then finish each particle."""
        neighbours, chunks = self.neighbours, self.neighbours.chunks_once
        sums = empty_records(len(neighbours.source), len(self.formula.pair_outputs), self.dtype)
        sums.fill(0.0)

        def add(chunk: Chunk) -> None:
            self.module.sweep(
                self.parameters, FAR * neighbours.support, self.records, self.private, sums, neighbours.entry,
                chunk.first, chunk.neighbour, chunk.begin, chunk.end, chunk.begin,
            )  # fmt: skip

        def finish(chunk: Chunk) -> None:
            self.module.finish(
                self.parameters, self.records, self.private, sums, out, neighbours.particles(chunk), neighbours.entry,
                chunk.begin, chunk.end, chunk.begin,
            )  # fmt: skip

        threads = neighbours.threads
        if threads > 1 and neighbours.alternating:
            on_threads(add, chunks[::2], threads)
            on_threads(add, chunks[1::2], threads)
        else:
            on_threads(add, chunks, 1)
        on_threads(finish, chunks, threads)


def sweep(
    interaction: Interaction,
    neighbours: Neighbours,
    *,
    each_pair_once: bool = False,
    dtype: str = "float64",
    **fields: Array,
) -> Array:
    """The interaction summed over the neighbours of every particle, (N, numbers of its result)."""
    return Sweep(interaction, neighbours, fields, each_pair_once=each_pair_once, dtype=dtype).everywhere()
