"""A background grid for what is smooth, beside damped Jacobi for what is not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import prod

import numpy as np
from scipy.fft import next_fast_len

from sphear.engine.cache import compiled
from sphear.errors import SphearError, quoted
from sphear.positive import is_positive
from sphear.pressure.preconditioners.base import Preconditioner, Vector
from sphear.pressure.preconditioners.multigrid import PartlyFilled
from sphear.pressure.preconditioners.poisson import BoxPoisson
from sphear.pressure.preconditioners.transfer import corners, deposit, interpolate_and_add
from sphear.pressure.system import PressureSystem

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


@dataclass(frozen=True)
class Grid(Preconditioner):
    """Two levels that add up: M = P G^-1 P^T + damping D^-1.

    P is multilinear interpolation from the nodes of a grid over the box to the particles, D the diagonal. G stands for
    P^T A P. On a node that equation sums those of the size^d / spacing^d particles around it, each c lap p with
    nearly the same lap p, so

        G = c prod(size) / spacing^d lap_grid

    with the second-difference Laplacian of the grid; c, one for a Laplacian, is measured from the matrix. Where fluid
    fills the box and no pressure is fixed, a cosine transform (walls) or Fourier transform (periodic axes) inverts G at
    once. Elsewhere nodes are coupled by how full they are and fixed by what rows near a free surface do not sum to,
    and a V-cycle on the grid stands for the inverse. (The transform, which continues the pressure into holes, does as
    well beside a cylinder of a quarter of the box, but takes twice the iterations where it nearly touches the walls,
    and the more the finer the spacing where there is a free surface or a thin wall.)

    What particles do at less than a node's distance is left to Jacobi, whose error is the same whatever the number of
    particles; so is the number of iterations. Levels are added up, with one product by A an iteration: a V-cycle with A
    in it would have three, for a third of the iterations less.

    Args:
        coarsening: the distance of nodes, in particle spacings.
        damping: of Jacobi; a diagonal entry is about half the matrix' largest eigenvalue.

    Raises:
        SphearError: one of them is not a positive number.

    Examples:
        >>> import sphear
        >>> print(sphear.Incompressible(preconditioner=sphear.Grid(coarsening=3.0)))
        Incompressible(preconditioner=Grid(coarsening=3.0, damping=0.7))
    """

    coarsening: float = 2.0
    damping: float = 0.7

    name = "grid"
    aliases = ("spectral", "cosine", "fourier")
    formula = "M = P (c prod(size) / spacing^d lap_grid)^-1 P^T + 0.7 D^-1"
    source = "sphear; additive two-level methods: Smith, Bjorstad & Gropp 1996, Domain Decomposition"

    def __post_init__(self) -> None:
        for name in ("coarsening", "damping"):
            if not is_positive(value := getattr(self, name)):
                raise SphearError(
                    f"the {name} of the preconditioner grid must be a positive number, not {quoted(value)}"
                )

    def build(self, system: PressureSystem) -> Callable[[Vector], Vector]:
        """Weights between particles and grid, eigenvalues, diagonal."""
        matrix, positions = system.matrix, system.positions
        extent = [high - low for low, high in zip(system.lower, system.upper, strict=True)]
        # transforms like lengths of small prime factors
        counts = tuple(next_fast_len(max(1, round(x / (self.coarsening * system.spacing))), real=True) for x in extent)
        size = tuple(x / count for x, count in zip(extent, counts, strict=True))
        periods = np.array([x if flag else 0.0 for x, flag in zip(extent, system.periodic, strict=True)])
        step = -(-system.unknowns // SAMPLE)
        c = laplacian_coefficient(matrix.indptr, matrix.indices, matrix.data, positions, periods, step)
        nodes, weights = corners(
            positions, np.array(system.lower), np.array(size), np.array(counts), np.array(system.periodic)
        )
        particles = prod(size) / system.spacing**system.dimension  # that a node stands for
        # the grid's equations have the opposite sign, and so has what is deposited
        jacobi, ones = -self.damping / matrix.diagonal(), np.ones(system.unknowns)
        room, share, penalty = np.zeros((3, prod(counts)))
        deposit(nodes, weights, ones / particles, share)
        poisson: Callable[[Vector], Vector]
        if system.singular and share.min() > FULL:
            poisson = BoxPoisson(counts, size, system.periodic, 1.0 / (c * particles))
        else:
            if not system.singular:
                deposit(nodes, weights, np.maximum(-(matrix @ ones), 0.0), penalty)
            poisson = PartlyFilled(counts, size, system.periodic, c * particles, share, penalty)

        def apply(vector: Vector) -> Vector:
            deposit(nodes, weights, vector, room)
            result: Vector = interpolate_and_add(nodes, weights, poisson(room), jacobi, vector)
            return np.negative(result, out=result)

        return apply
