"""The methods that wall models of the explicit scheme have; as they are here, particles move with the wall."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from sphear.boundaries.models.any_model import AnyWallModel
from sphear.errors import SphearError

if TYPE_CHECKING:
    from sphear.boundaries.box import Box
    from sphear.boundaries.fixed import WallParticles
    from sphear.boundaries.shapes import Shape
    from sphear.engine.formula import Interaction
    from sphear.engine.stages import PointFormula
    from sphear.equations_of_state import EquationOfState
    from sphear.kernels import Kernel


@dataclass(frozen=True)
class ExplicitWallModel(AnyWallModel):
    """Particles behind walls, and what they have of the fluid before them, in each evaluation of the rates.

    A class of one's own changes what it does otherwise. Without a change particles have the velocity of their wall, and
    the pressure of a density that is summed, or that of the start.

    Attributes:
        mirrors: particles are reflected at the sides of a box, so that none stand behind them; of `MirrorParticles` and
            classes derived from it.
        integrates_density: beside the continuity equation wall particles have a density of their own, integrated like
            the fluid's, and its gradient.
        takes_pressure: `at_wall` gives wall particles their pressure; else the equation of state does, from their own
            density.
        from_first_layer: `at_wall` reads the sums of the first layer's particle before each, not its own.
        foreign: names of its fields that say nothing in the explicit scheme, of models that both schemes have.

    Examples:
        >>> import sphear
        >>> [isinstance(model, sphear.ExplicitWallModel) for model in (sphear.FixedParticles(), sphear.SFDI())]
        [True, False]
    """

    mirrors: ClassVar[bool] = False
    integrates_density: ClassVar[bool] = False
    takes_pressure: ClassVar[bool] = False
    from_first_layer: ClassVar[bool] = False
    foreign: ClassVar[tuple[str, ...]] = ()

    def depth(self, support: float, stages: int, summed: bool) -> float:
        """The depth up to which particles stand behind walls, a length: all that sums over pairs reach.

        Args:
            support: the radius of the kernel.
            stages: of the rates, each a sum over neighbours that knows the one before.
            summed: densities are sums too, of wall particles as well.
        """
        return support * (stages + summed)

    def particles(self, box: Box, shape: Shape | None, spacing: float, depth: float) -> WallParticles:
        """The M particles that stand behind walls: on the lattice of a box, in rows along the walls of a shape.

        Args:
            box: around the fluid, with its walls.
            shape: the region of fluid; None where its walls are those of the box.
            spacing: of the particles, a length.
            depth: up to which they stand.

        Raises:
            SphearError: fluid slips along a wall of the shape, or it cannot repeat as the box does.
        """
        from sphear.boundaries.fixed import particles_behind, wall_particles
        from sphear.neighbours import Domain

        layers = math.ceil(depth / spacing)
        if shape is None:
            return wall_particles(box, spacing, layers)
        return particles_behind(shape, spacing, layers * spacing, Domain(box.lower, box.upper, box.periodic))

    def before_wall(self, kernel: Kernel) -> Interaction | None:
        """The sum over neighbours that wall particles take from the fluid; None takes nothing.

        It knows `normal`, `depth` and `wall_velocity` of a wall particle; `fluid` is 1 of the fluid's, 0 of walls'.

        Args:
            kernel: with its smoothing length.
        """
        return None

    def at_wall(self, equation: EquationOfState, with_density: bool) -> PointFormula | None:
        """The new velocity, pressure or density of a wall particle, from that sum, `own.before_wall`; None is none.

        Args:
            equation: of state, which relates pressures and densities.
            with_density: densities are not summed, so that there is one to give.
        """
        return None

    def check_free_slip(self) -> None:
        """Refuse fluid that slips along walls.

        Raises:
            SphearError: the model cannot let it.
        """
        raise no_slipping("walls", self.said, "mirror")


def no_slipping(setting: str, value: object, instead: object) -> SphearError:
    """The error for a setting beside which fluid cannot slip along walls, with the value that lets it."""
    return SphearError(
        f"fluid slips along walls of walls=mirror, each by itself: {setting}={value} cannot let it, take"
        f" {setting}={instead}"
    )
