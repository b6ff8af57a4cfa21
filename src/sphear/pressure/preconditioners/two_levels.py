"""The two levels of the preconditioner grid, added up: a background grid beside damped Jacobi."""

from __future__ import annotations

from collections.abc import Callable
from math import prod
from typing import TYPE_CHECKING

import numpy as np
from scipy.fft import next_fast_len

from sphear.engine.cache import compiled
from sphear.pressure.preconditioners.multigrid import MultigridPoisson
from sphear.pressure.preconditioners.poisson import BoxPoisson
from sphear.pressure.preconditioners.transfer import deposit, interpolate_and_add, surrounding_nodes
from sphear.pressure.system import PressureSystem

if TYPE_CHECKING:
    from sphear.pressure.preconditioners.base import Vector

FULL = 0.25  # of a node, from which on it is not a hole; disordered particles leave more than half
SAMPLE = 500  # rows that the coefficient of the Laplacian is measured from


@compiled
def laplacian_coefficient(first, column, entry, positions, periods, step):  # type: ignore[no-untyped-def]
    """c of A ~ c lap: the mean of sum_j w_ij |r_j - r_i|^2 / (2 d), which is one for lap |r|^2 = 2 d, over some rows.

    Rows near walls have neighbours on one side only and count less, as they should: their matrix is as much smaller.
    """
    dimension = positions.shape[1]
    total, rows = 0.0, 0
    for i in range(0, len(first) - 1, step):
        for k in range(first[i], first[i + 1]):
            square = 0.0
            for axis in range(dimension):
                d = positions[column[k], axis] - positions[i, axis]
                if periods[axis] > 0.0:
                    d -= periods[axis] * np.rint(d / periods[axis])
                square += d * d
            total += entry[k] * square
        rows += 1
    return total / (2 * dimension * rows)


def two_levels(system: PressureSystem, coarsening: float, damping: float) -> Callable[[Vector], Vector]:
    """The function that applies M = P G^-1 P^T + damping D^-1 to a vector (n,): see `Grid`.

    Args:
        system: the pressure equation.
        coarsening: the distance of nodes, in particle spacings.
        damping: of Jacobi.
    """
    matrix, positions = system.matrix, system.positions
    extent = [high - low for low, high in zip(system.lower, system.upper, strict=True)]
    # transforms like lengths of small prime factors
    counts = tuple(next_fast_len(max(1, round(x / (coarsening * system.spacing))), real=True) for x in extent)
    size = tuple(x / count for x, count in zip(extent, counts, strict=True))
    periods = np.array([x if flag else 0.0 for x, flag in zip(extent, system.periodic, strict=True)])
    step = -(-system.unknowns // SAMPLE)
    c = laplacian_coefficient(matrix.indptr, matrix.indices, matrix.data, positions, periods, step)
    nodes, weights = surrounding_nodes(
        positions, np.array(system.lower), np.array(size), np.array(counts), np.array(system.periodic)
    )
    particles = prod(size) / system.spacing**system.dimension  # that a node stands for
    # the grid's equations have the opposite sign, and so has what is deposited
    jacobi, ones = -damping / matrix.diagonal(), np.ones(system.unknowns)
    room, share, penalty = np.zeros((3, prod(counts)))
    deposit(nodes, weights, ones / particles, share)
    poisson: Callable[[Vector], Vector]
    if system.singular and share.min() > FULL:
        poisson = BoxPoisson(counts, size, system.periodic, 1.0 / (c * particles))
    else:
        if not system.singular:
            deposit(nodes, weights, np.maximum(-(matrix @ ones), 0.0), penalty)
        poisson = MultigridPoisson(counts, size, system.periodic, c * particles, share, penalty)

    def apply(vector: Vector) -> Vector:
        deposit(nodes, weights, vector, room)
        result: Vector = interpolate_and_add(nodes, weights, poisson(room), jacobi, vector)
        return np.negative(result, out=result)

    return apply
