"""Consistency of order zero: the kernel divided by its own sum."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from sphear.algebra import Matrix, Scalar, Vector, add, combine, outer, scale, subtract, transpose
from sphear.corrections.base import Correction
from sphear.kernels import Kernel


class ShepardSums(NamedTuple):
    """<1>, its gradient and its second derivatives at a particle."""

    quality: Scalar
    one: Scalar
    gradient: Vector
    hessian: Matrix


@dataclass(frozen=True)
class ShepardPreparation:
    """<1>_a = sum_b V_b W_ab and its first and (if asked for) second derivatives, the particle itself included."""

    kernel: Kernel
    second_derivatives: bool

    least_quality = 0.0

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """One neighbour's part of the sums."""
        hessian = self.kernel.hessian(d, r2) if self.second_derivatives else ()
        return (
            other.volume * self.kernel.value(r2, len(d)),
            scale(other.volume, self.kernel.gradient(d, r2)),
            tuple(scale(other.volume, row) for row in hessian),
        )

    def finish(self, own: Any, total: Any) -> ShepardSums:
        """The sums with the particle's own part, for which grad W is zero."""
        one, gradient, hessian = total
        at_zero = self.kernel.hessian_at_zero(own.dimension) if self.second_derivatives else ()
        return ShepardSums(
            quality=1.0,  # the particle itself keeps <1> positive
            one=one + own.volume * self.kernel.value_at_zero(own.dimension),
            gradient=gradient,
            hessian=combine(1.0, hessian, own.volume, at_zero),
        )


@dataclass(frozen=True)
class Shepard(Correction):
    """Level 0: W~ = W / <1>, differentiated as a quotient.

    Constants are reproduced exactly, and the derivatives of a constant are zero. <1>_i = sum_j V_j W_ij, the particle
    itself included (Basa, Quinlan & Lastiwka 2009, eqs. 21 to 23).

    Examples:
        >>> import numpy as np
        >>> import sphear
        >>> positions = np.argwhere(np.ones((20, 20))) / 20  # a lattice, 0.05 apart
        >>> values = sphear.interpolate(positions, np.ones(400), spacing=0.05, correction=sphear.Shepard())
        >>> print(values[0].round(2))  # in the corner
        1.0
    """

    name = "shepard"
    aliases = ("0", "level_0", "zero_order", "order_0")
    formula = "W~_ab = W_ab / <1>_a, its derivatives by the quotient rule"
    source = "Basa, Quinlan & Lastiwka 2009, eqs. 21-23"
    zeroth_order = True

    def preparation(self, kernel: Kernel, second_derivatives: bool = False) -> ShepardPreparation:
        """<1> and its derivatives."""
        return ShepardPreparation(kernel, second_derivatives)

    def value(self, kernel: Kernel, prepared: ShepardSums, d: Vector, r2: Scalar) -> Scalar:
        """Eq. 21."""
        return kernel.value(r2, len(d)) / prepared.one

    def gradient(self, kernel: Kernel, prepared: ShepardSums, d: Vector, r2: Scalar) -> Vector:
        """Eq. 22."""
        part = scale(kernel.value(r2, len(d)) / prepared.one, prepared.gradient)
        return scale(1.0 / prepared.one, subtract(kernel.gradient(d, r2), part))

    def gradient_at_zero(self, kernel: Kernel, prepared: ShepardSums, dimension: int) -> Vector:
        """Eq. 22 at r = 0, where grad W is zero but grad <1> is not."""
        return scale(-kernel.value_at_zero(dimension) / prepared.one**2, prepared.gradient)

    def hessian(self, kernel: Kernel, prepared: ShepardSums, d: Vector, r2: Scalar) -> Matrix:
        """Eq. 23."""
        s, grad_s, w, grad_w = 1.0 / prepared.one, prepared.gradient, kernel.value(r2, len(d)), kernel.gradient(d, r2)
        mixed = outer(grad_w, grad_s)
        result = combine(s, kernel.hessian(d, r2), -(s**2) * w, prepared.hessian)
        result = combine(1.0, result, -(s**2), tuple(map(add, mixed, transpose(mixed))))
        return combine(1.0, result, 2.0 * w * s**3, outer(grad_s, grad_s))
