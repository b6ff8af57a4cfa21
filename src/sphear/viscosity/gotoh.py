"""Gotoh: the divergence of an SPH gradient, with the kernel's second derivative."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector, apply, dot, trace
from sphear.corrections import Correction
from sphear.errors import SphearError
from sphear.kernels import Kernel
from sphear.viscosity.base import LaplacianTerm


@dataclass(frozen=True, repr=False)
class Gotoh(LaplacianTerm):
    """lap u_i = 2 / (d + 2) sum_j V_j (u_j - u_i) (W'' - W'/r).

    Eq. 16 as printed has u_ij = u_i - u_j and no factor: in 2-D its limit is -2 lap u, and Table 1 of that paper is
    reproduced by the form above, with (u_j - u_i) / 2. For d dimensions expand u_j to second order: by parts,
    int (W'' - W'/r) r^2 dV = d (d + 2), so that the factor is 2 / (d + 2), which is 1 / 2 in 2-D and 2 / 5 in 3-D.

    Args:
        printed: the form as printed, to be compared with.

    Examples:
        >>> import sphear
        >>> print(sphear.Incompressible(viscosity=sphear.Gotoh(printed=True)))
        Incompressible(viscosity=Gotoh(printed=True))
        >>> print(sphear.Gotoh())
        Gotoh(printed=False)
          ...
          order, lattice   +0.0   (of the L1 error in dx, h fixed in dx)
          order, jittered  -1.1   (jitter 0.3 dx)
          ...
    """

    printed: bool = False

    name = "gotoh"
    aliases = ("VISC-02",)
    formula = "mu_i / rho_i 2 / (d + 2) sum_j V_j (u_j - u_i) (W''_ij - W'_ij / r_ij)"
    source = "Gotoh et al. 2014; Zheng, Ma & Shao 2018, eq. 16 (VISC-02), sign and factor corrected"
    uses_second_derivatives = True

    def weight(self, kernel: Kernel, correction: Correction, own: Any, d: Vector, r2: Scalar) -> Scalar:
        """w_ij = 2 / (d + 2) (W'' - W'/r); with a corrected kernel W'' is taken along r and W'/r across it."""
        dimension = len(d)
        factor = -1.0 if self.printed else 2.0 / (dimension + 2)
        if correction.name in ("none", "renormalised"):
            return factor * (kernel.second_derivative(r2, dimension) - kernel.gradient_factor(r2, dimension))
        if dimension == 1:
            raise SphearError("viscosity 'gotoh' takes no correction in one dimension: there is nothing across r")
        hessian = correction.hessian(kernel, own.prepared, d, r2)
        along = dot(d, apply(hessian, d)) / r2
        across = (trace(hessian) - along) / (dimension - 1)
        return factor * (along - across)
