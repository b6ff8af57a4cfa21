"""The two levels of the preconditioner grid, added up: a background grid beside damped Jacobi."""

from __future__ import annotations

from collections.abc import Callable
from math import prod
from typing import TYPE_CHECKING

import numpy as np
from scipy.fft import next_fast_len

from sphear.pressure.preconditioners.multigrid import MultigridPoisson
from sphear.pressure.preconditioners.poisson import BoxPoisson
from sphear.pressure.preconditioners.transfer import Transfer
from sphear.pressure.system import PressureSystem

if TYPE_CHECKING:
    from sphear.pressure.preconditioners.base import Vector

FULL = 0.25  # of a node, from which on it is not a hole; disordered particles leave more than half
SAMPLE = 500  # rows that the coefficient of the Laplacian is measured from


def two_levels(system: PressureSystem, coarsening: float, damping: float) -> Callable[[Vector], Vector]:
    """The function that applies M = P G^-1 P^T + damping D^-1 to a vector (n,): see `Grid`.

    Args:
        system: the pressure equation.
        coarsening: the distance of nodes, in particle spacings.
        damping: of Jacobi.
    """
    rows, positions = system.rows, system.positions
    extent = [high - low for low, high in zip(system.lower, system.upper, strict=True)]
    # transforms like lengths of small prime factors
    counts = tuple(next_fast_len(max(1, round(x / (coarsening * system.spacing))), real=True) for x in extent)
    size = tuple(x / count for x, count in zip(extent, counts, strict=True))
    periods = np.array([x if flag else 0.0 for x, flag in zip(extent, system.periodic, strict=True)])
    step = -(-system.unknowns // SAMPLE)
    c = rows.coefficient(positions, periods, step)
    transfer = Transfer(positions, system.lower, size, counts, system.periodic, rows.threads)
    particles = prod(size) / system.spacing**system.dimension  # that a node stands for
    # the grid's equations have the opposite sign, and so has what is deposited
    jacobi, ones = damping / rows.diagonal(), np.ones(system.unknowns)
    share = transfer.deposit(ones / particles).copy()
    factor = -c * particles
    poisson: Callable[[Vector], Vector]
    if system.singular and share.min() > FULL:
        poisson = BoxPoisson(counts, size, system.periodic, 1.0 / factor, rows.threads)
    else:
        missing = np.zeros(system.unknowns) if system.singular else np.maximum(-rows.times(ones), 0.0)
        penalty = transfer.deposit(missing).copy()
        multigrid = MultigridPoisson(counts, size, system.periodic, -factor, share, penalty)

        def poisson(source: Vector) -> Vector:
            return np.negative(multigrid(source))

    def apply(vector: Vector) -> Vector:
        return transfer.interpolate_and_add(poisson(transfer.deposit(vector)), jacobi, vector)

    return apply
