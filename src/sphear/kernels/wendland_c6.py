"""The Wendland C6 kernel."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from sphear.algebra import Scalar, positive_part
from sphear.kernels.base import Kernel


@dataclass(frozen=True)
class WendlandC6(Kernel):
    """Wendland's C6 function, w(q) = (1 - q/2)+^8 (4 q^3 + 25/4 q^2 + 4 q + 1), q = r / h.

    In 1-D (1 - q/2)+^7 (21/8 q^3 + 19/4 q^2 + 7/2 q + 1). Wendland 1995; Dehnen & Aly 2012, MNRAS 425:1068.

    Args:
        h: the smoothing length, in lengths.

    Raises:
        SphearError: h is not a positive number.

    Examples:
        >>> import sphear
        >>> kernel = sphear.WendlandC6(h=0.1)
        >>> round(kernel.value(0.0, dimension=2), 3), round(kernel.radius, 3)
        (88.672, 0.2)
    """

    name = "wendland_c6"
    formula = "w(q) = (1 - q/2)+^8 (4 q^3 + 25/4 q^2 + 4 q + 1); in 1-D (1 - q/2)+^7 (21/8 q^3 + 19/4 q^2 + 7/2 q + 1)"
    source = (
        "Wendland 1995; Dehnen & Aly 2012, Improving convergence in SPH without pairing instability, MNRAS 425:1068"
    )
    support = 2.0
    sigma = (55 / 64, 39 / (14 * pi), 1365 / (512 * pi))

    def shape(self, q: Scalar, dimension: int) -> Scalar:
        """w(q)."""
        far = positive_part(1.0 - 0.5 * q)
        if dimension == 1:
            return far**7 * (2.625 * q**3 + 4.75 * q**2 + 3.5 * q + 1.0)
        return far**8 * (4.0 * q**3 + 6.25 * q**2 + 4.0 * q + 1.0)

    def slope(self, q: Scalar, dimension: int) -> Scalar:
        """w'(q) / q."""
        far = positive_part(1.0 - 0.5 * q)
        if dimension == 1:
            return -0.375 * far**6 * (35.0 * q**2 + 36.0 * q + 12.0)
        return -5.5 * far**7 * (4.0 * q**2 + 3.5 * q + 1.0)

    def curvature(self, q: Scalar, dimension: int) -> Scalar:
        """w''(q)."""
        far = positive_part(1.0 - 0.5 * q)
        if dimension == 1:
            return 0.5625 * far**5 * (105.0 * q**3 + 26.0 * q**2 - 20.0 * q - 8.0)
        return 1.375 * far**6 * (80.0 * q**3 + 15.0 * q**2 - 12.0 * q - 4.0)
