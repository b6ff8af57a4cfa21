"""Rows of weights over the fluid, one a point at a wall, by a fit to the particles around it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.sparse import csr_array

from sphear.engine.formula import Interaction
from sphear.engine.sweep import Sweep
from sphear.engine.threads import on_threads, ranges
from sphear.engine.weights import PairWeights
from sphear.neighbours.points import PointNeighbours, SortedParticles

Array = np.ndarray[Any, Any]

WORTH_A_CHUNK = 500  # points: fewer are not shared out to threads


class FittedRows:
    """Points at walls that stay where they are, and how fields are fitted around them.

    Args:
        points: (M, d), in the box of a periodic domain.
        support: of the fit.
        fit: summed up around each point.
        weights: of the particles around it, by that fit.
        fields: of the points, (M,) or (M, k), by the names under which the interactions know them.
        coincident: a particle may be at the place of a point.
    """

    def __init__(
        self,
        points: Array,
        support: float,
        fit: Interaction,
        weights: Interaction,
        fields: dict[str, Array],
        coincident: bool = True,
    ) -> None:
        self.points, self.support, self.coincident = points, support, coincident
        self.fit, self.weights, self.fields = fit, weights, fields

    def matrix(
        self, around: SortedParticles, fields: dict[str, Array], column: Array, columns: int, threads: int
    ) -> csr_array:
        """The rows (M, columns).

        Args:
            around: the n particles, sorted.
            fields: of them, (n,) or (n, k); one that only points have is left out.
            column: (n,), the column of each.
            columns: their number.
            threads: to compute on.
        """
        neighbours = PointNeighbours(self.points, around, self.support, self.coincident)
        everything = {
            name: np.concatenate((fields.get(name, np.zeros((around.count, *values.shape[1:]))), values))
            for name, values in self.fields.items()
        }
        fit = Sweep(self.fit, neighbours, everything)
        kept = PairWeights(self.weights, neighbours, everything, (("prepared", fit.formula.result),))
        listed = column[around.source]

        def part(bounds: tuple[int, int]) -> tuple[Array, Array, Array]:
            chunk = neighbours.listed(*bounds)
            rows = chunk.end - chunk.begin
            coefficients = np.empty((rows, fit.outputs))
            fit.over(chunk, coefficients, neighbours.rows[:rows])
            places = np.take(listed, chunk.neighbour[: chunk.pairs], mode="clip")  # "raise" would test each one
            return chunk.first, places, kept.of(chunk, coefficients)[0]

        parts = max(1, min(threads, len(self.points) // WORTH_A_CHUNK))
        firsts, places, weights = zip(*on_threads(part, ranges(len(self.points), parts), threads), strict=True)
        before = np.cumsum([0, *(first[-1] for first in firsts[:-1])])
        starts = np.concatenate(([0], *(first[1:] + start for first, start in zip(firsts, before, strict=True))))
        found = whole(weights), whole(places), starts.astype(np.int32)
        matrix = csr_array(found, shape=(len(self.points), columns))
        if not matrix.data.all():  # of a point without fluid around it, which then has no row
            matrix.eliminate_zeros()
        return matrix


def whole(parts: Sequence[Array]) -> Array:
    """All parts, one after the other; a single one as it is."""
    return parts[0] if len(parts) == 1 else np.concatenate(parts)
