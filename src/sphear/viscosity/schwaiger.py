"""Schwaiger: Morris's form with the leading errors of a one-sided or disordered neighbourhood taken out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from sphear.algebra import Scalar, Vector, apply, dot, outer, scale, trace, transpose
from sphear.corrections import Correction
from sphear.corrections.renormalised import LEAST_QUALITY, RenormalisationPreparation, safe_inverse
from sphear.engine.preparation import Preparation
from sphear.kernels import Kernel
from sphear.viscosity.base import LaplacianTerm, regularised


class SchwaigerMoments(NamedTuple):
    """-trace(H^-1) / d and Gamma^T sum_j V_j grad W_ij of a particle."""

    quality: Scalar
    trace: Scalar
    drift: Vector


@dataclass(frozen=True)
class SchwaigerPreparation:
    """H_i = sum_j V_j (r_ij . grad W_ij / r_ij^2) r_ij (x) r_ij, Gamma_i and sum_j V_j grad W_ij."""

    kernel: Kernel
    eta: float | None

    least_quality = LEAST_QUALITY

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """One neighbour's part of the moments."""
        gradient = scale(other.volume, self.kernel.gradient(d, r2))
        factor = -dot(d, gradient) / regularised(r2, self.eta, self.kernel)
        moment = RenormalisationPreparation(self.kernel).pair(own, other, d, r2)
        return outer(scale(factor, d), d), moment, gradient

    def finish(self, own: Any, total: Any) -> SchwaigerMoments:
        """The inverses; H is -I in the continuum, so -H is summed and inverted."""
        h, moment, gradient = total
        quality_h, inverse_h = safe_inverse(h)
        quality, gamma = safe_inverse(moment)
        drift = apply(transpose(gamma), gradient)
        return SchwaigerMoments(quality_h * quality, trace(inverse_h) / own.dimension, drift)


@dataclass(frozen=True, repr=False)
class Schwaiger(LaplacianTerm):
    """lap u_i = -trace(H^-1)/d (2 sum_j V_j u_ij r_ij.grad W_ij / r_ij^2 - 2 <grad u>_i . sum_j V_j grad W_ij).

    The sign makes the bracket's limit lap u, because H tends to -I; <grad u> is renormalised (eqs. 18, 19).

    Args:
        eta: regularisation in smoothing lengths; None leaves it out.

    Raises:
        SphearError: eta is negative.

    Examples:
        >>> import sphear
        >>> sphear.VISCOSITY["VISC-03"] == sphear.Schwaiger()
        True
        >>> print(sphear.Schwaiger())
        Schwaiger(eta=None)
          ...
          order, lattice   +2.0   (of the L1 error in dx, h fixed in dx)
          order, jittered  -0.1   (jitter 0.3 dx)
          ...
    """

    eta: float | None = None

    name = "schwaiger"
    aliases = ("VISC-03",)
    formula = (
        "mu_i / rho_i trace(-H_i^-1) / d (2 sum_j V_j u_ij (r_ij . grad W_ij) / (r_ij^2 + eta^2)"
        " - 2 <grad u>_i . sum_j V_j grad W_ij)"
    )
    source = "Schwaiger 2008; Zheng, Ma & Shao 2018, eqs. 17-19 (VISC-03)"
    own_correction = True

    def preparation(self, kernel: Kernel, correction: Correction) -> Preparation | None:
        """H, Gamma and the sum of the kernel gradients."""
        return SchwaigerPreparation(kernel, self.eta)

    def weight(self, kernel: Kernel, correction: Correction, own: Any, d: Vector, r2: Scalar) -> Scalar:
        """w_ij = -2 trace(-H^-1)/d ((r_ij . grad W_ij) / r_ij^2 + (Gamma grad W_ij) . sum_k V_k grad W_ik)."""
        gradient = kernel.gradient(d, r2)
        bracket = dot(d, gradient) / regularised(r2, self.eta, kernel) + dot(own.prepared.drift, gradient)
        return -2.0 * own.prepared.trace * bracket
