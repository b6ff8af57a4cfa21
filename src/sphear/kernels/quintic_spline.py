"""The quintic B-spline."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from sphear.algebra import Scalar, positive_part
from sphear.kernels.base import Kernel


@dataclass(frozen=True)
class QuinticSpline(Kernel):
    """The quintic B-spline M6: w(q) = (3 - q)+^5 - 6 (2 - q)+^5 + 15 (1 - q)+^5, q = r / h.

    The kernel of Morris, Fox & Zhu 1997, JCP 136:214.

    Args:
        h: the smoothing length, in lengths.

    Raises:
        SphearError: h is not a positive number.

    Examples:
        >>> import sphear
        >>> kernel = sphear.QuinticSpline(h=0.1)
        >>> round(kernel.value(0.0, dimension=2), 3), round(kernel.radius, 3)
        (30.766, 0.3)
    """

    name = "quintic_spline"
    aliases = ("quintic", "m6")
    formula = "w(q) = (3 - q)+^5 - 6 (2 - q)+^5 + 15 (1 - q)+^5"
    source = "Morris, Fox & Zhu 1997, Modeling low Reynolds number incompressible flows using SPH, JCP 136:214"
    support = 3.0
    sigma = (1 / 120, 7 / (478 * pi), 1 / (120 * pi))

    def shape(self, q: Scalar, dimension: int) -> Scalar:
        """w(q)."""
        return positive_part(3.0 - q) ** 5 - 6.0 * positive_part(2.0 - q) ** 5 + 15.0 * positive_part(1.0 - q) ** 5

    def slope(self, q: Scalar, dimension: int) -> Scalar:
        """w'(q) / q."""
        outer, middle, inner = positive_part(3.0 - q), positive_part(2.0 - q), positive_part(1.0 - q)
        return (30.0 * middle**4 - 5.0 * outer**4 - 75.0 * inner**4) / q

    def curvature(self, q: Scalar, dimension: int) -> Scalar:
        """w''(q)."""
        outer, middle, inner = positive_part(3.0 - q), positive_part(2.0 - q), positive_part(1.0 - q)
        return 20.0 * outer**3 - 120.0 * middle**3 + 300.0 * inner**3
