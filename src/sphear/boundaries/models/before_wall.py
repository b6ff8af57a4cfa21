"""Velocity and pressure of fixed wall particles, from the fluid before them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector, dot, scale, subtract, where_less
from sphear.boundaries.continuations import Line, Mirror, inverse, products
from sphear.kernels import Kernel


@dataclass(frozen=True)
class VelocityBeforeWall:
    """The curve through the wall's velocity that fits the fluid before a wall particle best, under the kernel; (2 d,).

    a and b of u(y) = u_wall + a y + b y^2, y the distance from the wall along its normal. Wall particles behind the
    first layer take a and b from it, which is the nearest to the fluid (Basa, Quinlan & Lastiwka 2009, section 6.2).

    Args:
        kernel: with its smoothing length.
        curve: the line or the parabola.
    """

    kernel: Kernel
    curve: Line

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """The pair's part of the normal equations; wall particles have no part in them."""
        terms = self.curve.basis((-dot(d, own.normal) - own.depth) / self.kernel.h, 0.0)
        weight = other.fluid * other.volume * self.kernel.value(r2, len(d))
        difference = subtract(other.velocity, own.wall_velocity)
        return tuple(scale(weight * term, difference) for term in terms), scale(weight, products(terms))

    def finish(self, own: Any, total: Any) -> Vector:
        """a and b; zero where there is no fluid."""
        sums, squares = total
        found = [self.curve.coefficients(squares, right) for right in zip(*sums, strict=True)]
        a = tuple(c[0] / self.kernel.h for c in found)
        return a + tuple((c[1] if len(c) > 1 else 0.0 * c[0]) / self.kernel.h**2 for c in found)


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
        over = inverse(weight, 0.0)
        moved = tuple(
            where_less(0.0, weight, Mirror.behind(wall, over * u), wall)
            for wall, u in zip(own.wall_velocity, velocity, strict=True)
        )
        return (*moved, over * (pressure + dot(own.body_force, lever)))
