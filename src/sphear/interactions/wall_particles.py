"""Velocity and pressure of fixed wall particles, from the fluid before them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector, dot, scale, subtract, where_less
from sphear.kernels import Kernel


@dataclass(frozen=True)
class VelocityBeforeWall:
    """The fit u(y) = u_wall + a y + b y^2 to the fluid before a wall particle, weighted by the kernel; a and b, (2 d,).

    y is the distance from the wall, along its normal. A wall particle at the depth y has u_wall - a y + b y^2; those
    behind the first layer take a and b from it, which is the nearest to the fluid (Basa, Quinlan & Lastiwka 2009,
    section 6.2).

    Args:
        kernel: with its smoothing length.
        degree: 1 for the line, 2 for the parabola.
    """

    kernel: Kernel
    degree: int = 1

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """The pair's part of the normal equations; wall particles have no part in them."""
        y = -dot(d, own.normal) - own.depth
        weight = other.fluid * other.volume * self.kernel.value(r2, len(d))
        difference = subtract(other.velocity, own.wall_velocity)
        powers = [weight * y**k for k in range(1, 2 * self.degree + 1)]
        return tuple(scale(powers[k], difference) for k in range(self.degree)), tuple(powers[1:])

    def finish(self, own: Any, total: Any) -> Vector:
        """a and b; zero where there is no fluid."""
        sums, powers = total
        if self.degree == 1:
            inverse = _inverse(powers[0])
            return tuple(x * inverse for x in sums[0]) + tuple(0.0 * x for x in sums[0])
        y2, y3, y4 = powers
        determinant = y2 * y4 - y3 * y3
        # one layer of fluid makes no parabola
        inverse = where_less(1e-9 * y2 * y4, determinant, _inverse(determinant), 0.0)
        a = tuple((p * y4 - q * y3) * inverse for p, q in zip(*sums, strict=True))
        b = tuple((q * y2 - p * y3) * inverse for p, q in zip(*sums, strict=True))
        return a + b


@dataclass(frozen=True)
class FluidBeforeWall:
    """Velocity and pressure of a wall particle from the fluid around it, (d + 1,).

    u~ = sum_f u_f W / sum_f W and p = (sum_f p_f W + g . sum_f rho_f r_wf W) / sum_f W: Adami, Hu & Adams 2012, A
    generalized wall boundary condition for SPH, J. Comput. Phys. 231:7057, eqs. 22 and 27. The wall particle then
    moves with 2 u_wall - u~.
    """

    kernel: Kernel

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """The pair's part of the sums; wall particles have no part in them."""
        weight = other.fluid * self.kernel.value(r2, len(d))
        return scale(weight, other.velocity), weight * other.pressure, scale(weight * other.density, d), weight

    def finish(self, own: Any, total: Any) -> Vector:
        """2 u_wall - u~ and p; the wall's velocity and zero where there is no fluid."""
        velocity, pressure, lever, weight = total
        inverse = _inverse(weight)
        mean = scale(inverse, velocity)
        present = where_less(0.0, weight, 1.0, 0.0)
        moved = tuple((1.0 + present) * u - v for u, v in zip(own.wall_velocity, mean, strict=True))
        return (*moved, inverse * (pressure + dot(own.body_force, lever)))


def _inverse(x: Scalar) -> Scalar:
    """1 / x for positive x, else 0."""
    return where_less(0.0, x, 1.0 / where_less(0.0, x, x, 1.0), 0.0)
