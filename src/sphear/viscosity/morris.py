"""Morris, Fox & Zhu: a finite difference of velocity times the kernel gradient."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector
from sphear.corrections import Correction
from sphear.kernels import Kernel
from sphear.viscosity.base import LaplacianTerm, regularised


@dataclass(frozen=True, repr=False)
class Morris(LaplacianTerm):
    """lap u_i = 2 sum_j V_j u_ij (r_ij . grad W_ij) / (r_ij^2 + eta^2).

    The force is along u_ij: linear momentum is conserved, angular momentum is not.

    Args:
        eta: regularisation in smoothing lengths; None leaves it out, as Basa's eq. 35 does.

    Raises:
        SphearError: eta is negative.

    Examples:
        >>> import sphear
        >>> sphear.VISCOSITY["VISC-01"] == sphear.Morris()
        True
        >>> print(sphear.Morris())
        Morris(eta=None)
          ...
          order, lattice   +0.2   (of the L1 error in dx, h fixed in dx)
          order, jittered  -1.1   (jitter 0.3 dx)
          ...
    """

    eta: float | None = None

    name = "morris"
    aliases = ("E", "VISC-01", "cummins_rudman", "brookshaw")
    formula = "sum_j m_j (mu_i + mu_j) / (rho_i rho_j) (r_ij . grad W_ij) / (r_ij^2 + eta^2) u_ij"
    source = (
        "Morris, Fox & Zhu 1997; Cummins & Rudman 1999; Basa, Quinlan & Lastiwka 2009, eq. 35 (model E); "
        "Zheng, Ma & Shao 2018, eq. 15 (VISC-01)"
    )
    varies_viscosity = True
    where_it_varies = "div(mu grad u)"

    def weight(self, kernel: Kernel, correction: Correction, own: Any, d: Vector, r2: Scalar) -> Scalar:
        """w_ij = -2 (r_ij . grad W_ij) / (r_ij^2 + eta^2)."""
        return -2.0 * correction.radial(kernel, own.prepared, d, r2) / regularised(r2, self.eta, kernel)

    def mean_viscosity(self, own: Any, other: Any) -> Scalar:
        """(mu_i + mu_j) / 2."""
        return 0.5 * (own.dynamic_viscosity + other.dynamic_viscosity)
