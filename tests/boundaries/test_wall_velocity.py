"""Velocities behind walls: what each rule continues exactly, and which image has which."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from sphear.boundaries import Box, side_fits
from sphear.boundaries.box import with_images
from sphear.boundaries.mirror import mirror_velocities, wall_nodes

Array = np.ndarray[Any, Any]
SPACING = 0.1
DEPTHS = np.array([0.01, 0.1, 0.3])


def places(axis: int) -> Array:
    """Disordered particles between walls at -0.3 and 0.7 along one axis."""
    x = np.random.default_rng(0).random((200, 2))
    x[:, axis] -= 0.3
    return x


def continued(rule: str, profile: Callable[[Array], Array], axis: int = 1, **walls: Any) -> Array:
    """The tangential velocity at depths behind the lower and the upper wall, (2, depths)."""
    sides: tuple[Any, ...] = ("periodic", "walls") if axis else ("walls", "periodic")
    lower_corner = tuple(-0.3 if k == axis else 0.0 for k in range(2))
    upper_corner = tuple(0.7 if k == axis else 1.0 for k in range(2))
    box = Box(lower_corner, upper_corner, sides, **walls)
    lower, upper, _, velocities = box.arrays()
    x = places(axis)
    v = np.zeros_like(x)
    v[:, 1 - axis] = profile(x[:, axis])
    a, b = np.zeros((1, 2, 2)), np.zeros((1, 2, 2))
    getattr(side_fits, rule)(x, v, lower, upper, axis, -1, velocities[axis], SPACING, a, b)
    along = 1 - axis
    continued: Array = velocities[axis][:, [along]] - a[0, :, [along]].T * DEPTHS + b[0, :, [along]].T * DEPTHS**2
    return continued


def expected(profile: Callable[[Array], Array]) -> Array:
    return np.stack((profile(-0.3 - DEPTHS), profile(0.7 + DEPTHS)))


def shear(y: Array) -> Array:
    return 3.0 * y + 0.5


def poiseuille(y: Array) -> Array:
    return (y + 0.3) * (0.7 - y)


def walls(profile: Callable[[Array], Array], axis: int = 1) -> dict[str, Any]:
    """The walls' velocities of a profile."""
    ends = profile(np.array([-0.3, 0.7]))
    return {
        name: (float(end), 0.0) if axis else (0.0, float(end))
        for name, end in zip(("lower_velocity", "upper_velocity"), ends, strict=True)
    }


