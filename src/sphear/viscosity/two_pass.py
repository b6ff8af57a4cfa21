"""Flebbe, Watkins: two nested first derivatives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector, add, scale, trace, transpose
from sphear.corrections import Correction
from sphear.engine.formula import Interaction
from sphear.interactions import Divergence, Gradient, ViscousAcceleration
from sphear.kernels import Kernel
from sphear.viscosity.base import LaplacianTerm


@dataclass(frozen=True)
class ViscousStress:
    """tau_ab = mu (d u_a / dx_b + d u_b / dx_a - 2/3 div u delta_ab), first pass (Basa's eq. 4), d x d numbers."""

    kernel: Kernel
    correction: Correction

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """The pair's part of grad u."""
        gradient = scale(other.volume, self.correction.gradient(self.kernel, own.prepared, d, r2))
        zeroth = self.correction.zeroth_order
        velocity = tuple(u - v for u, v in zip(other.velocity, own.velocity, strict=True)) if zeroth else other.velocity
        return tuple(scale(component, gradient) for component in velocity)

    def finish(self, own: Any, total: Any) -> Any:
        """The stress from grad u."""
        symmetric = tuple(map(add, total, transpose(total)))
        pressure = -2.0 / 3.0 * trace(total)
        mu = own.dynamic_viscosity
        return tuple(
            tuple(mu * (x + pressure) if a == b else mu * x for b, x in enumerate(row))
            for a, row in enumerate(symmetric)
        )


@dataclass(frozen=True, repr=False)
class TwoPass(LaplacianTerm):
    """d2 F / dx_a dx_b = <d/dx_a <dF/dx_b>>: a first derivative of first derivatives, in two sweeps.

    Information comes from twice the kernel's support, so walls and edges must be twice as thick.

    Examples:
        >>> import sphear
        >>> sphear.VISCOSITY["B"] == sphear.TwoPass()
        True
        >>> print(sphear.TwoPass())
        TwoPass()
          ...
          order, lattice   +0.3   (of the L1 error in dx, h fixed in dx)
          order, jittered  -2.0   (jitter 0.3 dx)
          ...
    """

    name = "two_pass"
    aliases = ("B", "flebbe", "watkins", "flebbe_watkins")
    formula = "1 / rho_i sum_j V_j tau_j grad W_ij, tau_j from grad u_j = sum_k V_k u_k (x) grad W_jk"
    source = "Flebbe et al. 1994; Watkins et al. 1996; Basa, Quinlan & Lastiwka 2009, eqs. 5, 29 (model B)"
    varies_viscosity = True
    where_it_varies = "div(mu grad u) + (grad u)^T grad mu"

    def laplacian_stages(self, kernel: Kernel, correction: Correction) -> tuple[Interaction, ...]:
        """The gradient of each component, then its divergence."""
        return Gradient(kernel, correction, of_differences=False), Divergence(kernel, correction)

    def acceleration_stages(self, kernel: Kernel, correction: Correction) -> tuple[Interaction, ...]:
        """The stress, then its divergence."""
        return ViscousStress(kernel, correction), ViscousAcceleration(self, kernel, correction)

    def acceleration(
        self, kernel: Kernel, correction: Correction, own: Any, other: Any, d: Vector, r2: Scalar
    ) -> Vector:
        """The pair's part of div tau / rho, of the stresses `before`."""
        divergence = Divergence(kernel, correction).pair(own, other, d, r2)
        return scale(1.0 / own.density, divergence)
