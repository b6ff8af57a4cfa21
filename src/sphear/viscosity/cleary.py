"""Cleary: a pair force along the line of centres, with a harmonic mean of viscosities."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector, dot, scale, subtract
from sphear.corrections import Correction
from sphear.errors import SphearError, quoted
from sphear.kernels import Kernel
from sphear.positive import is_positive
from sphear.viscosity.base import ViscousTerm, regularised


@dataclass(frozen=True, repr=False)
class Cleary(ViscousTerm):
    """sum_j m_j xi / (rho_i rho_j) 4 mu_i mu_j / (mu_i + mu_j) (u_ij . r_ij) / (r_ij^2 + eta^2) grad W_ij.

    With constant mu and rho and xi = d + 2, its analytic value, this is Violeau's term. Cleary calibrated
    xi = 4.96333 (near the 3-D value), Basa et al. 4.24 (6 % more viscosity than the analytic 4 of 2-D); both are
    there by name, `cleary_4.96333` and `cleary_4.24`.

    Args:
        xi: the factor; None takes d + 2.
        eta: regularisation in smoothing lengths.

    Raises:
        SphearError: xi is not positive, or eta is negative.

    Examples:
        >>> import sphear
        >>> sphear.VISCOSITY["cleary_4.24"] == sphear.Cleary(xi=4.24)
        True
        >>> print(sphear.Cleary())
        Cleary(xi=None, eta=0.1)
          ...
          order, lattice   -0.0   (of the L1 error in dx, h fixed in dx)
          order, jittered  -1.1   (jitter 0.3 dx)
          ...
    """

    xi: float | None = None
    eta: float | None = 0.1

    name = "cleary"
    aliases = ("D",)
    formula = (
        "sum_j m_j xi / (rho_i rho_j) 4 mu_i mu_j / (mu_i + mu_j)"
        " (u_ij . r_ij) / (r_ij^2 + eta^2) grad W_ij, xi = d + 2"
    )
    source = "Cleary 1998; Basa, Quinlan & Lastiwka 2009, eq. 34 (model D)"
    radial = True
    varies_viscosity = True
    where_it_varies = "div(mu grad u) + (grad u)^T grad mu"

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.xi is not None and not is_positive(self.xi):
            raise SphearError(f"the factor xi of viscosity 'cleary' must be positive, not {quoted(self.xi)}")

    def acceleration(
        self, kernel: Kernel, correction: Correction, own: Any, other: Any, d: Vector, r2: Scalar
    ) -> Vector:
        """The pair's part of eq. 34."""
        xi = len(d) + 2.0 if self.xi is None else self.xi
        mu_i, mu_j = own.dynamic_viscosity, other.dynamic_viscosity
        factor = other.volume * xi / own.density * 4.0 * mu_i * mu_j / (mu_i + mu_j)
        approach = dot(subtract(own.velocity, other.velocity), d) / regularised(r2, self.eta, kernel)
        return scale(factor * approach, correction.gradient(kernel, own.prepared, d, r2))
