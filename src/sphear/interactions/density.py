"""Density by summation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector
from sphear.kernels import Kernel


@dataclass(frozen=True)
class SummationDensity:
    """rho_i = sum_j m_j W_ij, the particle itself included (Basa, Quinlan & Lastiwka 2009, eq. 11)."""

    kernel: Kernel

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Vector:
        """m_j W_ij."""
        return (other.mass * self.kernel.value(r2, len(d)),)

    def finish(self, own: Any, total: Vector) -> Vector:
        """The sum with m_i W(0)."""
        return (total[0] + own.mass * self.kernel.value_at_zero(own.dimension),)
