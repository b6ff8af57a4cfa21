"""Tamai & Koshizuka: the Laplacian of a weighted polynomial fit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from sphear.algebra import Scalar, Vector, dot, scale
from sphear.corrections import Correction
from sphear.engine.preparation import NormalEquations, Preparation
from sphear.errors import SphearError
from sphear.kernels import Kernel
from sphear.viscosity.base import LaplacianTerm
from sphear.viscosity.monomials import exponents, monomial

if TYPE_CHECKING:
    import numpy as np

DEGREES = (2, 3, 4)


class Fit(NamedTuple):
    """The fit of a particle: its distance from singular, and its Laplacian as a combination of the basis monomials."""

    quality: Scalar
    coefficients: Vector


@dataclass(frozen=True)
class LeastSquaresPreparation(NormalEquations):
    """M_ab = sum_j V_j W_ij x^(a+b) with x = (r_j - r_i) / h, and the solution of M c = the Laplacian of the basis."""

    kernel: Kernel
    degree: int

    least_quality = 1e-9

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Vector:
        """One neighbour's part of the moments, each monomial once."""
        x = scale(-1.0 / self.kernel.h, d)
        weight = other.volume * self.kernel.value(r2, len(d))
        return tuple(weight * monomial(x, powers) for powers in exponents(len(d), 2, 2 * self.degree))

    def template(self, dimension: int) -> Fit:
        """The form of a fit."""
        return Fit(0.0, (0.0,) * len(exponents(dimension, 1, self.degree)))

    def normal_equations(self, dimension: int) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
        """The moment that each entry of M is, (n, n), and the Laplacian of each basis monomial, (n,)."""
        import numpy as np

        basis = exponents(dimension, 1, self.degree)
        place = {powers: k for k, powers in enumerate(exponents(dimension, 2, 2 * self.degree))}
        index = np.array([[place[tuple(map(sum, zip(a, b, strict=True)))] for b in basis] for a in basis])
        return index, np.array([2.0 / self.kernel.h**2 if max(a) == 2 == sum(a) else 0.0 for a in basis])


@dataclass(frozen=True, repr=False)
class LeastSquares(LaplacianTerm):
    """The Laplacian of the polynomial of given degree that fits the neighbours' values best and passes through f_i.

    Exact for polynomials up to the degree, so of order degree - 1 on any particles, and one better where they are
    symmetric (LSMPS type A, equivalently generalised moving least squares). Weights are V_j W_ij.

    Args:
        degree: 2, 3 or 4; in 2-D at least 5, 9 or 14 neighbours are needed, in 3-D 9, 19 or 34.

    Raises:
        SphearError: the degree is none of these.

    Examples:
        >>> import sphear
        >>> sphear.VISCOSITY["least_squares_3"] == sphear.LeastSquares(degree=3)
        True
        >>> print(sphear.LeastSquares())
        LeastSquares(degree=2)
          ...
          order, lattice   +2.0   (of the L1 error in dx, h fixed in dx)
          order, jittered  +1.6   (jitter 0.3 dx)
          ...
    """

    degree: int = 2

    name = "least_squares"
    aliases = ("lsmps", "gmls", "least_squares_2")
    formula = "mu_i / rho_i lap p(r_i), p = argmin sum_j V_j W_ij (p(r_j) - u_j)^2 with p(r_i) = u_i, deg p = degree"
    source = "Tamai & Koshizuka 2014, Least squares moving particle semi-implicit method, Comp. Part. Mech. 1:277"
    own_correction = True

    def __post_init__(self) -> None:
        if self.degree not in DEGREES:
            raise SphearError(f"the degree of viscosity 'least_squares' must be 2, 3 or 4, not {self.degree}")

    def preparation(self, kernel: Kernel, correction: Correction) -> Preparation | None:
        """The fit."""
        return LeastSquaresPreparation(kernel, self.degree)

    def weight(self, kernel: Kernel, correction: Correction, own: Any, d: Vector, r2: Scalar) -> Scalar:
        """w_ij = W_ij c . x^a."""
        x = scale(-1.0 / kernel.h, d)
        basis = tuple(monomial(x, powers) for powers in exponents(len(d), 1, self.degree))
        return kernel.value(r2, len(d)) * dot(own.prepared.coefficients, basis)
