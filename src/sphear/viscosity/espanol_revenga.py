"""Español & Revenga: shear and bulk viscosity by forces along and across the line of centres."""

from __future__ import annotations

from dataclasses import dataclass
from math import isnan
from typing import Any

from sphear.algebra import Scalar, Vector, add, dot, scale, subtract
from sphear.corrections import Correction
from sphear.errors import SphearError, quoted
from sphear.kernels import Kernel
from sphear.positive import as_number
from sphear.viscosity.base import ViscousTerm


@dataclass(frozen=True, repr=False)
class EspanolRevenga(ViscousTerm):
    """(1 / rho_i) sum_j V_j (r_ij . grad W_ij / r_ij^2) (a u_ij + b (u_ij . e_ij) e_ij).

    a = 5/3 mu - zeta and b = (d + 2) (zeta + mu/3), so that the limit is mu lap u + (zeta + mu/3) grad div u in any
    dimension: that of a three-dimensional fluid, also where it flows in a plane. With d = 3 these are the factors of
    the source.

    Args:
        bulk: the bulk viscosity zeta as a multiple of the dynamic viscosity.

    Raises:
        SphearError: bulk is not finite.

    Examples:
        >>> import sphear
        >>> print(sphear.Incompressible(viscosity=sphear.EspanolRevenga(bulk=1.0)))
        Incompressible(viscosity=EspanolRevenga(bulk=1.0))
        >>> print(sphear.EspanolRevenga())
        EspanolRevenga(bulk=0.0)
          ...
          order, lattice   -0.2   (of the L1 error in dx, h fixed in dx)
          order, jittered  -1.0   (jitter 0.3 dx)
          ...
    """

    bulk: float = 0.0

    name = "espanol_revenga"
    aliases = ("español_revenga", "espanol")
    formula = (
        "1 / rho_i sum_j V_j (r_ij . grad W_ij / r_ij^2) (a u_ij + b (u_ij . e_ij) e_ij),"
        " a = 5/3 mu - zeta, b = (d + 2) (zeta + mu / 3)"
    )
    source = "Español & Revenga 2003, Smoothed dissipative particle dynamics, Phys. Rev. E 67:026705, eq. 58"
    radial = True
    varies_viscosity = True
    where_it_varies = "div(mu grad u) + (grad u)^T grad mu / 6"

    def __post_init__(self) -> None:
        super().__post_init__()
        if isnan(as_number(self.bulk)):
            raise SphearError(f"bulk of viscosity 'espanol_revenga' must be a finite number, not {quoted(self.bulk)}")

    def acceleration(
        self, kernel: Kernel, correction: Correction, own: Any, other: Any, d: Vector, r2: Scalar
    ) -> Vector:
        """The pair's part."""
        mu = 0.5 * (own.dynamic_viscosity + other.dynamic_viscosity)
        dilation = self.bulk + 1.0 / 3.0
        factor = other.volume * mu / own.density * correction.radial(kernel, own.prepared, d, r2) / r2
        difference = subtract(own.velocity, other.velocity)
        along = scale((len(d) + 2) * dilation * dot(difference, d) / r2, d)
        return scale(factor, add(scale(2.0 - dilation, difference), along))
