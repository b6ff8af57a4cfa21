"""The matrix of a pressure equation that is never put together: its products walk the pair list.

A row is sum_j w_ij (p_j - p_i) over the listed neighbours of a particle. Of these some are periodic images, whose
pressure is the particle's, and some wall particles, whose pressure is a sum over the fluid. A product therefore gathers
the pressures of all entries of the list first, from the unknowns and by the walls' rows, and then sums weights over
pairs as they are listed. What had to be sorted into columns, merged and copied in every step is not any more, and
several threads share the rows.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy.sparse import csr_array, dia_array, vstack

from sphear.engine.threads import on_threads
from sphear.neighbours import Chunk
from sphear.neighbours.sparse import sparse_rows
from sphear.pressure import pair_loops
from sphear.pressure.rows import ALONE, FINE, NOT_NEUTRAL, Fault, fault_of, moments

Array = np.ndarray[Any, Any]


class WallRows(NamedTuple):
    """Pressures of wall particles as sums over the unknowns, in compressed rows.

    starts: (W + 1,), where each row begins.
    columns: (m,), the unknowns.
    shares: (m,), of each.
    """

    starts: Array
    columns: Array
    shares: Array


class PairRows:
    """Rows sum_j w_ij (p_j - p_i) over a pair list, wall particles put in as p_w = sum_k m_wk p_k + jump_w.

    A wall particle whose row is empty is left out; so are those that would make a diagonal positive, as can be in a
    narrow corner. Where the pressure is fixed, at zero, a row holds its diagonal only.

    Args:
        chunks: the pair list of the R rows, which are the first unknowns.
        weights: w_ij, an array a chunk, in the order of its list; those that rows do not have are set to zero.
        unknown: (E,), of each entry of the list its unknown; of wall particle w it is the number of unknowns + w.
        walls: m_wk, over the unknowns.
        jump: (W,).
        fixed: (n,), where the pressure is zero.
        outside: (R,), added to the diagonal.
        others: (n - R, n), the rows of unknowns that have no pairs.
        threads: to compute on.

    Attributes:
        jump_terms: (n,), sum_w w_iw jump_w, which belongs to the matrix's side of the equation.
    """

    def __init__(
        self,
        chunks: list[Chunk],
        weights: list[Array],
        unknown: Array,
        walls: WallRows,
        jump: Array,
        fixed: Array,
        outside: Array,
        others: csr_array | None = None,
        threads: int = 1,
    ) -> None:
        self.chunks, self.weights, self.threads = chunks, weights, threads
        self.unknown = unknown.view(np.uint32)
        self.unknowns = len(fixed)
        self.others = csr_array((0, self.unknowns)) if others is None else others
        self.rows = self.unknowns - self.others.shape[0]
        walls = WallRows(walls.starts.astype(np.uint32), walls.columns.astype(np.uint32), walls.shares)
        behind, some_fixed = len(walls.starts) - 1, bool(fixed.any())
        sums, seen = np.empty(behind), np.empty(behind, np.bool_)
        pair_loops.row_sums(walls.starts, walls.shares, sums, seen)
        if some_fixed:
            walls = walls._replace(shares=np.where(fixed[walls.columns], 0.0, walls.shares))
        self.walls = walls
        self._pressures, self._behind = np.empty(len(unknown)), np.empty(behind)
        self._own, self._diagonal = np.empty(self.rows), np.empty(self.unknowns)
        self._kinds, self._neutral = np.empty(self.rows, np.int8), np.empty(self.rows, np.bool_)
        self.jump_terms = np.zeros(self.unknowns)

        def prepare(number: int) -> None:
            pair_loops.prepare(
                *self._listed(number), self.unknown, self.unknowns, *self.walls, seen, sums, jump, fixed, some_fixed,
                outside, self._own, self._diagonal, self.jump_terms, self._kinds, self._neutral,
            )  # fmt: skip

        on_threads(prepare, range(len(chunks)), threads)
        self._diagonal[self.rows :] = self.others.diagonal(self.rows)

    def _listed(self, number: int) -> tuple[int, int, Array, Array, Array]:
        chunk = self.chunks[number]
        # unsigned, so that no index is tested for counting from the end
        return (
            chunk.begin,
            chunk.end,
            chunk.first.view(np.uint64),
            chunk.neighbour.view(np.uint32),
            self.weights[number],
        )

    @property
    def shape(self) -> tuple[int, ...]:
        """The number of unknowns twice, (n, n)."""
        return self.unknowns, self.unknowns

    def times(self, vector: Array) -> Array:
        """The product (n,) with a vector (n,)."""
        result = np.empty(self.unknowns)
        pair_loops.spread(vector, self.unknown, *self.walls, self._behind, self._pressures)

        def sum_pairs(number: int) -> None:
            pair_loops.sum_pairs(*self._listed(number), self._own, self._pressures, vector, result)

        on_threads(sum_pairs, range(len(self.chunks)), self.threads)
        if self.rows < self.unknowns:
            result[self.rows :] = self.others @ vector
        return result

    def diagonal(self) -> Array:
        """The diagonal (n,)."""
        return self._diagonal

    def first_fault(self, singular: bool) -> Fault:
        """The first row that a pressure equation cannot have."""
        kinds = self._kinds
        if singular:
            kinds = np.where((kinds == FINE) & ~self._neutral, NOT_NEUTRAL, kinds)
        else:  # a particle by itself is none where its pressure is given
            kinds = np.where((kinds == ALONE) & (self._own < 0.0), FINE, kinds)
        row = int(np.argmax(kinds != FINE)) if self.rows else 0
        if self.rows and kinds[row] != FINE:
            return Fault(row, int(kinds[row]), bool(self._neutral[:row].all()))
        last = fault_of(self.others, self.rows, singular)
        return last._replace(neutral=last.neutral and bool(self._neutral.all()))

    def coefficient(self, positions: Array, periods: Array, step: int) -> float:
        """The c of c lap that rows stand for."""
        others = self.others
        total, rows = moments(others.indptr, others.indices, others.data, self.rows, positions, periods, step)
        for number in range(len(self.chunks)):
            more, further = pair_loops.pair_moments(
                *self._listed(number), self.unknown, self.unknowns, *self.walls, positions, periods, step
            )
            total, rows = total + more, rows + further
        return float(total / (2 * positions.shape[1] * rows))

    def by_pairs(self) -> csr_array:
        """(R, n + W), the weights of pairs in compressed rows, wall particles after the unknowns."""
        return sparse_rows(self.chunks, self.weights, self.unknown, self.unknowns + len(self._behind))

    def assembled(self) -> csr_array:
        """The matrix in compressed rows."""
        pairs, (starts, columns, shares) = self.by_pairs(), self.walls
        behind = csr_array((shares, columns, starts), shape=(len(starts) - 1, self.unknowns))
        own: Any = dia_array((self._own.reshape(1, -1), [0]), shape=(self.rows, self.unknowns))
        matrix = csr_array(pairs[:, : self.unknowns] + pairs[:, self.unknowns :] @ behind + own)
        matrix = csr_array(vstack((matrix, self.others), format="csr"))
        matrix.eliminate_zeros()
        return matrix
