"""Oger, Hosseini & Feng, Khayyer: Morris's form with a renormalised kernel gradient."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector
from sphear.corrections import Correction, Renormalised
from sphear.engine.preparation import Preparation
from sphear.kernels import Kernel
from sphear.viscosity.base import LaplacianTerm, regularised


@dataclass(frozen=True, repr=False)
class Oger(LaplacianTerm):
    """lap u_i = 2 sum_j V_j u_ij (r_ij . Gamma_i grad W_ij) / (r_ij^2 + eta^2).

    Gamma makes first derivatives exact for linear fields; the second derivative formed with it is not.

    Args:
        eta: regularisation in smoothing lengths; None leaves it out.

    Raises:
        SphearError: eta is negative.

    Examples:
        >>> import sphear
        >>> sphear.VISCOSITY["VISC-04"] == sphear.Oger()
        True
        >>> print(sphear.Oger())
        Oger(eta=None)
          ...
          order, lattice   +2.0   (of the L1 error in dx, h fixed in dx)
          order, jittered  -1.1   (jitter 0.3 dx)
          ...
    """

    eta: float | None = None

    name = "oger"
    aliases = ("VISC-04", "hosseini_feng", "khayyer")
    formula = "mu_i / rho_i 2 sum_j V_j u_ij (r_ij . Gamma_i grad W_ij) / (r_ij^2 + eta^2), Gamma_i of eq. 19"
    source = (
        "Oger, Doring, Alessandrini & Ferrant 2007; Hosseini & Feng 2011; Khayyer, Gotoh & Shao 2008; "
        "Zheng, Ma & Shao 2018, eq. 20 (VISC-04)"
    )
    own_correction = True

    def preparation(self, kernel: Kernel, correction: Correction) -> Preparation | None:
        """Gamma."""
        return Renormalised().preparation(kernel)

    def weight(self, kernel: Kernel, correction: Correction, own: Any, d: Vector, r2: Scalar) -> Scalar:
        """w_ij = -2 (r_ij . Gamma_i grad W_ij) / (r_ij^2 + eta^2)."""
        return -2.0 * Renormalised().radial(kernel, own.prepared, d, r2) / regularised(r2, self.eta, kernel)