@pytest.mark.parametrize("rule", ["linear", "quadratic", "global_quadratic"])
@pytest.mark.parametrize("axis", [0, 1])
def test_linear_shear_between_moving_walls_goes_on(rule: str, axis: int) -> None:
    found = continued(rule, shear, axis, **walls(shear, axis))
    np.testing.assert_allclose(found, expected(shear), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("rule", ["quadratic", "global_quadratic"])
def test_a_parabola_between_walls_at_rest_goes_on(rule: str) -> None:
    np.testing.assert_allclose(continued(rule, poiseuille), expected(poiseuille), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("rule", ["quadratic", "global_quadratic"])
def test_a_parabola_between_moving_walls_goes_on(rule: str) -> None:
    def profile(y: Array) -> Array:
        return np.asarray(2.0 - shear(y) + 4.0 * poiseuille(y))

    np.testing.assert_allclose(continued(rule, profile, **walls(profile)), expected(profile), rtol=1e-9, atol=1e-9)


def test_quadratic_sees_each_wall_alone() -> None:
    """Other parabolas within three spacings of each wall, and anything between them."""

    def profile(y: Array) -> Array:
        from_lower, from_upper = y + 0.3, 0.7 - y
        inner = np.where(from_upper < 0.31, from_upper - 5 * from_upper**2, 7.0)
        return np.asarray(np.where(from_lower < 0.31, 2 * from_lower + from_lower**2, inner))

    np.testing.assert_allclose(continued("quadratic", profile), expected(profile), rtol=1e-9, atol=1e-9)


def test_linear_fits_the_particles_within_one_spacing() -> None:
    def profile(y: Array) -> Array:
        return np.asarray(np.where(y < -0.2, 2 * (y + 0.3) ** 2, 9.0))

    near = places(1)[:, 1] + 0.3
    near = near[near < SPACING]
    slope = np.sum(2 * near**3) / np.sum(near**2)
    np.testing.assert_allclose(continued("linear", profile)[0], -slope * DEPTHS, rtol=1e-12)


@pytest.mark.parametrize("rule", ["linear", "quadratic", "global_quadratic"])
def test_nothing_near_a_wall_leaves_its_velocity(rule: str) -> None:
    a, b = np.ones((3, 2, 2)), np.ones((3, 2, 2))
    nobody = np.zeros((0, 2))
    corners = np.zeros(2), np.ones(2)
    getattr(side_fits, rule)(nobody, nobody, *corners, 1, 0, np.zeros((2, 2)), SPACING, a, b)
    assert not a.any()
    assert not b.any()


def test_mirror_fits_nothing() -> None:
    np.testing.assert_allclose(continued("mirror", shear, **walls(shear)), [[-0.4] * 3, [2.6] * 3])


NODES = np.linspace(0.0, 1.0, 7)


def along_a_wall(
    rule: str, x: Array, slope: Callable[[Array], Array], bend: Callable[[Array], Array]
) -> tuple[Array, Array]:
    """What is fitted at the nodes of the lower wall to u = slope(x) y + bend(x) y^2 in the unit square."""
    v = np.stack((slope(x[:, 0]) * x[:, 1] + bend(x[:, 0]) * x[:, 1] ** 2, np.zeros(len(x))), axis=1)
    a, b = np.zeros((len(NODES), 2, 2)), np.zeros((len(NODES), 2, 2))
    getattr(side_fits, rule)(x, v, np.zeros(2), np.ones(2), 1, 0, np.zeros((2, 2)), SPACING, a, b)
    return a[:, 0, 0], b[:, 0, 0]


def nothing(x: Array) -> Array:
    return 0.0 * x


def sloping(x: Array) -> Array:
    return np.asarray(3.0 + 2.0 * x)


def bending(x: Array) -> Array:
    return np.asarray(-4.0 + x)


@pytest.mark.parametrize("rule", ["linear", "quadratic"])
def test_a_shear_that_is_the_same_along_a_wall_is_found_at_each_node(rule: str) -> None:
    x = np.random.default_rng(1).random((900, 2))
    bend = (lambda x: nothing(x) + 2.0) if rule == "quadratic" else nothing
    a, b = along_a_wall(rule, x, lambda x: nothing(x) + 3.0, bend)
    np.testing.assert_allclose(a, 3.0, rtol=1e-8)
    np.testing.assert_allclose(b, 2.0 if rule == "quadratic" else 0.0, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("rule", ["linear", "quadratic"])
def test_columns_of_particles_at_the_nodes_are_fitted_each_alone(rule: str) -> None:
    """Whatever the shear is along the wall."""
    y = np.array([0.03, 0.07, 0.13])
    x = np.stack(np.meshgrid(NODES, y), axis=-1).reshape(-1, 2)
    bend = bending if rule == "quadratic" else nothing
    a, b = along_a_wall(rule, x, lambda x: np.sin(9 * x), bend)
    np.testing.assert_allclose(a, np.sin(9 * NODES), rtol=1e-8, atol=1e-10)
    np.testing.assert_allclose(b, bend(NODES), rtol=1e-7, atol=1e-10)


def test_a_shear_linear_along_a_wall_is_found_where_particles_are_even_about_a_node() -> None:
    """At the ends, to one side of which there are none, it is that of the mean place under the weights."""
    apart = np.array([-0.31, -0.12, 0.12, 0.31, 0.5]) / 6  # half of a cell belongs to both of its nodes
    x = np.array([[node + s, 0.05] for node in NODES for s in apart if 0.0 <= node + s <= 1.0])
    a, _ = along_a_wall("linear", x, sloping, nothing)
    np.testing.assert_allclose(a[1:-1], sloping(NODES[1:-1]), rtol=1e-12)
    inwards = x[x[:, 0] < 1 / 6, 0]
    weight = 1 - 6 * inwards
    mean = weight @ inwards / weight.sum()
    np.testing.assert_allclose(a[[0, -1]], sloping(np.array([mean, 1 - mean])), rtol=1e-12)


def test_the_global_parabola_bends_as_the_fluid_does_around_each_node() -> None:
    """u = k(x) y (1 - y) between walls at rest, of columns at the nodes."""
    y = np.linspace(0.05, 0.95, 10)
    x = np.stack(np.meshgrid(NODES, y), axis=-1).reshape(-1, 2)
    a, b = along_a_wall("global_quadratic", x, sloping, lambda x: -sloping(x))
    np.testing.assert_allclose(a, sloping(NODES), rtol=1e-10)
    np.testing.assert_allclose(b, -sloping(NODES), rtol=1e-10)


@pytest.mark.parametrize(
    ("sides", "axis", "along", "nodes"),
    [
        (("periodic", "walls"), 1, -1, 1),
        (("walls", "periodic"), 0, -1, 1),
        (("walls", "walls"), 1, 0, 4),  # four spacings apart, about: 2 + whole number of them in 1.05
        (("walls", "walls"), 0, 1, 7),
    ],
)
def test_only_a_wall_between_walls_has_nodes(sides: Any, axis: int, along: int, nodes: int) -> None:
    lower, upper, kinds, _ = Box((0.0, 0.0), (1.05, 2.01), sides).arrays()
    assert wall_nodes(lower, upper, kinds, axis, SPACING) == (along, nodes)


class Mirrored:
    """A box with a lid, random particles in it, and what `mirror_velocities` writes for all axes."""

    def __init__(self, sides: Any, reflected: bool = False) -> None:
        self.box = Box((0.0, 0.0), (1.0, 1.0), sides, (-0.5, 0.0), (2.0, 0.0))
        generator = np.random.default_rng(2)
        self.x, self.v = generator.random((60, 2)), generator.normal(size=(60, 2))
        lower, upper, kinds, walls = self.box.arrays()
        self.at, self.source, self.wall = with_images(self.x, lower, upper, kinds, 0.5, SPACING)
        self.found = self.v[self.source]
        self.a, self.b = {}, {}
        for axis in self.box.wall_axes:
            _, nodes = wall_nodes(lower, upper, kinds, axis, SPACING)
            self.a[axis], self.b[axis] = generator.normal(size=(2, nodes, 2, 2))
            mirror_velocities(
                self.v, self.at, self.source, self.wall, lower, upper, kinds, axis, walls[axis], SPACING,
                self.a[axis], self.b[axis], reflected, self.found,
            )  # fmt: skip


@pytest.mark.parametrize("sides", [("periodic", "walls"), ("walls", "walls")])
def test_images_behind_one_wall_continue_the_velocity_along_it(sides: Any) -> None:
    flow = Mirrored(sides)
    seen = set()
    for e, bits in enumerate(flow.wall):
        if bits not in (1, 2, 4, 8):
            continue
        axis, side = divmod(int(bits).bit_length() - 1, 2)
        other = 1 - axis
        wall = {8: (2.0, 0.0), 4: (-0.5, 0.0)}.get(int(bits), (0.0, 0.0))
        depth = flow.at[e, axis] - 1.0 if side else -flow.at[e, axis]
        nodes = np.linspace(0.0, 1.0, max(2, len(flow.a[axis])))
        slope, bend = (
            np.interp(flow.at[e, other], nodes, np.broadcast_to(fitted[axis][:, side, other], len(nodes)))
            for fitted in (flow.a, flow.b)
        )
        expected = np.empty(2)
        expected[other] = wall[other] - slope * depth + bend * depth**2
        expected[axis] = 2 * wall[axis] - flow.v[flow.source[e], axis]
        np.testing.assert_allclose(flow.found[e], expected, rtol=1e-10, atol=1e-12)
        seen.add(int(bits))
    assert seen == ({1, 2, 4, 8} if sides[0] == "walls" else {4, 8})


def test_reflected_velocities_are_those_of_the_particle_about_the_wall() -> None:
    flow = Mirrored(("walls", "walls"), reflected=True)
    for bit, wall in ((1, (0.0, 0.0)), (4, (-0.5, 0.0)), (8, (2.0, 0.0))):
        one = flow.wall == bit
        assert one.any()
        np.testing.assert_allclose(flow.found[one], 2 * np.array(wall) - flow.v[flow.source[one]])


@pytest.mark.parametrize("reflected", [False, True])
def test_corner_images_have_the_velocity_of_their_particle(reflected: bool) -> None:
    """2 u_b - (2 u_a - u) and 2 u_a - (2 u_b - u), in the mean."""
    flow = Mirrored(("walls", "walls"), reflected)
    corners = np.isin(flow.wall, (1 | 4, 1 | 8, 2 | 4, 2 | 8))
    assert corners.sum() > 10
    np.testing.assert_array_equal(flow.found[corners], flow.v[flow.source[corners]])


def test_images_on_a_wall_move_with_it() -> None:
    flow = Mirrored(("walls", "walls"))
    for bit, wall in ((1, (0.0, 0.0)), (2, (0.0, 0.0)), (4, (-0.5, 0.0)), (8, (2.0, 0.0))):
        on_it = flow.wall == (bit | 64)
        assert on_it.any()
        np.testing.assert_array_equal(flow.found[on_it], np.tile(wall, (on_it.sum(), 1)))


def test_particles_and_periodic_images_keep_their_velocity() -> None:
    flow = Mirrored(("periodic", "walls"))
    inside = flow.wall == 0
    assert inside.sum() > 60
    np.testing.assert_array_equal(flow.found[inside], flow.v[flow.source[inside]])
