"""The Wendland C4 kernel."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from sphear.algebra import Scalar, positive_part
from sphear.kernels.base import Kernel


@dataclass(frozen=True)
class WendlandC4(Kernel):
    """Wendland's C4 function, w(q) = (1 - q/2)+^6 (35/12 q^2 + 3 q + 1), q = r / h.

    In 1-D (1 - q/2)+^5 (2 q^2 + 5/2 q + 1). Wendland 1995; Dehnen & Aly 2012, MNRAS 425:1068.

    Args:
        h: the smoothing length, in lengths.

    Raises:
        SphearError: h is not a positive number.

    Examples:
        >>> import sphear
        >>> kernel = sphear.WendlandC4(h=0.1)
        >>> round(kernel.value(0.0, dimension=2), 3), round(kernel.radius, 3)
        (71.62, 0.2)
    """

    name = "wendland_c4"
    formula = "w(q) = (1 - q/2)+^6 (35/12 q^2 + 3 q + 1); in 1-D (1 - q/2)+^5 (2 q^2 + 5/2 q + 1)"
    source = (
        "Wendland 1995; Dehnen & Aly 2012, Improving convergence in SPH without pairing instability, MNRAS 425:1068"
    )
    support = 2.0
    sigma = (3 / 4, 9 / (4 * pi), 495 / (256 * pi))

    def shape(self, q: Scalar, dimension: int) -> Scalar:
        """w(q)."""
        far = positive_part(1.0 - 0.5 * q)
        if dimension == 1:
            return far**5 * (2.0 * q**2 + 2.5 * q + 1.0)
        return far**6 * (35.0 / 12.0 * q**2 + 3.0 * q + 1.0)

    def slope(self, q: Scalar, dimension: int) -> Scalar:
        """w'(q) / q."""
        far = positive_part(1.0 - 0.5 * q)
        return -3.5 * far**4 * (2.0 * q + 1.0) if dimension == 1 else -14.0 / 3.0 * far**5 * (2.5 * q + 1.0)

    def curvature(self, q: Scalar, dimension: int) -> Scalar:
        """w''(q)."""
        far = positive_part(1.0 - 0.5 * q)
        if dimension == 1:
            return -3.5 * far**3 * (1.0 + 1.5 * q - 6.0 * q**2)
        return -14.0 / 3.0 * far**4 * (1.0 + 2.0 * q - 8.75 * q**2)
