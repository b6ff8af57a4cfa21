"""A background grid for what is smooth, beside damped Jacobi for what is not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from sphear.errors import SphearError, quoted
from sphear.positive import is_positive
from sphear.pressure.preconditioners.base import Preconditioner

if TYPE_CHECKING:
    from sphear.pressure.preconditioners.base import Vector
    from sphear.pressure.system import PressureSystem


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
        from sphear.pressure.preconditioners.two_levels import two_levels  # compiled: the grid is listed without it

        return two_levels(system, self.coarsening, self.damping)
