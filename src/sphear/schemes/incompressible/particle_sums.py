"""Sums over the neighbours of particles at one moment, and weights of their pairs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from copy import copy
from typing import Any, NamedTuple

import numpy as np

from sphear.engine.formula import Interaction, Shape
from sphear.engine.kept_records import Records
from sphear.engine.preparation import NormalEquations, Preparation, form_of
from sphear.engine.preparing import deficient, solved
from sphear.engine.records import copy_columns
from sphear.engine.structure import leaves
from sphear.engine.sweep import Sweep
from sphear.engine.threads import on_threads
from sphear.engine.uniform import with_uniform
from sphear.engine.weights import chunk_weights
from sphear.interactions.joined import Joined
from sphear.kernels import Kernel
from sphear.neighbours import Chunk, Domain, Neighbours

Array = np.ndarray[Any, Any]


class Prepared(NamedTuple):
    """The numbers that are prepared of each particle.

    own: their form, by the names that sums know them by.
    chunks: the numbers of each chunk's rows, (rows, m).
    column: the first of the preparation's own among them.
    """

    own: tuple[Shape, ...]
    chunks: list[Array]
    column: int


NOTHING = Prepared((), [], 0)


def in_box(positions: Array, domain: Domain | None) -> Array:
    """Positions (N, d), those beyond a periodic side moved by whole periods into the box, the others as they are."""
    if domain is None:
        return positions
    low, high, periodic = np.array(domain.lower), np.array(domain.upper), np.array(domain.periodic)
    beyond = np.flatnonzero((periodic & ((positions < low) | (positions >= high))).any(axis=1))
    if not len(beyond):
        return positions
    inside = positions.copy()
    moved = domain.wrapped(positions[beyond])
    inside[beyond] = np.where(periodic & (moved >= high), low, moved)  # a little below the box is, rounded, at its end
    return inside


class ParticleSums:
    """Particles that sums are made for, and others that are only their neighbours.

    Args:
        positions: (P, d), those of the N particles first.
        count: N.
        kernel: with its smoothing length.
        volume: (P,), or one number for all.
        domain: with its periodic axes; None is open space.
        threads: to compute on.
        together: interactions that depend on places and volumes alone: once one is asked for, all are summed.
    """

    def __init__(
        self,
        positions: Array,
        count: int,
        kernel: Kernel,
        volume: Array | float,
        domain: Domain | None,
        threads: int,
        together: Sequence[Any] = (),
    ) -> None:
        self.neighbours = Neighbours(positions, kernel.radius, domain, threads=threads, rows=count)
        self.count, self.total = count, len(positions)
        self.domain = domain
        self.positions = positions
        self.kernel = kernel
        self.volume = volume
        self.fields: dict[str, Array] = {"volume": volume} if isinstance(volume, np.ndarray) else {}
        self._uniform: dict[str, float] = {} if isinstance(volume, np.ndarray) else {"volume": float(volume)}
        self._packing = Records(self.neighbours, self.fields)
        self._together = tuple(dict.fromkeys(together))
        self._places: dict[Any, tuple[Any, int]] = {}
        self._blocks: list[Array] = []
        self._prepared: dict[Any, Prepared] = {}
        self._sums: dict[Any, Array] = {}

    def of(self, some: Array) -> ParticleSums:
        """The same for some of the N particles only, those that are True in `some`, (N,); sums of others are zero."""
        result = copy(self)
        result.neighbours = self.neighbours.of(some)
        result._together, result._prepared, result._sums = (), {}, {}
        return result

    def uniform(self, **numbers: float) -> None:
        """Give all particles fields that are the same everywhere, if they have none of the name."""
        for name, number in numbers.items():
            if name not in self.fields:
                self._uniform[name] = number

    def _given(self, interaction: Any, fields: Iterable[str] = ()) -> Any:
        """The interaction with all fields that are the same everywhere, but those that are given otherwise."""
        return with_uniform(interaction, tuple(item for item in self._uniform.items() if item[0] not in fields))

    def prepared(self, preparation: Interaction) -> Prepared:
        """The form and the numbers, chunk by chunk, of what is prepared of each particle; summed up once."""
        if preparation not in self._prepared:
            self._prepared[preparation] = self._prepare(preparation)
        return self._prepared[preparation]

    def _prepare(self, preparation: Interaction) -> Prepared:
        if preparation in self._together:
            sums, column = self._place(preparation)
            chunks = self._blocks
        else:
            (sums, chunks), column = self._chunks_of(preparation), 0
        if isinstance(preparation, NormalEquations):
            dimension, size = self.neighbours.dimension, len(list(leaves(sums)))
            chunks = on_threads(
                lambda numbers: solved(
                    preparation, np.ascontiguousarray(numbers[:, column : column + size]), dimension
                ),
                chunks,
                self.neighbours.threads,
            )
            return Prepared((("prepared", form_of(preparation, dimension, sums)),), chunks, 0)
        before: tuple[Shape, ...] = (("numbers_before", (0.0,) * column),) if column else ()
        return Prepared((*before, ("prepared", sums)), chunks, column)

    def _place(self, interaction: Any) -> tuple[Any, int]:
        """The form of a result of those that are summed together, and its first column among theirs."""
        if not self._places:
            results, self._blocks = self._chunks_of(Joined(self._together))
            column = 0
            for part, result in zip(self._together, results, strict=True):
                self._places[part] = result, column
                column += len(list(leaves(result)))
        return self._places[interaction]

    def _chunks_of(self, interaction: Any) -> tuple[Any, list[Array]]:
        """Sum up what depends on the particles alone: the form of a result, and the numbers of each chunk's rows."""
        sweep = Sweep(self._given(interaction), self.neighbours, self.fields, packing=self._packing)

        def of(chunk: Chunk) -> Array:
            rows = chunk.end - chunk.begin
            out = np.empty((rows, sweep.outputs))
            sweep.over(chunk, out, np.arange(rows, dtype=np.int32))
            return out

        return sweep.formula.result, on_threads(of, self.neighbours.chunks, self.neighbours.threads)

    def deficient(self, preparation: Preparation) -> Array:
        """The particles whose neighbours are too few or too uneven for a preparation."""
        prepared = self.prepared(preparation)
        chunks = zip(self.neighbours.chunks, prepared.chunks, strict=True)
        return np.concatenate(
            [
                self.neighbours.particles(chunk)[deficient(preparation, numbers[:, prepared.column :])]
                for chunk, numbers in chunks
            ]
        )

    def sum(self, interaction: Interaction, preparation: Any = None, **fields: Array) -> Array:
        """An interaction summed over the neighbours of each of the N particles, (N, numbers of its result)."""
        if interaction in self._together and not fields:
            return self._of_together(interaction)
        own, numbers, _ = self.prepared(preparation) if preparation is not None else NOTHING
        given = self._given(interaction, fields)
        sweep = Sweep(given, self.neighbours, {**self.fields, **fields}, own, packing=self._packing)
        some = self.neighbours.count < self.count
        out = (np.zeros if some else np.empty)((self.count, sweep.outputs))

        def add(item: tuple[int, Chunk]) -> None:
            number, chunk = item
            sweep.over(chunk, out, self.neighbours.particles(chunk), numbers[number] if numbers else None)

        on_threads(add, list(enumerate(self.neighbours.chunks)), self.neighbours.threads)
        return out

    def weights(self, interaction: Any, preparation: Interaction | None = None) -> list[Array]:
        """The weights of an interaction's pairs, an array (pairs and a few more,) a chunk of the pair list.

        Args:
            interaction: gives one weight a pair.
            preparation: what it knows of each of the N particles.
        """
        own, numbers, _ = self.prepared(preparation) if preparation is not None else NOTHING
        parts = chunk_weights(
            self._given(interaction), self.neighbours, self.fields, own=own, prepared=numbers, packing=self._packing
        )
        return [part[0] for part in parts]

    def _of_together(self, interaction: Any) -> Array:
        if interaction not in self._sums:
            result, column = self._place(interaction)
            out = np.empty((self.count, len(list(leaves(result)))))

            def copy(number: int) -> None:
                target = self.neighbours.particles(self.neighbours.chunks[number])
                copy_columns(self._blocks[number], column, target, out)

            on_threads(copy, range(len(self._blocks)), self.neighbours.threads)
            self._sums[interaction] = out
        return self._sums[interaction]
