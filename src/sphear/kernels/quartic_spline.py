"""The quartic B-spline."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from sphear.algebra import Scalar, positive_part
from sphear.kernels.base import Kernel


@dataclass(frozen=True)
class QuarticSpline(Kernel):
    """The quartic B-spline M5: w(q) = (5/2 - q)+^4 - 5 (3/2 - q)+^4 + 10 (1/2 - q)+^4, q = r / h.

    Schoenberg 1946; Price 2012, JCP 231:759.

    Args:
        h: the smoothing length, in lengths.

    Raises:
        SphearError: h is not a positive number.

    Examples:
        >>> import sphear
        >>> kernel = sphear.QuarticSpline(h=0.1)
        >>> round(kernel.value(0.0, dimension=2), 3), round(kernel.radius, 3)
        (36.636, 0.25)
    """

    name = "quartic_spline"
    aliases = ("quartic", "m5")
    formula = "w(q) = (5/2 - q)+^4 - 5 (3/2 - q)+^4 + 10 (1/2 - q)+^4"
    source = "Schoenberg 1946; Price 2012, Smoothed particle hydrodynamics and magnetohydrodynamics, JCP 231:759"
    support = 2.5
    sigma = (1 / 24, 96 / (1199 * pi), 1 / (20 * pi))

    def shape(self, q: Scalar, dimension: int) -> Scalar:
        """w(q)."""
        return positive_part(2.5 - q) ** 4 - 5.0 * positive_part(1.5 - q) ** 4 + 10.0 * positive_part(0.5 - q) ** 4

    def slope(self, q: Scalar, dimension: int) -> Scalar:
        """w'(q) / q."""
        outer, middle, inner = positive_part(2.5 - q), positive_part(1.5 - q), positive_part(0.5 - q)
        return (20.0 * middle**3 - 4.0 * outer**3 - 40.0 * inner**3) / q

    def curvature(self, q: Scalar, dimension: int) -> Scalar:
        """w''(q)."""
        outer, middle, inner = positive_part(2.5 - q), positive_part(1.5 - q), positive_part(0.5 - q)
        return 12.0 * outer**2 - 60.0 * middle**2 + 120.0 * inner**2
