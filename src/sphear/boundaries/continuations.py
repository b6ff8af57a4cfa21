"""The continuations of the velocity through a wall: what is behind it, of what was found before it.

u_w is the velocity of the wall, s the distance before it or the depth behind it. A wall model says what is found before
the wall and where: the velocity at a mirrored place, or sums over the particles near the wall. The arithmetic of all of
them is here, in plain scalars: compiled sums at the sides of a box call it, interactions trace it, whole arrays may be
given. It stands apart from both, so that wall models are made and listed without the compiler.

Basa, Quinlan & Lastiwka 2009, IJNMF 60:1127, section 6.1.2 and figure 3, compare them: docs/theory/walls.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from sphear.algebra import Scalar, Vector, where_less
from sphear.names import Registry

LEAST_SUM = 1e-9  # of sums of weights times s^2: below, there is no fluid before the wall
UNEVEN = 1e-5  # of a determinant over what it is made of: below, particles stand in one row, which makes no parabola


def inverse(x: Scalar, least: Scalar) -> Scalar:
    """1 / x for x above a positive least, else 0."""
    return where_less(least, x, 1.0 / where_less(least, x, x, 1.0), 0.0)


def products(terms: Vector) -> Vector:
    """Products of the terms at one particle, its part of the normal equations: the upper triangle row by row."""
    return tuple(x * y for k, x in enumerate(terms) for y in terms[k:])


def determinant(squares: Vector) -> Scalar:
    """The determinant of the symmetric matrix of two terms."""
    y2, y3, y4 = squares
    return y2 * y4 - y3 * y3


def solved(squares: Vector, right: Vector, over: Scalar) -> Vector:
    """The solution a, b of two normal equations, with 1 / determinant; 0 where that is 0."""
    y2, y3, y4 = squares
    p, q = right
    return ((p * y4 - q * y3) * over, (q * y2 - p * y3) * over)


@dataclass(frozen=True)
class Continuation:
    """A rule for the velocity behind a wall.

    Attributes:
        name: its name.
        aliases: other names.
        formula: of the velocity at a depth.
    """

    name: ClassVar[str] = ""
    aliases: ClassVar[tuple[str, ...]] = ()
    formula: ClassVar[str] = ""


@dataclass(frozen=True)
class Wall(Continuation):
    """No continuation: everything behind a wall moves with it."""

    name = "wall"
    formula = "u(-s) = u_w"

    @staticmethod
    def behind(wall: Scalar) -> Scalar:
        """The velocity at any depth."""
        return wall


@dataclass(frozen=True)
class Mirror(Continuation):
    """The reflection about the wall's velocity, of that at the mirrored place.

    Across a wall it is the condition that nothing flows through it, whatever is continued along it.
    """

    name = "mirror"
    aliases = ("mirroring",)
    formula = "u(-s) = 2 u_w - u(s)"

    @staticmethod
    def behind(wall: Scalar, before: Scalar) -> Scalar:
        """The velocity at a depth, from that at the mirrored place."""
        return 2.0 * wall - before


@dataclass(frozen=True)
class Shearless(Continuation):
    """The velocity along a wall that fluid slips along, so that no shear stress acts on it.

    Along a straight wall it is that at the mirrored place; along a circle it grows with the distance from its centre,
    as where fluid turns with it.
    """

    name = "shearless"
    formula = "u(-s) = u(s) (1 + k s) / (1 - k s), k the curvature of the wall, positive around fluid"

    @staticmethod
    def behind(before: Scalar, bent: Scalar) -> Scalar:
        """The velocity at a depth, from that at the mirrored place and k s."""
        return before * (1.0 + bent) / (1.0 - bent)


@dataclass(frozen=True)
class Line(Continuation):
    """The line through the wall's velocity that fits the fluid before the wall best.

    sum_j w_j (u_j - u_w - a s_j)^2 is least. A fit has a basis, which vanishes on the wall, the normal equations of it,
    and the curve that the coefficients make.
    """

    name = "linear"
    formula = "u(-s) = u_w - a s, a = sum w s (u - u_w) / sum w s^2"

    @staticmethod
    def basis(s: Scalar, along: Scalar) -> Vector:
        """The terms at the distance s from the wall, and at a place along it."""
        return (s,)

    @staticmethod
    def coefficients(squares: Vector, right: Vector) -> Vector:
        """The solution of the normal equations; zero where there is no fluid.

        Args:
            squares: sums of the products of terms, the upper triangle row by row.
            right: sums of the terms times u - u_w; or the terms at a place behind the wall, whose solution, by
                symmetry, says how much each term of a particle counts for the value there.
        """
        return (right[0] * inverse(squares[0], LEAST_SUM),)

    @staticmethod
    def behind(wall: Scalar, coefficients: Vector, depth: Scalar) -> Scalar:
        """The velocity at a depth."""
        return wall - coefficients[0] * depth


@dataclass(frozen=True)
class Parabola(Line):
    """The parabola through the wall's velocity that fits the fluid before it best; a line through a single row."""

    name = "quadratic"
    formula = "u(-s) = u_w - a s + b s^2"

    @staticmethod
    def basis(s: Scalar, along: Scalar) -> Vector:
        """Terms: s and s^2."""
        return (s, s * s)

    @staticmethod
    def coefficients(squares: Vector, right: Vector) -> Vector:
        """The solution of the normal equations, a and b; that of the line, and 0, where they are all but singular."""
        over = inverse(determinant(squares), UNEVEN * squares[0] * squares[2])
        a, b = solved(squares, right, over)
        return (where_less(0.0, over, a, right[0] * inverse(squares[0], LEAST_SUM)), b)

    @staticmethod
    def behind(wall: Scalar, coefficients: Vector, depth: Scalar) -> Scalar:
        """The velocity at a depth."""
        return wall - coefficients[0] * depth + coefficients[1] * depth * depth


