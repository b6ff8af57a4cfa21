"""The weights of pairs as a matrix."""

from __future__ import annotations

from typing import Any

from scipy.sparse import csr_array

from sphear.neighbours.sparse import sparse_rows
from sphear.schemes.incompressible.particle_sums import ParticleSums
from tests.particles import Array


def pair_matrix(
    where: ParticleSums, weights: Any, preparation: Any, column: Array | None = None, columns: int = 0
) -> csr_array:
    """Row k is of particle `neighbours.rows[k]`; columns are particles, or what these are renamed to."""
    neighbours = where.neighbours
    place = neighbours.source if column is None else column[neighbours.source]
    return sparse_rows(neighbours.chunks, where.weights(weights, preparation), place, columns or where.total)
