"""Consistency of order one: the mixed kernel and gradient correction of Bonet & Lok."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from sphear.algebra import Matrix, Scalar, Vector, apply, combine, outer, scale
from sphear.corrections.base import Correction
from sphear.corrections.renormalised import LEAST_QUALITY, safe_inverse
from sphear.corrections.shepard import Shepard, ShepardPreparation, ShepardSums
from sphear.kernels import Kernel


class BonetLokSums(NamedTuple):
    """The Shepard sums of a particle and its matrix L."""

    quality: Scalar
    shepard: ShepardSums
    matrix: Matrix


@dataclass(frozen=True)
class BonetLokPreparation:
    """The Shepard sums and L_a = (sum_b V_b grad W^[0]_ab (x) r_b)^-1, in one sweep.

    grad W^[0] = grad W / <1> - W grad<1> / <1>^2 needs sums that are known only afterwards, but it is linear in grad W
    and W: their first moments suffice. r_b may be taken from r_a because grad W^[0] sums to zero.
    """

    kernel: Kernel
    second_derivatives: bool

    least_quality = LEAST_QUALITY

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """One neighbour's part of the Shepard sums and of the first moments of W and grad W."""
        return (
            ShepardPreparation(self.kernel, self.second_derivatives).pair(own, other, d, r2),
            scale(-other.volume * self.kernel.value(r2, len(d)), d),
            outer(scale(-other.volume, self.kernel.gradient(d, r2)), d),
        )

    def finish(self, own: Any, total: Any) -> BonetLokSums:
        """L by inversion of the moment of grad W^[0]."""
        sums, first, moment = total
        shepard = ShepardPreparation(self.kernel, self.second_derivatives).finish(own, sums)
        s = 1.0 / shepard.one
        quality, matrix = safe_inverse(combine(s, moment, -(s**2), outer(shepard.gradient, first)))
        return BonetLokSums(quality, shepard, matrix)


@dataclass(frozen=True)
class BonetLok(Correction):
    """Level 1: the Shepard kernel with its gradient multiplied by L, which makes gradients of linear fields exact.

    L_i = (sum_j V_j grad W^[0]_ij (x) r_j)^-1, W^[0] being that of `Shepard`. Second derivatives are those of level 0,
    too: the mixed correction has none of its own (Bonet & Lok 1999; Basa, Quinlan & Lastiwka 2009, eqs. 24 to 26).

    Examples:
        >>> import numpy as np
        >>> import sphear
        >>> positions = np.argwhere(np.ones((20, 20))) / 20  # a lattice, 0.05 apart
        >>> gradients = sphear.gradient(positions, 3 * positions[:, 0], spacing=0.05, correction=sphear.BonetLok())
        >>> print(gradients[0, 0].round(2))  # in the corner
        3.0
    """

    name = "bonet_lok"
    aliases = ("1", "level_1", "first_order", "order_1")
    formula = "W~_ab = W_ab / <1>_a, grad W~_ab = L_a grad W^[0]_ab, L_a = (sum_b V_b grad W^[0]_ab (x) r_b)^-1"
    source = "Bonet & Lok 1999; Basa, Quinlan & Lastiwka 2009, eqs. 24-26"
    zeroth_order = True

    def preparation(self, kernel: Kernel, second_derivatives: bool = False) -> BonetLokPreparation:
        """The Shepard sums and L."""
        return BonetLokPreparation(kernel, second_derivatives)

    def value(self, kernel: Kernel, prepared: BonetLokSums, d: Vector, r2: Scalar) -> Scalar:
        """Eq. 25."""
        return Shepard().value(kernel, prepared.shepard, d, r2)

    def gradient(self, kernel: Kernel, prepared: BonetLokSums, d: Vector, r2: Scalar) -> Vector:
        """Eq. 26: L grad W^[0]."""
        return apply(prepared.matrix, Shepard().gradient(kernel, prepared.shepard, d, r2))

    def gradient_at_zero(self, kernel: Kernel, prepared: BonetLokSums, dimension: int) -> Vector:
        """Eq. 26 at r = 0."""
        return apply(prepared.matrix, Shepard().gradient_at_zero(kernel, prepared.shepard, dimension))

    def hessian(self, kernel: Kernel, prepared: BonetLokSums, d: Vector, r2: Scalar) -> Matrix:
        """Eq. 23."""
        return Shepard().hessian(kernel, prepared.shepard, d, r2)
