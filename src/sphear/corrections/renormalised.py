"""The kernel gradient, renormalised so that gradients of linear fields are exact when formed of differences."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from sphear.algebra import Matrix, Scalar, Vector, adjugate, apply, determinant, outer, scale, trace, where_less
from sphear.corrections.base import Correction
from sphear.kernels import Kernel

LEAST_QUALITY = 1e-6


def safe_inverse(moment: Matrix) -> tuple[Scalar, Matrix]:
    """A quality between 0 (singular) and 1 (isotropic), and the inverse; zeros where the quality is too low.

    The quality det M / (tr M / d)^d does not depend on the size of M, only on how unevenly it treats directions.
    """
    dimension = len(moment)
    mean = (1.0 / dimension) * trace(moment)
    det = determinant(moment)
    size = mean**dimension
    quality = where_less(1e-12, size, det / where_less(1e-12, size, size, 1.0), 0.0)
    factor = where_less(LEAST_QUALITY, quality, 1.0 / where_less(LEAST_QUALITY, quality, det, 1.0), 0.0)
    return quality, tuple(scale(factor, row) for row in adjugate(moment))


class Renormalisation(NamedTuple):
    """The matrix Gamma of a particle."""

    quality: Scalar
    matrix: Matrix


@dataclass(frozen=True)
class RenormalisationPreparation:
    """Gamma_i = (sum_j V_j grad W_ij (x) (r_j - r_i))^-1."""

    kernel: Kernel

    least_quality = LEAST_QUALITY

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Matrix:
        """One neighbour's part of the moment."""
        return outer(scale(-other.volume, self.kernel.gradient(d, r2)), d)

    def finish(self, own: Any, total: Matrix) -> Renormalisation:
        """The inverse of the moment."""
        return Renormalisation(*safe_inverse(total))


@dataclass(frozen=True)
class Renormalised(Correction):
    """The gradient renormalisation of Oger et al.: grad W~ = Gamma grad W; W and its second derivatives stay.

    Gamma_i = (sum_j V_j grad W_ij (x) (r_j - r_i))^-1: gradients of linear fields from differences are exact (Oger,
    Doring, Alessandrini & Ferrant 2007; Zheng, Ma & Shao 2018, eq. 19).

    Examples:
        >>> import numpy as np
        >>> import sphear
        >>> positions = np.argwhere(np.ones((20, 20))) / 20  # a lattice, 0.05 apart
        >>> gradients = sphear.gradient(positions, 3 * positions[:, 0], spacing=0.05, correction=sphear.Renormalised())
        >>> print(gradients[0, 0].round(2))  # in the corner
        3.0
    """

    name = "renormalised"
    aliases = ("oger", "renormalized", "gradient")
    formula = "grad W~_ij = Gamma_i grad W_ij, Gamma_i = (sum_j V_j grad W_ij (x) (r_j - r_i))^-1"
    source = "Oger, Doring, Alessandrini & Ferrant 2007; Zheng, Ma & Shao 2018, eq. 19"
    zeroth_order = False

    def preparation(self, kernel: Kernel, second_derivatives: bool = False) -> RenormalisationPreparation:
        """Gamma."""
        return RenormalisationPreparation(kernel)

    def value(self, kernel: Kernel, prepared: Renormalisation, d: Vector, r2: Scalar) -> Scalar:
        """W."""
        return kernel.value(r2, len(d))

    def gradient(self, kernel: Kernel, prepared: Renormalisation, d: Vector, r2: Scalar) -> Vector:
        """Gamma grad W."""
        return apply(prepared.matrix, kernel.gradient(d, r2))

    def hessian(self, kernel: Kernel, prepared: Renormalisation, d: Vector, r2: Scalar) -> Matrix:
        """The second derivatives of W, uncorrected."""
        return kernel.hessian(d, r2)
