"""A field continued behind a wall on which its value is known, as weights of the fluid before it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from sphear.algebra import Scalar, Vector, dot, scale
from sphear.boundaries.continuations import Line, products
from sphear.engine.formula import Weights
from sphear.kernels import Kernel


class WallCoefficients(NamedTuple):
    """c of the weights V_j W_j c . b_j; zero where there is no fluid."""

    coefficients: Vector


def _terms(curve: Line, kernel: Kernel, own: Any, other: Any, d: Vector) -> Vector:
    """The terms of a curve at a neighbour, whose distance from the wall is known, in smoothing lengths."""
    along = d[0] * own.normal[1] - d[1] * own.normal[0]
    return curve.basis(other.depth / kernel.h, along / kernel.h)


@dataclass(frozen=True)
class WallFit:
    """The curve through the wall's value that fits the fluid before it best, continued to a depth behind it.

    sum_j V_j W_j (f_j - f_wall - c . b_j)^2 is least, with b_j the terms of the curve at a particle, for walls of any
    shape. Two dimensions.

    Args:
        kernel: W around the foot of the perpendicular to the wall.
        curve: the line or the parabola.
    """

    kernel: Kernel
    curve: Line

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """One particle's part of the normal equations, upper triangle."""
        terms = _terms(self.curve, self.kernel, own, other, d)
        weight = other.volume * self.kernel.value(r2, len(d))
        return scale(weight, products(terms))

    def finish(self, own: Any, total: Any) -> WallCoefficients:
        """The coefficients; a line where the particles lie too unevenly for more."""
        there = self.curve.basis(-own.depth / self.kernel.h, 0.0)
        return WallCoefficients(self.curve.coefficients(total, there))


@dataclass(frozen=True)
class WallWeights(Weights):
    """The weights V_j W_j c . b_j of a `WallFit`: f = f_wall + sum_j of them (f_j - f_wall)."""

    kernel: Kernel
    curve: Line

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Vector:
        """One particle's weight."""
        terms = _terms(self.curve, self.kernel, own, other, d)
        return (other.volume * self.kernel.value(r2, len(d)) * dot(own.prepared.coefficients, terms),)
