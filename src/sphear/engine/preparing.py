"""The preparation of particles, one chunk of the pair list after the other, on arrays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.engine.dense import solve_normal_equations
from sphear.engine.formula import Interaction, Shape
from sphear.engine.preparation import NormalEquations, Preparation, form_of
from sphear.engine.sweep import Sweep

if TYPE_CHECKING:
    from sphear.neighbours import Chunk, Neighbours

Array = np.ndarray[Any, Any]

DIGITS = 100  # roundings of one number, that the quality must be above to have any digits


class PreparationSweep:
    """Sums up a preparation and, where it is one of normal equations, solves them.

    Args:
        preparation: of the particles.
        neighbours: the pairs.
        fields: arrays (N,) or (N, k) by the names that it knows them by; with `volume`.
        dtype: "float64" or "float32": what the sums are computed in.

    Attributes:
        template: the structure of a particle's result, by the name that later sums know it by.
    """

    def __init__(
        self, preparation: Interaction, neighbours: Neighbours, fields: Mapping[str, Array], dtype: str = "float64"
    ) -> None:
        self.preparation, self.dimension = preparation, neighbours.dimension
        self.sweep = Sweep(preparation, neighbours, fields, dtype=dtype)
        form = form_of(preparation, self.dimension, self.sweep.formula.result)
        self.template: tuple[Shape, ...] = (("prepared", form),)

    def over(self, chunk: Chunk) -> Array:
        """The results of a chunk's rows, (rows, numbers), in their order."""
        rows = chunk.end - chunk.begin
        out = np.empty((rows, self.sweep.outputs), self.sweep.dtype)
        self.sweep.over(chunk, out, np.arange(rows, dtype=np.int32))
        if isinstance(self.preparation, NormalEquations):
            out = solved(self.preparation, out, self.dimension).astype(self.sweep.dtype, copy=False)
        return out


def deficient(preparation: Preparation, results: Array) -> Array:
    """The rows of a preparation's results (rows, numbers) whose quality is too low; a NaN is too."""
    least = max(preparation.least_quality, DIGITS * float(np.finfo(results.dtype).eps))
    return np.flatnonzero(~(results[:, 0] > least))


def solved(equations: NormalEquations, moments: Array, dimension: int) -> Array:
    """The quality and solution of each row's equations, (rows, 1 + n), from moments (rows, m)."""
    index, right = equations.normal_equations(dimension)
    result = np.empty((len(moments), 1 + len(right)))
    solve_normal_equations(moments.astype(np.float64, copy=False), index, right, result[:, 0], result[:, 1:])
    return result
