"""Violeau & Issa: a pair force along the line of centres."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector, dot, scale, subtract
from sphear.corrections import Correction
from sphear.kernels import Kernel
from sphear.viscosity.base import ViscousTerm, regularised


@dataclass(frozen=True, repr=False)
class Violeau(ViscousTerm):
    """sum_j m_j 2 (d + 2) / (rho_i + rho_j) (mu_i/rho_i + mu_j/rho_j) (u_ij . r_ij) / (r_ij^2 + eta^2) grad W_ij.

    2 (d + 2) is 8 in 2-D, as printed, and 10 in 3-D. The limit is (mu/rho) (lap u + 2 grad div u).

    Args:
        eta: regularisation in smoothing lengths.

    Raises:
        SphearError: eta is negative.

    Examples:
        >>> import sphear
        >>> sphear.VISCOSITY["violeau_issa"] == sphear.Violeau()
        True
        >>> print(sphear.Violeau())
        Violeau(eta=0.1)
          ...
          order, lattice   -0.0   (of the L1 error in dx, h fixed in dx)
          order, jittered  -1.1   (jitter 0.3 dx)
          ...
    """

    eta: float | None = 0.1

    name = "violeau"
    aliases = ("C", "violeau_issa")
    formula = (
        "sum_j m_j 2 (d + 2) / (rho_i + rho_j) (mu_i / rho_i + mu_j / rho_j) (u_ij . r_ij) / (r_ij^2 + eta^2) grad W_ij"
    )
    source = "Violeau & Issa 2007; Basa, Quinlan & Lastiwka 2009, eq. 33 (model C)"
    radial = True
    varies_viscosity = True
    where_it_varies = "div(mu grad u) + (grad u)^T grad mu"

    def acceleration(
        self, kernel: Kernel, correction: Correction, own: Any, other: Any, d: Vector, r2: Scalar
    ) -> Vector:
        """The pair's part of eq. 33."""
        mass = other.volume * other.density
        kinematic = own.dynamic_viscosity / own.density + other.dynamic_viscosity / other.density
        factor = mass * 2.0 * (len(d) + 2) / (own.density + other.density) * kinematic
        approach = dot(subtract(own.velocity, other.velocity), d) / regularised(r2, self.eta, kernel)
        return scale(factor * approach, correction.gradient(kernel, own.prepared, d, r2))
