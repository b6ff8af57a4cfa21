"""Dummy particles with the fluid's fields at their mirror points, which the wall's condition continues."""

from __future__ import annotations

from dataclasses import dataclass

from sphear.boundaries.models.base import WallModel


@dataclass(frozen=True)
class MirrorPoints(WallModel):
    """Dummy particles have the pressure at their mirror points before the wall, continued by its normal gradient.

    A plane is fitted to the fluid around a mirror point, so that linear pressures, such as hydrostatic ones, are exact.

    Examples:
        >>> import sphear
        >>> print(sphear.Incompressible(walls=sphear.MirrorPoints(continuation="linear")))
        Incompressible(continuation='linear')
    """

    name = "mirror_points"
    aliases = ("marrone",)
    formula = "p_w = p(mirror point) - 2 depth n . grad p, n . grad p = rho n . a"
    source = "Marrone et al. 2011, CMAME 200:1526"
