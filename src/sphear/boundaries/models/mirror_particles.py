"""Mirror images of the particles at the sides of a box, with the velocity continued along them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, get_args

from sphear.boundaries.continuations import CONTINUATIONS
from sphear.boundaries.models.base import Divergence
from sphear.boundaries.models.explicit import ExplicitWallModel, no_slipping
from sphear.errors import SphearError, quoted

if TYPE_CHECKING:
    from sphear.boundaries.box import Box
    from sphear.boundaries.fixed import WallParticles
    from sphear.boundaries.shapes import Shape


@dataclass(frozen=True)
class MirrorParticles(ExplicitWallModel):
    """Each particle near the side of a box has an image behind it, with its density and pressure.

    Its velocity across the wall is the opposite; along the wall it is u_wall - a y + b y^2 at the depth y.

    Args:
        continuation: how the velocity goes on behind a wall: "mirror" reflects it; "linear", "quadratic" and
            "global_quadratic" fit a and b to the fluid.
        divergence: velocity of images along the wall in the continuity equation: the fluid's own, "slipping", or the
            one that is "continued"; None is the first beside the continuity equation.
        on_wall: particles near a wall have an image with its velocity on it too.

    Raises:
        SphearError: a field is none of these.

    Examples:
        >>> import sphear
        >>> print(sphear.WeaklyCompressible(walls=sphear.MirrorParticles(on_wall=True)))
        WeaklyCompressible(wall_particles=True)
    """

    continuation: str = "quadratic"
    divergence: Divergence | None = None
    on_wall: bool = False

    name = "mirror"
    aliases = ("mirror_particles",)
    formula = "u(-y) = u_wall - a y + b y^2 along the wall, p(-y) = p(y)"
    source = "Basa, Quinlan & Lastiwka 2009, IJNMF 60:1127, section 6.1.2"
    mirrors = True

    def __post_init__(self) -> None:
        object.__setattr__(self, "continuation", CONTINUATIONS.name(self.continuation))
        if self.divergence not in (None, *get_args(Divergence)):
            raise SphearError(
                f"the divergence of the wall model MirrorParticles should be one of {', '.join(get_args(Divergence))},"
                f" not {quoted(self.divergence)}"
            )
        if not isinstance(self.on_wall, bool):
            raise SphearError(
                f"on_wall of the wall model MirrorParticles should be True or False, not {quoted(self.on_wall)}"
            )

    def particles(self, box: Box, shape: Shape | None, spacing: float, depth: float) -> WallParticles:
        """None: images are found anew in each evaluation."""
        from sphear.boundaries.fixed import wall_particles

        return wall_particles(box, spacing, 0)

    def check_free_slip(self) -> None:
        """Refuse a parabola through both walls, and particles on them, which have the wall's velocity."""
        if self.continuation == "global_quadratic":
            raise no_slipping("continuation", self.continuation, "quadratic")
        if self.on_wall:
            raise no_slipping("wall_particles", True, False)
