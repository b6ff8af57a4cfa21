"""Fatehi & Manzari: a second derivative that is exact for quadratic fields on any particles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from sphear.algebra import Matrix, Scalar, Vector, apply, dot, scale, solve, trace, transpose, where_less
from sphear.corrections import Correction
from sphear.corrections.renormalised import LEAST_QUALITY, safe_inverse
from sphear.engine.preparation import Preparation
from sphear.kernels import Kernel
from sphear.viscosity.base import LaplacianTerm
from sphear.viscosity.monomials import exponents, index_pairs, monomial


class FatehiManzariMoments(NamedTuple):
    """The symmetric tensor B of a particle and the vector Gamma^T q, which takes the first-order error out."""

    quality: Scalar
    tensor: Matrix
    drift: Vector


@dataclass(frozen=True)
class FatehiManzariPreparation:
    """B from B : A = -I, which makes the term exact for quadratic fields.

    With g = (dW/dr) / r and d = r_ij,

    A_mnab = sum V g d_m d_n d_a d_b / r^2 + (sum V g d_m d_n d_k / r^2) Gamma_kl (sum V g d_a d_b d_l).
    """

    kernel: Kernel

    least_quality = LEAST_QUALITY

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """One neighbour's part of the moments: symmetric tensors of d, each component once."""
        g = other.volume * self.kernel.gradient_factor(r2, len(d))
        second, third, fourth = (tuple(monomial(d, e) for e in exponents(len(d), degree)) for degree in (2, 3, 4))
        return (
            scale(-g, second),
            scale(g, third),
            scale(g / r2, third),
            scale(g / r2, fourth),
        )

    def finish(self, own: Any, total: Any) -> FatehiManzariMoments:
        """Gamma by inversion, B by elimination."""
        size = own.dimension
        axes = range(size)
        second, third, third_r, fourth = (
            dict(zip(exponents(size, degree), values, strict=True))
            for degree, values in zip((2, 3, 3, 4), total, strict=True)
        )

        def component(tensor: dict[tuple[int, ...], Scalar], *indices: int) -> Scalar:
            return tensor[tuple(indices.count(axis) for axis in axes)]

        moment = tuple(tuple(component(second, a, b) for b in axes) for a in axes)
        quality, gamma = safe_inverse(moment)
        pairs = index_pairs(size)

        def first_order_error(a: int, b: int) -> Vector:
            return apply(gamma, tuple(component(third, a, b, axis) for axis in axes))

        # one equation for each component (a, b) of the second derivatives, one unknown for each (m, n) of B
        rows = []
        for a, b in pairs:
            error = first_order_error(a, b)
            rows.append(
                tuple(
                    (1.0 if m == n else 2.0)
                    * (component(fourth, m, n, a, b) + dot(tuple(component(third_r, m, n, k) for k in axes), error))
                    for m, n in pairs
                )
            )
        pivot, packed = solve(tuple(rows), tuple(-1.0 if a == b else 0.0 for a, b in pairs))
        tensor = tuple(tuple(packed[pairs.index((min(a, b), max(a, b)))] for b in axes) for a in axes)
        q = tuple(
            sum((2.0 * tensor[m][n] * component(third_r, m, n, k) for m in axes for n in axes), 0.0) for k in axes
        )
        # B : A cancels to rounding where neighbours are too few; what it is made of has the size of tr(sum V g d d)
        size_of_moments = trace(moment)
        quality = quality * where_less(
            0.0, size_of_moments, pivot / where_less(0.0, size_of_moments, size_of_moments, 1.0), 0.0
        )
        return FatehiManzariMoments(quality, tensor, apply(transpose(gamma), q))


@dataclass(frozen=True, repr=False)
class FatehiManzari(LaplacianTerm):
    """lap u_i = B_i : sum_j 2 V_j e_ij (x) grad W_ij (u_ij / r_ij - e_ij . <grad u>_i), <grad u> renormalised.

    B is the symmetric tensor that makes the sum exact for every quadratic field, so that the error on disordered
    particles is of first order; on a lattice of second.

    Examples:
        >>> import sphear
        >>> sphear.VISCOSITY["fatehi"] == sphear.FatehiManzari()
        True
        >>> print(sphear.FatehiManzari())
        FatehiManzari()
          ...
          order, lattice   +2.0   (of the L1 error in dx, h fixed in dx)
          order, jittered  +1.3   (jitter 0.3 dx)
          ...
    """

    name = "fatehi_manzari"
    aliases = ("fatehi",)
    formula = "mu_i / rho_i B_i : sum_j 2 V_j e_ij (x) grad W_ij (u_ij / r_ij - e_ij . <grad u>_i)"
    source = "Fatehi & Manzari 2011, Error estimation in SPH and a new scheme for second derivatives, CMA 61:482"
    own_correction = True

    def preparation(self, kernel: Kernel, correction: Correction) -> Preparation | None:
        """B and the drift."""
        return FatehiManzariPreparation(kernel)

    def weight(self, kernel: Kernel, correction: Correction, own: Any, d: Vector, r2: Scalar) -> Scalar:
        """w_ij = -(1/r dW/dr) (2 d.B d / r^2 + d . Gamma^T q)."""
        moments = own.prepared
        along = 2.0 * dot(d, apply(moments.tensor, d)) / r2
        return -kernel.gradient_factor(r2, len(d)) * (along + dot(d, moments.drift))