@dataclass(frozen=True)
class LeaningParabola(Parabola):
    """A parabola whose slope varies along the wall, for sums around one place on a wall of any shape; two dimensions.

    With the third term eliminated its equations are those of the parabola.
    """

    formula = "u(-s) = u_w - a s + b s^2, by a fit of a s + b s^2 + c s t with t the place along the wall"

    @staticmethod
    def basis(s: Scalar, along: Scalar) -> Vector:
        """Terms: s, s^2 and s t."""
        return (s, s * s, s * along)

    @staticmethod
    def coefficients(squares: Vector, right: Vector) -> Vector:
        """The solution, a, b and c; without c where all stand in line with the place, a line where they are one row."""
        s2, s3, lean, s4, bent, st2 = squares
        p, q, r = right
        of_last = inverse(st2, UNEVEN * s2)
        d, e = lean * of_last, bent * of_last
        reduced = (s2 - lean * d, s3 - bent * d, s4 - bent * e)
        over = inverse(determinant(reduced), UNEVEN * s2 * s4)
        a, b = solved(reduced, (p - r * d, q - r * e), over)
        c = where_less(0.0, over, (r - lean * a - bent * b) * of_last, 0.0)
        return (where_less(0.0, over, a, p * inverse(s2, LEAST_SUM)), b, c)


@dataclass(frozen=True)
class GlobalParabola(Continuation):
    """The parabola through the velocities of two walls that fits all fluid between them best (Watkins et al. 1996).

    With s from one wall to the other, 0 to 1, it is the line between the walls' velocities and c s (1 - s), sum_j w_j
    (u_j - line - c s_j (1 - s_j))^2 least: a line's fit to another shape.
    """

    name = "global_quadratic"
    aliases = ("global",)
    formula = "u(s) = u_0 + (u_1 - u_0) s + c s (1 - s)"

    @staticmethod
    def shape(s: Scalar) -> Scalar:
        """The term that vanishes on both walls, s (1 - s)."""
        return s * (1.0 - s)

    @staticmethod
    def excess(velocity: Scalar, wall: Scalar, other: Scalar, s: Scalar) -> Scalar:
        """The velocity over the line between the walls'."""
        return velocity - wall - (other - wall) * s

    @staticmethod
    def coefficients(wall: Scalar, other: Scalar, c: Scalar) -> Vector:
        """The slope and bend of the parabola at a wall, as `Parabola` has them; the other wall is at s = 1."""
        return (other - wall + c, -c)


CONTINUATIONS: Registry[Continuation] = Registry("continuation")
for _rule in (Mirror(), Line(), Parabola(), GlobalParabola()):
    CONTINUATIONS.add(_rule.name, _rule, _rule.aliases)
