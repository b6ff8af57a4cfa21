"""The arithmetic of continuations through walls: on plain numbers, and the same when traced and compiled."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sphear.algebra import where_less
from sphear.boundaries import CONTINUATIONS
from sphear.boundaries.continuations import (
    GlobalParabola,
    LeaningParabola,
    Line,
    Mirror,
    Parabola,
    Shearless,
    Wall,
    products,
)
from sphear.boundaries.side_fits import linear, quadratic
from sphear.engine.point_formula import traced_point

Array = np.ndarray[Any, Any]
SMALL = st.floats(-3.0, 3.0)
CURVES = (Line(), Parabola(), LeaningParabola())


def fitted(curve: Line, s: Array, along: Array, change: Array, weight: Array) -> tuple[float, ...]:
    """The coefficients of a curve, from sums over particles."""
    terms = [curve.basis(*place) for place in zip(s, along, strict=True)]
    squares = tuple(np.sum([w * np.array(products(each)) for w, each in zip(weight, terms, strict=True)], axis=0))
    right = tuple(np.sum([w * u * np.array(each) for w, u, each in zip(weight, change, terms, strict=True)], axis=0))
    return tuple(float(c) for c in curve.coefficients(squares, right))


def particles(seed: int) -> tuple[Array, Array, Array]:
    """Distances, places along the wall and weights."""
    generator = np.random.default_rng(seed)
    return generator.uniform(0.1, 2.0, 12), generator.uniform(-1.0, 1.0, 12), generator.uniform(0.2, 1.0, 12)


@pytest.mark.parametrize("curve", CURVES)
@given(seed=st.integers(0, 99), known=st.tuples(SMALL, SMALL, SMALL), wall=SMALL)
def test_a_curve_is_found_and_goes_on(curve: Line, seed: int, known: tuple[float, ...], wall: float) -> None:
    s, along, weight = particles(seed)
    number = len(curve.basis(0.5, 0.5))
    change = sum(c * term for c, term in zip(known[:number], curve.basis(s, along), strict=True))
    found = fitted(curve, s, along, np.asarray(change), weight)
    np.testing.assert_allclose(found, known[:number], atol=1e-8)
    bend = known[1] if number > 1 else 0.0
    np.testing.assert_allclose(curve.behind(wall, found, 0.7), wall - known[0] * 0.7 + bend * 0.49, atol=1e-8)


@pytest.mark.parametrize("curve", CURVES)
def test_the_fit_is_that_of_least_squares(curve: Line) -> None:
    s, along, weight = particles(3)
    change = np.random.default_rng(4).normal(size=len(s))
    root = np.sqrt(weight)
    terms = np.array([curve.basis(*place) for place in zip(s, along, strict=True)])
    expected = np.linalg.lstsq(root[:, None] * terms, root * change, rcond=None)[0]
    np.testing.assert_allclose(fitted(curve, s, along, change, weight), expected, rtol=1e-9)


@pytest.mark.parametrize("curve", CURVES)
def test_a_single_row_makes_a_line(curve: Line) -> None:
    """Equally far from the wall, and mirrored along it: the mean over the distance."""
    s, along = np.full(4, 0.5), np.array([-0.6, -0.2, 0.2, 0.6])
    found = fitted(curve, s, along, np.array([1.0, 3.0, 3.0, 1.0]), np.ones(4))
    np.testing.assert_allclose(found, (4.0, 0.0, 0.0)[: len(found)], atol=1e-12)


@pytest.mark.parametrize("curve", CURVES)
def test_without_fluid_nothing_is_continued(curve: Line) -> None:
    number = len(curve.basis(0.5, 0.5))
    squares = (0.0,) * (number * (number + 1) // 2)
    assert curve.coefficients(squares, (0.0,) * number) == (0.0,) * number


def test_what_needs_no_fit() -> None:
    assert Wall.behind(0.3) == 0.3
    assert Mirror.behind(1.0, 0.25) == 1.75
    assert Shearless.behind(0.5, 0.0) == 0.5
    radius, depth = 2.0, 0.1  # rigid rotation inside a circle: the velocity is that of the radius
    np.testing.assert_allclose(Shearless.behind(radius - depth, depth / radius), radius + depth, rtol=1e-12)


@given(c=SMALL, wall=SMALL, other=SMALL, s=st.floats(0.05, 0.95))
def test_the_parabola_between_two_walls_is_the_one_at_each(c: float, wall: float, other: float, s: float) -> None:
    def exact(y: float) -> float:
        return wall + (other - wall) * y + c * y * (1.0 - y)

    excess = GlobalParabola.excess(exact(s), wall, other, s)
    np.testing.assert_allclose(excess / GlobalParabola.shape(s), c, atol=1e-9)
    at_wall, at_other = GlobalParabola.coefficients(wall, other, c), GlobalParabola.coefficients(other, wall, c)
    np.testing.assert_allclose(Parabola.behind(wall, at_wall, 0.3), exact(-0.3), atol=1e-9)
    np.testing.assert_allclose(Parabola.behind(other, at_other, 0.3), exact(1.3), atol=1e-9)


@dataclass(frozen=True)
class Fit:
    """The parabola as a formula of a particle."""

    def at(self, own: Any) -> dict[str, Any]:
        return {"found": Parabola.coefficients(own.squares, own.right)}


@pytest.mark.parametrize(
    ("squares", "right"),
    [((2.0, 0.3, 1.5), (0.7, -0.2)), ((1.0, 1.0, 1.0), (0.5, 0.5)), ((0.0,) * 3, (0.0,) * 2)],
)
def test_the_traced_parabola_is_the_plain_one(squares: tuple[float, ...], right: tuple[float, ...]) -> None:
    traced = traced_point(Fit(), (("squares", squares), ("right", right)))
    known = {f"squares_{k}": x for k, x in enumerate(squares)} | {f"right_{k}": x for k, x in enumerate(right)}
    scope: dict[str, Any] = {"where_less": where_less, **known}
    exec("\n".join(traced.lines), scope)
    found = [eval(value, scope) for _, _, value in traced.writes]
    np.testing.assert_allclose(found, Parabola.coefficients(squares, right), rtol=1e-14)


@pytest.mark.parametrize(("rule", "curve"), [(linear, Line()), (quadratic, Parabola())])
def test_the_sides_of_a_box_have_the_same_arithmetic(rule: Any, curve: Line) -> None:
    """Compiled sums with equal weights give what the plain fit gives."""
    spacing, generator = 0.1, np.random.default_rng(5)
    x = np.stack((np.full(8, 0.5), generator.uniform(0.01, 0.09, 8)), axis=1)
    v = generator.normal(size=(8, 2))
    a, b = np.zeros((1, 2, 2)), np.zeros((1, 2, 2))
    rule(x, v, np.zeros(2), np.ones(2), 1, -1, np.array([[0.4, 0.0], [0.0, 0.0]]), spacing, a, b)
    expected = fitted(curve, x[:, 1] / spacing, np.zeros(8), v[:, 0] - 0.4, np.ones(8))
    np.testing.assert_allclose(a[0, 0, 0], expected[0] / spacing, rtol=1e-9)
    if curve == Parabola():
        np.testing.assert_allclose(b[0, 0, 0], expected[1] / spacing**2, rtol=1e-9)


def test_names() -> None:
    assert [CONTINUATIONS.name(name) for name in ("mirroring", "global")] == ["mirror", "global_quadratic"]
    assert CONTINUATIONS["quadratic"] == Parabola()
