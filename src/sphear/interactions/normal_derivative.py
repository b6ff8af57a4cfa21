"""The derivative of a field along a wall's normal, from the particles before the wall."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from sphear.algebra import Scalar, Vector, apply, dot, scale, transpose
from sphear.corrections.renormalised import safe_inverse
from sphear.engine.formula import Weights
from sphear.kernels import Kernel


class NormalCoefficients(NamedTuple):
    """M^-1 n of a point on a wall; zero where M is singular."""

    coefficients: Vector


@dataclass(frozen=True)
class NormalFit:
    """M^-1 n with M = sum_j V_j W_j r_ji (x) r_ji / r_ij^2.

    The simplified finite difference interpolation (SFDI) of Ma 2008, A new meshless interpolation scheme for MLPG_R
    method, CMES 23:75: the plane through the point's own value that fits the others best with weights W / r^2.
    """

    kernel: Kernel

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """One particle's part of M."""
        weight = other.volume * self.kernel.value(r2, len(d)) / r2
        return tuple(scale(weight * a, d) for a in d)

    def finish(self, own: Any, total: Any) -> NormalCoefficients:
        """M^-1 n."""
        _, inverse = safe_inverse(total)
        return NormalCoefficients(apply(transpose(inverse), own.normal))


@dataclass(frozen=True)
class NormalWeights(Weights):
    """The weights of n . grad f = sum_j w_j (f_j - f_i)."""

    kernel: Kernel

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Vector:
        """V_j W_j (M^-1 n) . r_ji / r^2."""
        weight = other.volume * self.kernel.value(r2, len(d)) / r2
        return (-weight * dot(own.prepared.coefficients, d),)
