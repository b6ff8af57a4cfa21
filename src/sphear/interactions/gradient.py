"""First derivatives of fields: the gradient of each component, and the divergence of a tensor's rows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Matrix, Scalar, Vector, dot, outer, scale, subtract
from sphear.corrections import Correction
from sphear.engine.formula import Sum
from sphear.kernels import Kernel


@dataclass(frozen=True)
class Gradient(Sum):
    """d f_k / d x_a at particle i, row k, column a.

    Of differences, sum_j V_j (f_j - f_i) grad W~_ij: zero for constant f whatever the particles. Of values,
    sum_j V_j f_j grad W~_ij (Basa, Quinlan & Lastiwka 2009, eq. 2). With a correction of order zero both are the same
    sum, because sum_j V_j grad W~_ij vanishes.
    """

    kernel: Kernel
    correction: Correction
    of_differences: bool

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Matrix:
        """V_j (f_j - f_i) (x) grad W~_ij."""
        gradient = scale(other.volume, self.correction.gradient(self.kernel, own.prepared, d, r2))
        if self.of_differences or self.correction.zeroth_order:
            return outer(subtract(other.values, own.values), gradient)
        return outer(other.values, gradient)


@dataclass(frozen=True)
class Divergence(Sum):
    """sum_a d T_ka / d x_a for each row k of the field `before`, (rows of T) x d numbers a particle."""

    kernel: Kernel
    correction: Correction

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Vector:
        """V_j T_j grad W~_ij, with T_j - T_i for T_j where the correction has order zero."""
        gradient = scale(other.volume, self.correction.gradient(self.kernel, own.prepared, d, r2))
        tensor = subtract(other.before, own.before) if self.correction.zeroth_order else other.before
        size = len(d)
        return tuple(dot(tensor[k : k + size], gradient) for k in range(0, len(tensor), size))
