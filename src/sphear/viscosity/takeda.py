"""Takeda: second derivatives taken directly from the kernel's second derivative."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Matrix, Scalar, Vector, add, apply, scale, subtract, trace
from sphear.corrections import Correction
from sphear.kernels import Kernel
from sphear.viscosity.base import LaplacianTerm


@dataclass(frozen=True, repr=False)
class Takeda(LaplacianTerm):
    """d2 u / dx_a dx_b = sum_j V_j u_j d2 W_ij / dx_a dx_b, the particle itself included.

    The viscous acceleration is that of a compressible fluid of constant viscosity, mu (lap u + grad div u / 3)
    (eq. 6). With level 0 or 1 the second derivatives are those of the Shepard kernel (eq. 23).

    Examples:
        >>> import sphear
        >>> sphear.VISCOSITY["A"] == sphear.Takeda()
        True
        >>> print(sphear.Takeda())
        Takeda()
          ...
          order, lattice   -2.0   (of the L1 error in dx, h fixed in dx)
          order, jittered  -2.0   (jitter 0.3 dx)
          ...
    """

    name = "takeda"
    aliases = ("A", "direct")
    formula = "mu_i / rho_i sum_j V_j (lap W_ij u_j + grad grad W_ij u_j / 3), j = i included"
    source = "Takeda, Miyama & Sekiya 1994; Basa, Quinlan & Lastiwka 2009, eqs. 6, 27, 28 and 23 (model A)"
    uses_second_derivatives = True

    def of_differences(self, correction: Correction) -> bool:
        """Derivatives of the Shepard kernel sum to zero, so that differences give the same sum."""
        return correction.zeroth_order

    def weight(self, kernel: Kernel, correction: Correction, own: Any, d: Vector, r2: Scalar) -> Scalar:
        """w_ij = lap W_ij."""
        return trace(correction.hessian(kernel, own.prepared, d, r2))

    def weight_at_zero(self, kernel: Kernel, correction: Correction, own: Any) -> Scalar:
        """w_ii = lap W(0)."""
        return trace(kernel.hessian_at_zero(own.dimension))

    def acceleration(
        self, kernel: Kernel, correction: Correction, own: Any, other: Any, d: Vector, r2: Scalar
    ) -> Vector:
        """(mu / rho_i) V_j (lap W + grad grad W / 3) u_j."""
        velocity = subtract(other.velocity, own.velocity) if self.of_differences(correction) else other.velocity
        hessian = correction.hessian(kernel, own.prepared, d, r2)
        return scale(own.dynamic_viscosity / own.density * other.volume, _stress_divergence(hessian, velocity))

    def own_acceleration(self, kernel: Kernel, correction: Correction, own: Any) -> Vector | None:
        """The same at r = 0."""
        if self.of_differences(correction):
            return None
        factor = own.dynamic_viscosity / own.density * own.volume
        return scale(factor, _stress_divergence(kernel.hessian_at_zero(own.dimension), own.velocity))


def _stress_divergence(hessian: Matrix, velocity: Vector) -> Vector:
    return add(scale(trace(hessian), velocity), scale(1.0 / 3.0, apply(hessian, velocity)))
