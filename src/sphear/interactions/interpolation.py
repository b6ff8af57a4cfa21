"""Fields carried by particles, evaluated anywhere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector, scale
from sphear.engine.formula import Sum
from sphear.kernels import Kernel


@dataclass(frozen=True)
class Interpolation(Sum):
    """sum_j V_j f_j W_ij and sum_j V_j W_ij (Basa, Quinlan & Lastiwka 2009, eqs. 1 and 21).

    At a point of evaluation; the particles do not include the point.
    """

    kernel: Kernel

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """The pair's part of both sums."""
        weight = other.volume * self.kernel.value(r2, len(d))
        return scale(weight, other.values), weight


@dataclass(frozen=True)
class LinearFitSums(Sum):
    """The sums of the plane that fits a field around a point best: V_j W_ij times 1, y, f, y (x) y and y (x) f.

    y = (r_j - r_i) / h. At a point of evaluation, as `Interpolation`.
    """

    kernel: Kernel

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """The pair's part of the sums; of the symmetric ones the upper triangle."""
        weight = other.volume * self.kernel.value(r2, len(d))
        y = scale(-1.0 / self.kernel.h, d)
        wy = scale(weight, y)
        squares = tuple(wy[a] * y[b] for a in range(len(d)) for b in range(a, len(d)))
        return weight, wy, scale(weight, other.values), squares, tuple(scale(x, other.values) for x in wy)


@dataclass(frozen=True)
class NumberDensity:
    """sum_j W_ij, the particle itself included: one over the volume of a particle."""

    kernel: Kernel

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Vector:
        """W_ij."""
        return (self.kernel.value(r2, len(d)),)

    def finish(self, own: Any, total: Vector) -> Vector:
        """The sum with W(0)."""
        return (total[0] + self.kernel.value_at_zero(own.dimension),)
