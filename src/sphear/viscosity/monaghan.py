"""Monaghan & Gingold: artificial viscosity."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector, dot, positive_part, scale, subtract
from sphear.corrections import Correction
from sphear.errors import SphearError, quoted
from sphear.kernels import Kernel
from sphear.positive import as_number
from sphear.viscosity.base import ViscousTerm, regularised


@dataclass(frozen=True, repr=False)
class Monaghan(ViscousTerm):
    """-sum_j m_j (-alpha c mu_ij + beta mu_ij^2) / rho_mean grad W_ij, mu_ij = h (u_ij . r_ij) / (r_ij^2 + eta^2).

    Only pairs that approach each other feel it: it was made for shocks, and acts on about half of the pairs that a
    viscosity acts on. Without an alpha its linear part is given the strength of the dynamic viscosity,
    alpha c = 2 (d + 2) nu / h (Monaghan 2005, section 4.1, where all pairs feel it).

    Args:
        alpha: of the linear part; None derives it from the viscosity.
        beta: of the quadratic part.
        sound_speed: c, where alpha is given.
        receding: let pairs that move apart feel the linear part too.
        eta: regularisation in smoothing lengths.

    Raises:
        SphearError: alpha, beta, sound_speed or eta is negative.

    Examples:
        >>> import sphear
        >>> print(sphear.WeaklyCompressible(viscosity=sphear.Monaghan(alpha=0.1)))
        WeaklyCompressible(viscosity=Monaghan(alpha=0.1, beta=0.0, sound_speed=1.0, receding=False, eta=0.1))
        >>> print(sphear.Monaghan())
        Monaghan(alpha=None, beta=0.0, sound_speed=1.0, receding=False, eta=0.1)
          ...
          order, lattice   -0.0   (of the L1 error in dx, h fixed in dx)
          order, jittered  -0.7   (jitter 0.3 dx)
          ...
    """

    alpha: float | None = None
    beta: float = 0.0
    sound_speed: float = 1.0
    receding: bool = False
    eta: float | None = 0.1

    name = "monaghan"
    aliases = ("artificial", "artificial_viscosity", "monaghan_gingold")
    formula = (
        "-sum_j m_j (-alpha c mu_ij + beta mu_ij^2) / rho_mean grad W_ij for u_ij . r_ij < 0,"
        " mu_ij = h (u_ij . r_ij) / (r_ij^2 + eta^2), alpha c = 2 (d + 2) nu / h"
    )
    source = "Monaghan & Gingold 1983; Basa, Quinlan & Lastiwka 2009, eqs. 31, 32"
    radial = True
    varies_viscosity = True
    where_it_varies = "div(mu grad u) + (grad u)^T grad mu, of half of the pairs"

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("alpha", "beta", "sound_speed"):
            value = getattr(self, name)
            if value is not None and not as_number(value) >= 0:
                raise SphearError(f"{name} of viscosity 'monaghan' must be zero or positive, not {quoted(value)}")

    @property
    def homogeneous(self) -> bool:
        """Only with the strength of the dynamic viscosity: alpha takes a speed, and beta squares one."""
        return self.alpha is None and not self.beta

    def acceleration(
        self, kernel: Kernel, correction: Correction, own: Any, other: Any, d: Vector, r2: Scalar
    ) -> Vector:
        """The pair's part of eq. 31."""
        mean_density = 0.5 * (own.density + other.density)
        approach = dot(subtract(own.velocity, other.velocity), d)
        mu = kernel.h * approach / regularised(r2, self.eta, kernel)
        approaching = -positive_part(-mu)
        if self.alpha is None:
            kinematic = 0.5 * (own.dynamic_viscosity / own.density + other.dynamic_viscosity / other.density)
            strength = 2.0 * (len(d) + 2) * kinematic / kernel.h
        else:
            strength = self.alpha * self.sound_speed
        linear = strength * (mu if self.receding else approaching)
        factor = other.volume * other.density / mean_density * (linear - self.beta * approaching**2)
        return scale(factor, correction.gradient(kernel, own.prepared, d, r2))
