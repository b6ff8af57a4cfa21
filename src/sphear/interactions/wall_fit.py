"""A field continued behind a wall on which its value is known."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from sphear.algebra import Scalar, Vector, dot, solve, where_less
from sphear.engine.formula import Weights
from sphear.interactions.point_fit import LEAST_SUM, symmetric
from sphear.kernels import Kernel

LEAST_PIVOT = 1e-5


class WallCoefficients(NamedTuple):
    """c of the weights V_j W_j c . b_j; zero where there is no fluid."""

    coefficients: Vector


def _basis(kernel: Kernel, terms: int, own: Any, other: Any, d: Vector) -> Vector:
    """s, s^2 and s t: all vanish on the wall. s is the distance from it, t the place along it."""
    s = other.depth / kernel.h
    t = (d[0] * own.normal[1] - d[1] * own.normal[0]) / kernel.h
    return (s, s * s, s * t)[:terms]


@dataclass(frozen=True)
class WallFit:
    """The curve through the wall's value that fits the fluid before it best, continued to a depth behind it.

    f(s, t) - f_wall = a s + b s^2 + c s t, with s the distance from the wall and t the place along it: sum_j V_j W_j
    (f_j - f_wall - ...)^2 is least. Basa, Quinlan & Lastiwka 2009, section 5 (their linear and quadratic
    extrapolation), for walls of any shape. Two dimensions.

    Args:
        kernel: W around the foot of the perpendicular to the wall.
        terms: 1 for a line, 3 for all.
    """

    kernel: Kernel
    terms: int

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """One particle's part of the normal equations, upper triangle."""
        weight = other.volume * self.kernel.value(r2, len(d))
        base = _basis(self.kernel, self.terms, own, other, d)
        return tuple(weight * base[a] * base[b] for a in range(len(base)) for b in range(a, len(base)))

    def finish(self, own: Any, total: Any) -> WallCoefficients:
        """The coefficients; a line where the particles lie too unevenly for more."""
        x = -own.depth / self.kernel.h
        squares = total[0]
        some = where_less(LEAST_SUM, squares, 1.0, 0.0)
        slope = some * x / where_less(LEAST_SUM, squares, squares, 1.0)
        if self.terms == 1:
            return WallCoefficients((slope,))
        pivot, solution = solve(symmetric(total, 3), (x, x * x, 0.0))
        line = (slope, 0.0, 0.0)
        chosen = tuple(where_less(LEAST_PIVOT * squares, pivot, a, b) for a, b in zip(solution, line, strict=True))
        return WallCoefficients(chosen)


@dataclass(frozen=True)
class WallWeights(Weights):
    """The weights V_j W_j c . b_j of a `WallFit`: f = f_wall + sum_j of them (f_j - f_wall)."""

    kernel: Kernel
    terms: int

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Vector:
        """One particle's weight."""
        base = _basis(self.kernel, self.terms, own, other, d)
        return (other.volume * self.kernel.value(r2, len(d)) * dot(own.prepared.coefficients, base),)
