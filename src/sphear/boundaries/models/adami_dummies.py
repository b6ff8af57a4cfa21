"""Dummy particles with the mean of the fluid around them (Adami, Hu & Adams 2012)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from sphear.algebra import where_less
from sphear.boundaries.models.base import Sampling, WallModel
from sphear.boundaries.models.before_wall import FluidBeforeWall
from sphear.boundaries.models.explicit import ExplicitWallModel
from sphear.engine.stages import PointFormula
from sphear.equations_of_state import EquationOfState
from sphear.kernels import Kernel

if TYPE_CHECKING:
    from sphear.boundaries.models.base import Array
    from sphear.boundaries.shapes import Dummies
    from sphear.schemes.incompressible.walls import WallInterpolation, Walls


@dataclass(frozen=True)
class FluidAtWall:
    """Velocity, pressure and density of a wall particle, of what the fluid before it gave (Adami et al. 2012).

    Attributes:
        equation: of state, which gives the density; a gas out of reach of the fluid keeps its own.
        with_density: whether there is one to give: summed densities are those of the particles' places.
    """

    equation: EquationOfState
    with_density: bool

    def at(self, own: Any) -> dict[str, Any]:
        """From the sums before the wall."""
        *velocity, pressure = own.before_wall
        result: dict[str, Any] = {"velocity": tuple(velocity), "pressure": pressure}
        if self.with_density:
            gas = self.equation.uses_energy
            density = self.equation.density(pressure, own.energy if gas else 0.0)
            result["density"] = where_less(0.0, pressure, density, own.density) if gas else density
        return result


@dataclass(frozen=True)
class AdamiDummies(WallModel, ExplicitWallModel):
    """Dummy particles have the mean pressure of the fluid around them, continued by the normal gradient.

    Both schemes have them. The explicit one takes the velocity from the same mean, 2 u_wall - u, as the source does: it
    knows neither continuation nor divergence. The incompressible one continues velocities as `WallModel` does.

    Examples:
        >>> import sphear
        >>> print(sphear.Incompressible(walls=sphear.AdamiDummies()))
        Incompressible(walls='adami')
    """

    name = "adami"
    aliases = ("adami_dummies",)
    formula = "p_w = sum_f W_wf (p_f + rho a . (r_w - r_f)) / sum_f W_wf"
    source = "Adami, Hu & Adams 2012, J. Comput. Phys. 231:7057, eqs. 22 and 27"
    takes_pressure = True
    foreign = ("continuation", "divergence")

    def sampling(self, behind: Dummies, kernel: Kernel, spacing: float) -> Sampling:
        """The mean around the dummies themselves: one that is a neighbour of the fluid has fluid around it."""
        return Sampling(behind.positions, kernel, 0)

    def way(self, walls: Walls, interpolation: WallInterpolation, positions: Array) -> Array:
        """(W, d): from dummies to the middle of the fluid around them, in corners aside of the wall."""
        import numpy as np  # takes long: models are listed without it

        weights = interpolation.mirrored
        wall = np.repeat(np.arange(walls.count), np.diff(weights.indptr))
        way = positions[weights.indices] - walls.dummies.positions[wall]
        if walls.domain is not None:
            way = walls.domain.shortest(way)
        columns = [np.bincount(wall, weights.data * part, walls.count) for part in way.T]
        return np.stack(columns, axis=1)

    def before_wall(self, kernel: Kernel) -> FluidBeforeWall:
        """The means of the fluid's velocity and pressure around a wall particle."""
        return FluidBeforeWall(kernel)

    def at_wall(self, equation: EquationOfState, with_density: bool) -> PointFormula:
        """These, and the density that belongs to the pressure."""
        return FluidAtWall(equation, with_density)
