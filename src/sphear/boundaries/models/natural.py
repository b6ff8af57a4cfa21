"""Walls left out of the pressure equation, whose sums end there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from sphear.boundaries.models.base import WallModel

if TYPE_CHECKING:
    from scipy.sparse import csr_array

    from sphear.boundaries.models.base import Array
    from sphear.schemes.incompressible.walls import WallInterpolation, Walls


@dataclass(frozen=True)
class Natural(WallModel):
    """The sums of the pressure equation end at the wall, where its normal gradient then vanishes by itself.

    Behind walls the pressure is that at the mirror points, for its gradient alone.

    Examples:
        >>> import sphear
        >>> print(sphear.Incompressible(walls=sphear.Natural()))
        Incompressible(walls='natural')
    """

    name = "natural"
    formula = "n . grad p = 0, by sums without wall particles"
    source = "Cummins & Rudman 1999, J. Comput. Phys. 152:584"
    surface_fault = "carries no weight on walls"
    symmetric = True

    def jump(self, walls: Walls, accelerations: Array, density: float, way: Array) -> Array:
        """(0,): pressures are the same on both sides of walls."""
        import numpy as np  # takes long: models are listed without it

        return np.zeros(0)

    def pressure_weights(
        self, walls: Walls, interpolation: WallInterpolation, column: Array, unknowns: int
    ) -> csr_array | None:
        """None: the equation knows no wall particles."""
        return None
