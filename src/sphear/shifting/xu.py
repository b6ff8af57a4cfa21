"""Away from neighbours that are nearer than others (Xu, Stansby & Laurence 2009)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector, dot, scale, sqrt, where_less
from sphear.interactions import Part
from sphear.kernels import Kernel
from sphear.shifting.base import ShiftingMethod, check_strength

SOURCE_STRENGTH = 0.04  # C of the source, which takes 0.01 to 0.1


@dataclass(frozen=True)
class XuDrift(Part):
    """The drift C U R_i, R_i = sum_j (rbar_i / r_ij)^2 r_ij / r_ij, rbar_i the mean of the r_ij; at most U / 2.

    Eqs. 31 to 34 of the source, over the time step.

    Args:
        kernel: its support is where neighbours are counted.
        strength: C.
        speed: U, the largest expected.
    """

    kernel: Kernel
    strength: float
    speed: float

    role = "drift"

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """The pair's part of R and of the mean distance."""
        # a particle without volume, on a wall, counts for nothing
        near = where_less(r2, self.kernel.radius**2, other.volume / own.volume, 0.0)
        r = sqrt(r2)
        return tuple(0.0 for _ in d), (scale(near / (r2 * r), d), near * r, near)

    def finish(self, own: Any, sums: Any) -> Vector:
        """The drift, limited."""
        direction, distances, number = sums
        mean = distances / where_less(0.5, number, number, 1.0)
        wanted = scale(self.strength * self.speed * mean * mean, direction)
        size, most = sqrt(dot(wanted, wanted)), 0.5 * self.speed
        return scale(where_less(most, size, most / where_less(most, size, size, 1.0), 1.0), wanted)


@dataclass(frozen=True)
class Xu(ShiftingMethod):
    """The drift w_i = 0.04 a U sum_j (rbar_i / r_ij)^2 r_ij / |r_ij|, rbar_i the mean distance of neighbours.

    Args:
        strength: a, 1 for the factor 0.04 of the source.

    Raises:
        SphearError: the strength is not a positive number.

    Examples:
        >>> import sphear
        >>> print(sphear.Incompressible(shifting=sphear.Xu(strength=1.0)))
        Incompressible(shifting='xu', shifting_strength=1.0)
    """

    strength: float = 0.5

    name = "xu"
    aliases = ("stansby",)
    formula = "w_i = 0.04 a U sum_j (rbar_i / r_ij)^2 r_ij / |r_ij|, |w_i| <= U / 2"
    source = "Xu, Stansby & Laurence 2009, J. Comput. Phys. 228:6703, eqs. 31 to 34"

    def __post_init__(self) -> None:
        check_strength(self.strength)

    def drift(self, kernel: Kernel, speed: float, spacing: float) -> Part:
        """The drift, in length over time."""
        return XuDrift(kernel, SOURCE_STRENGTH * self.strength, speed)
