"""Fixed particles behind walls, into which the velocity of the fluid is continued (Basa et al. 2009)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import dot, scale, subtract, where_less
from sphear.boundaries.continuations import Line, Parabola
from sphear.boundaries.models.before_wall import VelocityBeforeWall
from sphear.boundaries.models.explicit import ExplicitWallModel
from sphear.engine.stages import PointFormula
from sphear.equations_of_state import EquationOfState
from sphear.errors import SphearError
from sphear.kernels import Kernel

CURVES = {"linear": Line(), "quadratic": Parabola()}


@dataclass(frozen=True)
class ContinuedVelocity:
    """The velocity of a fixed wall particle, u_wall - a y + b y^2 along the wall, that of the wall across it.

    a and b are the first layer's, which is the nearest to the fluid; y is the depth of the particle. Corners, which
    have no normal and no depth, have the velocity of the wall.
    """

    def at(self, own: Any) -> dict[str, Any]:
        """From the fit before the wall."""
        dimension = len(own.normal)
        fits = zip(own.before_wall[:dimension], own.before_wall[dimension:], strict=True)
        behind = tuple(Parabola.behind(u, fit, own.depth) for u, fit in zip(own.wall_velocity, fits, strict=True))
        change = subtract(behind, own.wall_velocity)
        along = subtract(behind, scale(dot(change, own.normal), own.normal))
        return {
            "velocity": tuple(
                where_less(0.0, own.depth, u, wall) for u, wall in zip(along, own.wall_velocity, strict=True)
            )
        }


@dataclass(frozen=True)
class FixedParticles(ExplicitWallModel):
    """Particles stand behind walls of any form, with a density of their own and the fluid's velocity continued.

    Their density is that of the fluid's equation. Where it is integrated it runs away at the ends of a sliding lid;
    where it is summed it cannot.

    Args:
        continuation: of the velocity behind the wall, by the "linear" or "quadratic" fit to the fluid before it.

    Raises:
        SphearError: the continuation is none of these.

    Examples:
        >>> import sphear
        >>> print(sphear.WeaklyCompressible(walls=sphear.FixedParticles(continuation="linear")))
        WeaklyCompressible(walls='fixed', continuation='linear')
    """

    continuation: str = "quadratic"

    name = "fixed"
    aliases = ("fixed_particles",)
    formula = "u(-y) = u_wall - a y + b y^2 along the wall, u_wall across it"
    source = "Basa, Quinlan & Lastiwka 2009, IJNMF 60:1127, section 6.2"
    integrates_density = True
    from_first_layer = True

    def __post_init__(self) -> None:
        if self.continuation not in CURVES:
            raise SphearError(
                f"walls=fixed continue the fluid's velocity by continuation=linear or quadratic, not"
                f" {self.continuation}"
            )

    def before_wall(self, kernel: Kernel) -> VelocityBeforeWall:
        """The fit of a and b to the fluid before the wall."""
        return VelocityBeforeWall(kernel, CURVES[self.continuation])

    def at_wall(self, equation: EquationOfState, with_density: bool) -> PointFormula:
        """The velocity at the depth of the particle."""
        return ContinuedVelocity()
