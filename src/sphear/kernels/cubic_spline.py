"""The cubic B-spline."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from sphear.algebra import Scalar, positive_part
from sphear.kernels.base import Kernel


@dataclass(frozen=True)
class CubicSpline(Kernel):
    """The cubic B-spline M4, the kernel of both reproduced papers: w(q) = (2 - q)+^3 / 4 - (1 - q)+^3, q = r / h.

    Monaghan & Lattanzio 1985, A&A 149:135.

    Args:
        h: the smoothing length, in lengths.

    Raises:
        SphearError: h is not a positive number.

    Examples:
        >>> import sphear
        >>> kernel = sphear.CubicSpline(h=0.1)
        >>> round(kernel.value(0.0, dimension=2), 3), round(kernel.radius, 3)
        (45.473, 0.2)
    """

    name = "cubic_spline"
    aliases = ("cubic", "m4", "b_spline")
    formula = "w(q) = (2 - q)+^3 / 4 - (1 - q)+^3"
    source = "Monaghan & Lattanzio 1985, A refined particle method for astrophysical problems, A&A 149:135"
    support = 2.0
    sigma = (2 / 3, 10 / (7 * pi), 1 / pi)

    def shape(self, q: Scalar, dimension: int) -> Scalar:
        """w(q)."""
        return 0.25 * positive_part(2.0 - q) ** 3 - positive_part(1.0 - q) ** 3

    def slope(self, q: Scalar, dimension: int) -> Scalar:
        """w'(q) / q."""
        return (3.0 * positive_part(1.0 - q) ** 2 - 0.75 * positive_part(2.0 - q) ** 2) / q

    def curvature(self, q: Scalar, dimension: int) -> Scalar:
        """w''(q)."""
        return 1.5 * positive_part(2.0 - q) - 6.0 * positive_part(1.0 - q)
