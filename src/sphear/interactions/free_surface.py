"""Sums that tell the particles on a free surface from those inside."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from sphear.algebra import Scalar, Vector, dot, outer, scale, sqrt, subtract, where_less
from sphear.corrections import Correction
from sphear.engine.formula import Sum
from sphear.kernels import Kernel

if TYPE_CHECKING:
    from sphear.viscosity.base import LaplacianTerm


@dataclass(frozen=True)
class ConcentrationMoments:
    """sum_j V_j W_ij, the particle itself included, sum_j V_j grad W_ij and sum_j V_j grad W_ij (x) (r_j - r_i).

    The first is about 1 inside, the second vanishes there and points into the fluid elsewhere, the third is about the
    unit matrix inside.
    """

    kernel: Kernel

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """The pair's part of all three."""
        gradient = scale(other.volume, self.kernel.gradient(d, r2))
        return other.volume * self.kernel.value(r2, len(d)), gradient, outer(gradient, scale(-1.0, d))

    def finish(self, own: Any, total: Any) -> Any:
        """The sums."""
        value, *others = total
        return value + own.volume * self.kernel.value_at_zero(own.dimension), *others


@dataclass(frozen=True)
class Umbrella(Sum):
    """The number of neighbours under an umbrella of 45 degrees that a particle holds against the outside.

    Marrone, Colagrossi, Le Touze & Graziani 2010, Fast free-surface detection and level-set function definition in SPH
    solvers, J. Comput. Phys. 229:3652, eq. 8: the umbrella ends at T = r_i + l n, l its length, n the outward normal.

    Args:
        kernel: beyond whose support nobody counts.
        length: l.
    """

    kernel: Kernel
    length: float

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Vector:
        """1 if the neighbour is under the umbrella, else 0."""
        to_other = scale(-1.0, d)
        normal = scale(-1.0, own.inward)
        from_tip = subtract(to_other, scale(self.length, normal))
        far = where_less(dot(from_tip, from_tip), self.length**2, 1.0, 0.0)
        along = dot(to_other, normal)
        near = where_less(sqrt(0.5 * r2), along, 1.0, 0.0)
        inside = where_less(r2, self.kernel.radius**2, 1.0, 0.0) * where_less(0.0, other.volume, 1.0, 0.0)
        return (inside * where_less(r2, 2.0 * self.length**2, near, far),)


@dataclass(frozen=True)
class LaplacianMoments(Sum):
    """sum_j V_j w_ij and sum_j V_j w_ij (r_j - r_i) of a Laplacian's weights: what is missing at a surface."""

    term: LaplacianTerm
    kernel: Kernel
    correction: Correction

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Vector:
        """The pair's part of both."""
        weight = other.volume * self.term.weight(self.kernel, self.correction, own, d, r2)
        return (weight, *scale(-weight, d))
