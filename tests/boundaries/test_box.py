"""Images of particles beyond periodic sides and walls, against all shifts and reflections by brute force."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
import pytest

from sphear import SphearError
from sphear.boundaries import Box
from sphear.boundaries.box import with_images

Array = np.ndarray[Any, Any]
Image = tuple[Any, ...]
ON_WALL = 64


def images(box: Box, x: Array, reach: float, on_wall: float = 0.0) -> list[Image]:
    """(source, wall, *place) of the images that `with_images` makes, sorted."""
    lower, upper, kinds, _ = box.arrays()
    positions, source, wall = with_images(x, lower, upper, kinds, reach, on_wall)
    np.testing.assert_array_equal(source[: len(x)], np.arange(len(x)))
    assert not wall[: len(x)].any()
    return rounded(zip(source, wall, *positions.T, strict=True))


def brute_force(box: Box, x: Array, reach: float, on_wall: float = 0.0) -> list[Image]:
    """Every combination, axis by axis, of staying, being shifted, being reflected at a wall or being put on it."""
    found = []
    for i, place in enumerate(x):
        along: list[list[tuple[float, int]]] = []  # place and bits of the wall
        for axis, (at, low, high, side) in enumerate(zip(place, box.lower, box.upper, box.sides, strict=True)):
            period = high - low
            if side == "periodic":
                inside = low + (at - low) % period
                many = range(-2 - int(reach / period), 3 + int(reach / period))
                shifted = [(inside + n * period, n) for n in many]
                kept = [(p, 0) for p, n in shifted if n == 0 or 0 <= (p - high if n > 0 else low - p) < reach]
            else:
                kept = [(at, 0)]
                for number, (wall, depth) in enumerate(((low, at - low), (high, high - at))):
                    bit = 1 << (2 * axis + number)
                    kept += [(2 * wall - at, bit)] if depth < reach else []
                    kept += [(wall, bit | ON_WALL)] if abs(depth) < min(on_wall, reach) else []
            along.append(kept)
        for choice in product(*along):
            found.append((i, int(np.bitwise_or.reduce([bits for _, bits in choice])), *(p for p, _ in choice)))
    return rounded(found)


def rounded(found: Any) -> list[Image]:
    return sorted(tuple(round(float(number), 9) + 0.0 for number in image) for image in found)


SIDES = list(product(("periodic", "walls"), repeat=2))


@pytest.mark.parametrize("sides", SIDES)
@pytest.mark.parametrize("on_wall", [0.0, 0.2])
@pytest.mark.parametrize("reach", [0.31, 0.97, 2.3])
def test_images_are_those_of_brute_force(sides: Any, reach: float, on_wall: float) -> None:
    box = Box((-0.5, 0.2), (0.5, 0.9), sides)
    x = np.array(box.lower) + np.random.default_rng(0).random((23, 2)) * np.subtract(box.upper, box.lower)
    assert images(box, x, reach, on_wall) == brute_force(box, x, reach, on_wall)


@pytest.mark.parametrize("sides", SIDES)
def test_particles_outside_come_back_over_periodic_sides_only(sides: Any) -> None:
    box = Box((0.0, 0.0), (1.0, 2.0), sides)
    x = np.array([[0.1, 0.2], [0.9, 1.7]])
    for axis, side in enumerate(sides):
        if side == "periodic":
            x[0, axis] -= 3 * box.upper[axis]
            x[1, axis] += 5 * box.upper[axis]
    assert images(box, x, 0.4) == brute_force(box, x, 0.4)
    assert (0.0, 0.0, 0.1, 0.2) in images(box, x, 0.4)


@pytest.mark.parametrize("sides", SIDES)
def test_a_particle_on_a_side_has_its_images(sides: Any) -> None:
    box = Box((0.0, 0.0), (1.0, 1.0), sides)
    x = np.array([[0.0, 0.0], [1.0, 0.5], [0.5, 1.0], [0.0, 0.25]])
    assert images(box, x, 0.3) == brute_force(box, x, 0.3)


def test_a_particle_on_its_way_through_a_mirror_has_its_image_before_it() -> None:
    box = Box((0.0, 0.0), (1.0, 1.0), ("periodic", "walls"))
    found = images(box, np.array([[0.5, -0.05], [0.5, 1.02]]), 0.3, 0.1)
    assert found == rounded([
        (0, 0, 0.5, -0.05), (0, 4, 0.5, 0.05), (0, 4 | 64, 0.5, 0.0),
        (1, 0, 0.5, 1.02), (1, 8, 0.5, 0.98), (1, 8 | 64, 0.5, 1.0),
    ])  # fmt: skip


def test_a_corner_mirrors_at_both_walls_and_at_each() -> None:
    box = Box((0.0, 0.0), (1.0, 1.0), ("walls", "walls"))
    found = images(box, np.array([[0.1, 0.8]]), 0.3)
    assert found == rounded([(0, 0, 0.1, 0.8), (0, 1, -0.1, 0.8), (0, 8, 0.1, 1.2), (0, 1 | 8, -0.1, 1.2)])


def test_there_is_nothing_beyond_open_sides() -> None:
    lower, upper, kinds, _ = Box((0.0, 0.0), (1.0, 1.0), ("walls", "walls")).arrays(mirrored=False)
    positions, source, wall = with_images(np.array([[0.1, 0.8]]), lower, upper, kinds, 0.3, 0.3)
    assert (positions.tolist(), source.tolist(), wall.tolist()) == ([[0.1, 0.8]], [0], [0])


def test_a_particle_just_below_a_periodic_side_stays_within_rounding_of_it() -> None:
    box = Box((0.0, 0.0), (1.0, 1.0), ("periodic", "periodic"))
    places = {image[2:] for image in images(box, np.array([[-1e-20, 0.5]]), 0.3)}
    assert places == {(0.0, 0.5), (1.0, 0.5)}


@pytest.mark.parametrize("sides", [("periodic", "walls", "periodic"), ("walls", "walls", "walls")])
def test_three_dimensions(sides: Any) -> None:
    box = Box((0.0, 0.0, 0.0), (1.0, 1.5, 0.5), sides)
    x = np.random.default_rng(1).random((9, 3)) * box.upper
    assert images(box, x, 0.6, 0.2) == brute_force(box, x, 0.6, 0.2)
    np.testing.assert_array_equal(box.arrays()[3], np.zeros((3, 2, 4)))  # velocities, and whether fluid slips


def test_room_for_images_grows_with_their_number() -> None:
    """More particles than any first guess, with a reach of several periods: 25 places for each."""
    box = Box((0.0, 0.0), (1.0, 1.0), ("periodic", "periodic"))
    x = np.random.default_rng(2).random((6000, 2))
    lower, upper, kinds, _ = box.arrays()
    positions, source, _ = with_images(x, lower, upper, kinds, 2.0 + 1e-9, 0.0)
    inside = ((positions > -2) & (positions < 3)).all(axis=1)
    np.testing.assert_array_equal(np.bincount(source[inside], minlength=len(x)), 25)
    np.testing.assert_allclose((positions - x[source]) % 1.0 % (1.0 - 1e-9), 0.0, atol=2e-9)


def test_velocities_belong_to_the_last_walls() -> None:
    channel = Box((0.0, 0.0), (1.0, 1.0), ("periodic", "walls"), upper_velocity=(2.0, 0.0))
    assert channel.wall_axes == (1,)
    np.testing.assert_array_equal(channel.arrays()[3], [np.zeros((2, 3)), [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]])
    cavity = Box((0.0, 0.0), (1.0, 1.0), ("walls", "walls"), (-1.0, 0.0), (2.0, 0.0))
    assert cavity.wall_axes == (0, 1)
    np.testing.assert_array_equal(cavity.arrays()[3], [np.zeros((2, 3)), [[-1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]])


def test_no_walls() -> None:
    assert Box((0.0, 0.0), (1.0, 1.0), ("periodic", "periodic")).wall_axes == ()


WRONG: dict[str, tuple[tuple[Any, ...], str]] = {
    "upside down": (((0.0, 1.0), (1.0, 0.0), ("periodic", "walls")), "beyond the lower one"),
    "flat": (((0.0, 0.0), (1.0, 0.0), ("periodic", "walls")), "beyond the lower one"),
    "infinite": (((0.0, 0.0), (1.0, np.inf), ("periodic", "walls")), "beyond the lower one"),
    "not a number": (((0.0, np.nan), (1.0, 1.0), ("periodic", "walls")), "has one to three numbers, one an axis"),
    "unknown side": (((0.0, 0.0), (1.0, 1.0), ("periodic", "wall")), "not 'wall'"),
    "a side too few": (((0.0, 0.0), (1.0, 1.0), ("periodic",)), "as many corner coordinates as sides"),
    "no corner": (("ab", (1.0, 1.0), ("periodic", "walls")), "the lower corner of a box has one to three numbers"),
    "tiny": (((0.0, 0.0), (1.0, 1e-100), ("periodic", "walls")), "from 1e-50 to 1e\\+50 long"),
    "one word": (((0.0, 0.0), (1.0, 1.0), "walls"), "given one an axis"),
    "lid through itself": (
        ((0.0, 0.0), (1.0, 1.0), ("walls", "walls"), (), (0.0, 1.0)),
        "upper wall of a box, across the axis y, would move through itself",
    ),
    "side through itself": (
        ((0.0, 0.0), (1.0, 1.0), ("walls", "periodic"), (0.5, 0.0)),
        "lower wall of a box, across the axis x, would move through itself",
    ),
    "lid of a solid box through itself": (
        ((0.0,) * 3, (1.0,) * 3, ("walls", "periodic", "walls"), (), (1.0, 0.0, 1e-9)),
        "across the axis z, would move through itself",
    ),
    "line through itself": (((0.0,), (1.0,), ("walls",), (1.0,)), "across the axis x, would move through itself"),
    "wall velocity without walls": (
        ((0.0, 0.0), (1.0, 1.0), ("periodic", "periodic"), (), (1.0, 0.0)),
        "this box has none",
    ),
    "velocity that is none": (((0.0, 0.0), (1.0, 1.0), ("periodic", "walls"), (), (1.0, np.nan)), "2 finite numbers"),
    "velocity of another dimension": (((0.0,), (1.0,), ("walls",), (1.0, 0.0)), "1 components, not 2"),
}


@pytest.mark.parametrize("case", WRONG)
def test_a_box_that_is_none_is_refused(case: str) -> None:
    arguments, message = WRONG[case]
    with pytest.raises(SphearError, match=message):
        Box(*arguments)


def test_walls_that_fluid_slips_along_are_told_behind_their_velocities() -> None:
    box = Box((0.0, 0.0), (1.0, 1.0), ("walls", "walls"), free_slip=((0, 1), (1, 0)))
    np.testing.assert_array_equal(box.arrays()[3][..., 2], [[0.0, 1.0], [1.0, 0.0]])
