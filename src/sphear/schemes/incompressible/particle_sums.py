"""Sums over the neighbours of particles at one moment, and matrices of the same weights."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.sparse import csr_array

from sphear.engine.formula import Interaction, Shape
from sphear.engine.preparation import Preparation
from sphear.engine.preparing import PreparationSweep, deficient
from sphear.engine.sweep import Sweep
from sphear.engine.threads import on_threads
from sphear.engine.weights import chunk_weights, pair_weights
from sphear.kernels import Kernel
from sphear.neighbours import Chunk, Domain, Neighbours
from sphear.neighbours.sparse import sparse_rows

Array = np.ndarray[Any, Any]
Prepared = tuple[tuple[Shape, ...], list[Array]]  # the form of a particle's numbers, and these chunk by chunk


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
        self._prepared: dict[Interaction, Prepared] = {}

    def prepared(self, preparation: Interaction) -> Prepared:
        """The form and the numbers of what is prepared of each particle; summed up once."""
        if preparation not in self._prepared:
            sweep = PreparationSweep(preparation, self.neighbours, self.fields)
            numbers = on_threads(sweep.over, self.neighbours.chunks, self.neighbours.threads)
            self._prepared[preparation] = sweep.template, numbers
        return self._prepared[preparation]

    def deficient(self, preparation: Preparation) -> Array:
        """The particles whose neighbours are too few or too uneven for a preparation."""
        chunks = zip(self.neighbours.chunks, self.prepared(preparation)[1], strict=True)
        return np.concatenate(
            [self.neighbours.particles(chunk)[deficient(preparation, numbers)] for chunk, numbers in chunks]
        )

    def sum(self, interaction: Interaction, preparation: Interaction | None = None, **fields: Array) -> Array:
        """An interaction summed over the neighbours of each of the N particles, (N, numbers of its result)."""
        own, numbers = self.prepared(preparation) if preparation is not None else ((), [])
        sweep = Sweep(interaction, self.neighbours, {**self.fields, **fields}, own)
        out = np.empty((self.count, sweep.outputs))

        def add(item: tuple[int, Chunk]) -> None:
            number, chunk = item
            sweep.over(chunk, out, self.neighbours.particles(chunk), numbers[number] if numbers else None)

        on_threads(add, list(enumerate(self.neighbours.chunks)), self.neighbours.threads)
        return out

    def weights(self, interaction: Any, preparation: Any = None) -> list[Array]:
        """The weights of an interaction's pairs, an array (pairs and a few more,) a chunk of the pair list.

        Args:
            interaction: gives one weight a pair.
            preparation: what it knows of each of the N particles.
        """
        own, numbers = self.prepared(preparation) if preparation is not None else ((), [])
        parts = chunk_weights(interaction, self.neighbours, self.fields, own=own, prepared=numbers)
        return [part[0] for part in parts]

    def matrix(
        self, interaction: Any, preparation: Interaction | None = None, column: Array | None = None, columns: int = 0
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
