"""The concentration of particles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector
from sphear.kernels import Kernel


@dataclass(frozen=True)
class Concentration:
    """sum_j V_j W_ij, the particle itself included: about 1 inside a fluid."""

    kernel: Kernel

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Vector:
        """V_j W_ij."""
        return (other.volume * self.kernel.value(r2, len(d)),)

    def finish(self, own: Any, total: Vector) -> Vector:
        """The sum with V_i W(0)."""
        return (total[0] + own.volume * self.kernel.value_at_zero(own.dimension),)
