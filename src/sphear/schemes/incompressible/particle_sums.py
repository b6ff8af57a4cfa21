"""Sums over the neighbours of particles at one moment, and matrices of the same weights."""

from __future__ import annotations

from copy import copy
from typing import Any

import numpy as np
from scipy.sparse import csr_array

from sphear.engine.formula import Interaction, Shape
from sphear.engine.sweep import Sweep
from sphear.engine.threads import on_threads
from sphear.engine.weights import pair_weights
from sphear.kernels import Kernel
from sphear.neighbours import Chunk, Domain, Neighbours
from sphear.neighbours.sparse import sparse_rows

Array = np.ndarray[Any, Any]
Prepared = tuple[tuple[Shape, ...], list[Array]]


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
        volume: (P,).
        domain: with its periodic axes; None is open space.
        threads: to compute on.
        coincident: whether a particle may lie where one that is only a neighbour does.
    """

    def __init__(
        self,
        positions: Array,
        count: int,
        kernel: Kernel,
        volume: Array,
        domain: Domain | None,
        threads: int,
        coincident: bool = False,
    ) -> None:
        self.neighbours = Neighbours(
            positions, kernel.radius, domain, threads=threads, rows=count, keep_coincident=coincident
        )
        self.count, self.total = count, len(positions)
        self.domain = domain
        self.positions = positions
        self.kernel = kernel
        self.fields: dict[str, Array] = {"volume": volume}
        self._prepared: dict[Any, Prepared] = {}

    def of(self, chosen: Array) -> ParticleSums:
        """The same for some of the N particles only, those that are True in `chosen`, (N,); sums of others are zero."""
        found = copy(self)
        found.neighbours, found._prepared = self.neighbours.of(chosen), {}
        return found

    def prepared(self, interaction: Any) -> Prepared:
        """The numbers of an interaction that is summed up beforehand, chunk by chunk; summed up once."""
        if interaction not in self._prepared:
            sweep = Sweep(interaction, self.neighbours, self.fields)

            def of(chunk: Chunk) -> Array:
                rows = chunk.end - chunk.begin
                out = np.empty((rows, sweep.outputs))
                sweep.over(chunk, out, np.arange(rows, dtype=np.int32))
                solved: Array = (
                    interaction.solve(out, self.neighbours.dimension) if hasattr(interaction, "solve") else out
                )
                return solved

            numbers = on_threads(of, self.neighbours.chunks, self.neighbours.threads)
            template = (
                interaction.template(self.neighbours.dimension)
                if hasattr(interaction, "solve")
                else sweep.formula.result
            )
            self._prepared[interaction] = (("prepared", template),), numbers
        return self._prepared[interaction]

    def deficient(self, interaction: Any) -> Array:
        """The particles whose neighbours are too few or too uneven for what an interaction prepares of them."""
        lacking = [
            self.neighbours.particles(chunk)[~(numbers[:, 0] > interaction.least_quality)]  # a NaN is deficient too
            for chunk, numbers in zip(self.neighbours.chunks, self.prepared(interaction)[1], strict=True)
        ]
        return np.concatenate(lacking)

    def sum(self, interaction: Interaction, preparation: Any = None, **fields: Array) -> Array:
        """An interaction summed over the neighbours of each of the N particles, (N, numbers of its result)."""
        own, numbers = self.prepared(preparation) if preparation is not None else ((), [])
        sweep = Sweep(interaction, self.neighbours, {**self.fields, **fields}, own)
        some = self.neighbours.count < self.count
        out = (np.zeros if some else np.empty)((self.count, sweep.outputs))

        def add(item: tuple[int, Chunk]) -> None:
            number, chunk = item
            sweep.over(chunk, out, self.neighbours.particles(chunk), numbers[number] if numbers else None)

        on_threads(add, list(enumerate(self.neighbours.chunks)), self.neighbours.threads)
        return out

    def matrix(
        self, interaction: Any, preparation: Any = None, column: Array | None = None, columns: int = 0
    ) -> csr_array:
        """The weights of an interaction; row k is that of particle `neighbours.rows[k]`.

        Args:
            interaction: gives one weight a pair.
            preparation: what it knows of each of the N particles.
            column: (P,), the column of each particle; None is its own number.
            columns: their number; 0 is P.
        """
        own, numbers = self.prepared(preparation) if preparation is not None else ((), [])
        weights = pair_weights(interaction, self.neighbours, self.fields, own=own, prepared=numbers)
        return sparse_rows(self.neighbours, weights[0], columns or self.total, column)
