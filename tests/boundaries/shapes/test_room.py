"""Walls that leave room are accepted; overlaps, narrow gaps and no fluid are refused, with the place."""

from __future__ import annotations

from math import inf

import pytest

from sphear import SphearError
from sphear.boundaries.shapes import Circle, HalfPlane, Polygon, Rectangle, Shape, check_room
from sphear.neighbours.domain import Domain
from tests.boundaries.shapes.examples import ALL, CAVITY, CHANNEL, CYLINDER, SQUARE, WALLS

DX = 1 / 40
SUPPORT = 3 * DX


def check(shape: Shape, box: Domain = SQUARE, dx: float = DX) -> None:
    check_room(shape, dx, 3.5 * dx, box, 3 * dx)


@pytest.mark.parametrize("name", ALL)
def test_shapes_with_corners_of_all_kinds_are_accepted(name: str) -> None:
    check(ALL[name])


@pytest.mark.parametrize(
    "shape",
    [
        CAVITY - Circle((0.5, 0.3), 0.3 - SUPPORT - 1e-6),
        CAVITY - (Circle((0.4, 0.5), 0.15) | Circle((0.6, 0.5), 0.15)),
        CAVITY - Circle((0.3, 0.5), 0.1) - Circle((0.5 + SUPPORT, 0.5), 0.1),
        ~(~CAVITY | Circle((0.5, 0.0), 0.2)),
        Rectangle((0, 0), (1, SUPPORT)),
    ],
)
def test_wide_enough_gaps_and_joined_bodies_are_accepted(shape: Shape) -> None:
    check(shape)


@pytest.mark.parametrize(
    ("shape", "width", "place"),
    [
        (CAVITY - Circle((0.5, 0.35), 0.3), 0.05, "(0.5, 0.025)"),
        (CAVITY - Circle((0.5, 0.3), 0.3), 1.62e-5, "(0.49"),
        (CAVITY - Circle((0.5, 0.301), 0.3), 0.001, "(0.5, 0.0005)"),
        (CAVITY - Circle((0.3, 0.5), 0.1) - Circle((0.56, 0.5), 0.1), 0.06, "(0.43, 0.5)"),
        (CAVITY - Rectangle((0.3, 0.3), (0.95, 0.7)), 0.05, "(0.975"),
        (CAVITY - Polygon([(0.5, 0.06), (0.7, 0.5), (0.3, 0.5)]), 0.06, "(0.5, 0.03)"),
        (CAVITY - Rectangle((0.2, 0.2), (0.5, 0.5)) - Circle((0.6, 0.6), 0.1), 0.0414, "(0.51"),
        (Rectangle((0, 0), (1, 0.9 * SUPPORT)), 0.0675, ", 0.03375)"),
        (HalfPlane((0, 0.5), (0, 1)) & HalfPlane((0, 0.56), (0, -1)), 0.06, ", 0.53)"),
    ],
)
def test_narrow_gaps_are_refused(shape: Shape, width: float, place: str) -> None:
    with pytest.raises(SphearError, match=r"narrower than the support of the kernel, 0\.075") as caught:
        check(shape)
    assert f" is {width:.3g} wide" in str(caught.value)
    assert place in str(caught.value)


def test_gaps_across_a_period_are_refused() -> None:
    tall = Domain((0.0, -1.0), (1.0, 2.0), (True, False))
    with pytest.raises(SphearError, match=r"the walls at \(.*, 0.5\) is 0.04 wide"):
        check(Rectangle((-inf, -1), (inf, 2)) - Circle((0.5, 0.5), 0.48), tall)
    check(WALLS - Circle((0.0, 0.5), 0.4), CHANNEL)


@pytest.mark.parametrize(
    ("shape", "names"),
    [
        (CAVITY - Circle((0.9, 0.5), 0.2), ("the walls of the rectangle from", "the circle at (0.9, 0.5)")),
        (CAVITY - CYLINDER - Circle((0.7, 0.6), 0.2), ("and the circle at (0.7, 0.6)", "circle at (0.5, 0.5)")),
        (CAVITY - CYLINDER - Circle((0.5, 0.5), 0.1), ("of radius 0.25 and the circle", "of radius 0.1")),
        (CAVITY - CYLINDER - CYLINDER, ("the circle at (0.5, 0.5) of radius 0.25 and the circle",)),
        (CAVITY - Circle((3, 3), 0.1), ("rectangle", "circle at (3, 3)")),
        (CAVITY - Rectangle((0.4, -0.1), (0.6, 0.4)), ("rectangle from (0, 0)", "rectangle from (0.4, -0.1)")),
    ],
)
def test_overlaps_are_refused(shape: Shape, names: tuple[str, ...]) -> None:
    with pytest.raises(SphearError, match="shapes overlap: ") as caught:
        check(shape)
    for name in names:
        assert name in str(caught.value)


def test_overlaps_across_a_period_are_refused() -> None:
    with pytest.raises(SphearError, match="shapes overlap"):
        check(WALLS - Circle((0.1, 0.5), 0.2) - Circle((0.9, 0.5), 0.15), CHANNEL)


def test_walls_without_fluid_or_room_for_particles_are_refused() -> None:
    with pytest.raises(SphearError, match="leave no fluid"):
        check(Rectangle((2, 2), (3, 3)))
    with pytest.raises(SphearError, match=r"the circle at \(0.5, 0.5\) of radius 0.01 is too small for any wall"):
        check(CAVITY - Circle((0.5, 0.5), 0.01))
    with pytest.raises(SphearError, match="the support of the kernel is positive"):
        check_room(CAVITY, DX, DX, SQUARE, 0.0)
    with pytest.raises(SphearError, match="the spacing of particles is positive"):
        check(CAVITY, dx=-1.0)
    with pytest.raises(SphearError, match="cannot repeat"):
        check(Rectangle((0, 0), (inf, 1)), CHANNEL)


@pytest.mark.parametrize(
    ("shape", "thickness"),
    [
        (CAVITY & ~Rectangle((-1, 0.5), (2, 0.6)), "0.1"),
        (CAVITY & ~Rectangle((0.45, -1), (0.55, 0.6)), "0.1"),
        (CAVITY - Circle((0.5, 0.5), 0.06), "0.12"),
        (Rectangle((0, 0), (0.4, 1)) | Rectangle((0.5, 0), (1, 1)), "0.1"),
    ],
)
def test_solids_through_which_the_fluid_would_feel_itself_are_refused(shape: Shape, thickness: str) -> None:
    with pytest.raises(SphearError, match=f"is {thickness} thick: fluid on its two sides would feel each other"):
        check(shape)


def test_corners_of_solids_are_not_thin() -> None:
    check(CAVITY - Polygon(((0.3, 0.3), (0.75, 0.3), (0.5, 0.7))))
    check(CAVITY & ~(Circle((0.4, 0.0), 0.2) | Rectangle((0.75, -1), (2.0, 0.5))))
