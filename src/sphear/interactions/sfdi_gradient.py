"""The gradient of simplified finite difference interpolation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Matrix, Scalar, Vector, apply, outer, scale, subtract
from sphear.corrections.renormalised import LEAST_QUALITY, Renormalisation, safe_inverse
from sphear.engine.formula import Sum
from sphear.kernels import Kernel


@dataclass(frozen=True)
class SfdiFit:
    """M^-1 with M = sum_j V_j W_j r_ji (x) r_ji / r_ij^2 of each particle; zero where M is singular."""

    kernel: Kernel

    least_quality = LEAST_QUALITY

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Matrix:
        """One neighbour's part of M."""
        return outer(scale(other.volume * self.kernel.value(r2, len(d)) / r2, d), d)

    def finish(self, own: Any, total: Matrix) -> Renormalisation:
        """M^-1."""
        return Renormalisation(*safe_inverse(total))


@dataclass(frozen=True)
class SfdiGradient(Sum):
    """grad f_i = M^-1 sum_j V_j W_j (f_j - f_i) r_ji / r_ij^2, exact for linear fields.

    The plane through the particle's own value that fits the others best with weights W / r^2 (SFDI, Ma 2008, A new
    meshless interpolation scheme for MLPG_R method, CMES 23:75).
    """

    kernel: Kernel

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Matrix:
        """V_j W_j (f_j - f_i) (x) M^-1 r_ji / r^2."""
        weight = -other.volume * self.kernel.value(r2, len(d)) / r2
        return outer(subtract(other.values, own.values), apply(own.prepared.matrix, scale(weight, d)))
