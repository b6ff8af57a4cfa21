"""The pressure gradient of projection schemes that conserves momentum."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector, scale
from sphear.engine.formula import Sum
from sphear.kernels import Kernel


@dataclass(frozen=True)
class SymmetricGradient(Sum):
    """grad p_i = sum_j V_j (p_j + p_i) grad W_ij, equal and opposite for the two of a pair.

    Zheng, Ma & Shao 2018, eq. 3, for constant density.
    """

    kernel: Kernel

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Vector:
        """V_j (p_j + p_i) grad W_ij."""
        return scale(other.volume * (other.values[0] + own.values[0]), self.kernel.gradient(d, r2))
