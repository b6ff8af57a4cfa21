"""The Gaussian kernel, cut at 3 h."""

from __future__ import annotations

from dataclasses import dataclass
from math import erf, pi, sqrt
from math import exp as e_to

from sphear.algebra import Scalar, exp, where_less
from sphear.kernels.base import Kernel

_CUT = 3.0
_OUTSIDE = e_to(-(_CUT**2))  # of the integral in 2-D


@dataclass(frozen=True)
class Gaussian(Kernel):
    """The Gaussian w(q) = exp(-q^2), q = r / h, cut at 3 h and scaled so that what is left integrates to one.

    Gingold & Monaghan 1977, MNRAS 181:375.

    Args:
        h: the smoothing length, in lengths.

    Raises:
        SphearError: h is not a positive number.

    Examples:
        >>> import sphear
        >>> kernel = sphear.Gaussian(h=0.1)
        >>> round(kernel.value(0.0, dimension=2), 3), round(kernel.radius, 3)
        (31.835, 0.3)
    """

    name = "gaussian"
    aliases = ("gauss",)
    formula = "w(q) = exp(-q^2) for q < 3, else 0"
    source = "Gingold & Monaghan 1977, Smoothed particle hydrodynamics, MNRAS 181:375"
    support = _CUT
    sigma = (
        1 / (sqrt(pi) * erf(_CUT)),
        1 / (pi * (1 - _OUTSIDE)),
        1 / (pi**1.5 * (erf(_CUT) - 2 * _CUT * _OUTSIDE / sqrt(pi))),
    )

    def shape(self, q: Scalar, dimension: int) -> Scalar:
        """w(q)."""
        return where_less(q, _CUT, exp(-q * q), 0.0)

    def slope(self, q: Scalar, dimension: int) -> Scalar:
        """w'(q) / q."""
        return -2.0 * self.shape(q, dimension)

    def curvature(self, q: Scalar, dimension: int) -> Scalar:
        """w''(q)."""
        return (4.0 * q * q - 2.0) * self.shape(q, dimension)
