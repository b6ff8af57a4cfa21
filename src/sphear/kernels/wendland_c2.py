"""The Wendland C2 kernel."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from sphear.algebra import Scalar, positive_part
from sphear.kernels.base import Kernel


@dataclass(frozen=True)
class WendlandC2(Kernel):
    """Wendland's C2 function, w(q) = (1 - q/2)+^4 (2 q + 1), q = r / h; in 1-D (1 - q/2)+^3 (3/2 q + 1).

    Its gradient needs no division, and it does not pair particles. Wendland 1995; Dehnen & Aly 2012, MNRAS 425:1068.

    Args:
        h: the smoothing length, in lengths.

    Raises:
        SphearError: h is not a positive number.

    Examples:
        >>> import sphear
        >>> kernel = sphear.WendlandC2(h=0.1)
        >>> round(kernel.value(0.0, dimension=2), 3), round(kernel.radius, 3)
        (55.704, 0.2)
    """

    name = "wendland_c2"
    aliases = ("wendland",)
    formula = "w(q) = (1 - q/2)+^4 (2 q + 1); in 1-D (1 - q/2)+^3 (3/2 q + 1)"
    source = (
        "Wendland 1995; Dehnen & Aly 2012, Improving convergence in SPH without pairing instability, MNRAS 425:1068"
    )
    support = 2.0
    sigma = (5 / 8, 7 / (4 * pi), 21 / (16 * pi))

    def shape(self, q: Scalar, dimension: int) -> Scalar:
        """w(q)."""
        far = positive_part(1.0 - 0.5 * q)
        return far**3 * (1.5 * q + 1.0) if dimension == 1 else far**4 * (2.0 * q + 1.0)

    def slope(self, q: Scalar, dimension: int) -> Scalar:
        """w'(q) / q."""
        far = positive_part(1.0 - 0.5 * q)
        return -3.0 * far**2 if dimension == 1 else -5.0 * far**3

    def curvature(self, q: Scalar, dimension: int) -> Scalar:
        """w''(q)."""
        far = positive_part(1.0 - 0.5 * q)
        return -3.0 * far * (1.0 - 1.5 * q) if dimension == 1 else -5.0 * far**2 * (1.0 - 2.0 * q)
