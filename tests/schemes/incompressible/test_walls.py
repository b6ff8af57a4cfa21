"""Walls of any shape: cylinders of other sizes at other places, and walls of a user's own."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sphear.boundaries import Box
from sphear.boundaries.shapes import Circle, Polygon, Rectangle, Shape, fluid_lattice
from sphear.cases.flow.initial import particles_in
from sphear.errors import SphearError
from sphear.neighbours import Domain
from sphear.schemes.incompressible.flow import IncompressibleFlow
from sphear.schemes.incompressible.settings import IncompressibleSettings
from sphear.schemes.problem import Problem
from tests.particles import jittered
from tests.schemes.incompressible.flows import case, in_a_tank

UNIT = Domain((0.0, 0.0), (1.0, 1.0), False)


@settings(max_examples=4)
@given(diameter=st.floats(0.2, 0.5), x=st.floats(0.45, 0.55), y=st.floats(0.45, 0.55), spin=st.sampled_from([0.0, 2.0]))
def test_other_cylinders(diameter: float, x: float, y: float, spin: float) -> None:
    run = case(
        "cavity-cylinder", resolution=24, reynolds=200.0, diameter=diameter, centre_x=x, centre_y=y, spin=spin,
        viscosity="oger", max_steps=20,
    ).run()  # fmt: skip
    assert run.end == "steps"
    flow, last = run.flow, run.history[-1]
    assert np.hypot(*(flow.positions - (x, y)).T).min() > 0.5 * diameter
    assert last["smallest_distance"] > 0.3
    assert last["largest_gap"] < 1.3
    assert np.abs(flow.velocities).max() < 1.2
    assert run.case.summary(run.settings, flow).keys() == {"u_min"}  # no reference of other cylinders


@pytest.mark.parametrize("wall_model", ["mirror_points", "adami", "sfdi", "natural"])
def test_each_wall_condition_beside_a_cylinder(wall_model: str) -> None:
    run = case("cavity-cylinder", resolution=24, walls=wall_model, viscosity="oger", max_steps=10).run()
    assert run.end == "steps"
    assert run.history[-1]["divergence"] < 0.5


USERS: dict[str, Shape] = {
    "triangle": Polygon(((0.05, 0.02), (0.95, 0.1), (0.5, 0.97))),
    "room": Polygon(((0.0, 0.0), (1.0, 0.0), (1.0, 0.5), (0.5, 0.5), (0.5, 1.0), (0.0, 1.0))),
    "drum": Circle((0.5, 0.5), 0.47),
    "two posts": Rectangle((0.0, 0.0), (1.0, 1.0)) - Circle((0.27, 0.4), 0.1) - Circle((0.73, 0.6), 0.1),
}


@pytest.mark.parametrize("name", USERS)
def test_walls_of_ones_own(name: str) -> None:
    """Under gravity in a closed room nothing falls, and the pressure is that of the depth."""
    shape = USERS[name]
    at = fluid_lattice(shape, 1 / 24, UNIT)
    flow = in_a_tank(24, shape=shape, at=at, viscosity="oger", tolerance=1e-8)
    flow.advance(10)
    assert (shape.distance(flow.positions) > 0).all()
    assert np.abs(flow.velocities).max() < 0.04 * 10 * flow.time_step
    slope = np.polyfit(flow.positions[:, 1], flow.pressure, 1)[0]
    assert slope == pytest.approx(-1.0, abs=0.01)


def test_a_wheel_turns_its_fluid() -> None:
    """Around a moving polygon side as around a spinning cylinder, velocities at the wall are those of the wall."""
    shape = Circle((0.5, 0.5), 0.45, spin=1.0)
    at = fluid_lattice(shape, 1 / 20, UNIT)
    flow = in_a_tank(20, shape=shape, at=at, alpha=0.0, viscosity="oger", tolerance=1e-8)
    flow.advance(20)
    d = flow.positions - 0.5
    turning = (d[:, 0] * flow.velocities[:, 1] - d[:, 1] * flow.velocities[:, 0]) / (d**2).sum(axis=1)
    outer = np.hypot(*d.T) > 0.4
    assert 0.3 < turning[outer].mean() < 1.0
    assert abs(turning[np.hypot(*d.T) < 0.2]).max() < 0.1


def refused(match: str, **changes: Any) -> None:
    with pytest.raises(SphearError, match=match) as told:
        in_a_tank(20, **{"at": np.full((1, 2), 0.5), **changes})
    assert len(str(told.value).splitlines()) == 1


def test_walls_that_leave_no_fluid() -> None:
    refused("no fluid", shape=Rectangle((0.0, 0.0), (1.0, 1.0)) - Rectangle((0.01, 0.01), (0.99, 0.99)))


def test_walls_with_a_gap_narrower_than_the_kernel() -> None:
    refused("narrower than the support of the kernel", shape=Circle((0.5, 0.5), 0.45) - Circle((0.5, 0.5), 0.4))


def test_bodies_that_overlap() -> None:
    square = Rectangle((0.0, 0.0), (1.0, 1.0))
    refused("shapes overlap", shape=square - Circle((0.4, 0.5), 0.15) - Circle((0.6, 0.5), 0.15))
    refused("shapes overlap", shape=square - Circle((0.1, 0.5), 0.2))


def test_a_lid_that_moves_through_its_wall() -> None:
    with pytest.raises(SphearError, match="moves through the wall"):
        Rectangle((0.0, 0.0), (1.0, 1.0), velocities={"upper": (1.0, 0.5)})


def test_particles_that_start_behind_a_wall() -> None:
    at = np.array([[0.5, 0.5], [0.5, 0.05], [0.6, 0.5]])
    refused(r"particle 1 at \(0.5, 0.05\) starts behind a wall", shape=Circle((0.5, 0.5), 0.4), at=at)


@pytest.mark.parametrize("what", [np.nan, np.inf])
def test_a_start_that_is_no_number(what: float) -> None:
    at = np.array([[0.5, 0.5], [0.4, what]])
    refused("the initial position of particle 1 is not a number", at=at)


def test_walls_in_three_dimensions() -> None:
    x = jittered((4, 4, 4), 0.2, seed=0, dx=0.25)
    box = Box((0.0,) * 3, (1.0,) * 3, ("walls", "periodic", "periodic"))
    still = Problem(x, np.zeros_like(x), box, (0.0,) * 3, 0.25, 1.0, 0.01, 1.0, 1.0)
    with pytest.raises(SphearError, match="walls of incompressible flows are in two dimensions, not in 3"):
        IncompressibleFlow(still, IncompressibleSettings())


def test_particles_on_the_walls_of_a_polygon() -> None:
    """Also in its sharp corners."""
    at = fluid_lattice(USERS["triangle"], 1 / 24, UNIT)
    flow = in_a_tank(24, shape=USERS["triangle"], at=at, viscosity="oger", walls="sfdi")
    flow.advance(5)
    walls = flow.discretisation.walls
    assert walls is not None
    on = walls.dummies.positions[: walls.on_wall]
    np.testing.assert_allclose(USERS["triangle"].distance(on), 0.0, atol=1e-9)
    assert np.isfinite(flow.pressures.on_walls).all()


@pytest.mark.parametrize("radius", [0.2, 0.23])
@pytest.mark.parametrize("wall_model", ["mirror_points", "adami", "sfdi", "natural"])
def test_a_cylinder_on_the_end_of_a_period_is_one_in_its_middle(wall_model: str, radius: float) -> None:
    """A row of them in a channel: moved by whole spacings, all is moved, and nothing else changes."""

    def flow(x: float) -> IncompressibleFlow:
        shape = Rectangle((-math.inf, 0.0), (math.inf, 1.0)) - Circle((x, 0.5), radius)
        box = Box((0.0, 0.0), (1.0, 1.0), ("periodic", "walls"))
        chosen = IncompressibleSettings.model_validate(
            {"walls": wall_model, "viscosity": "oger", "alpha": 0.05, "resolution": 24, "tolerance": 1e-11}
        )
        at, dx = particles_in(shape, box, chosen)
        start = np.tile([0.5, 0.0], (len(at), 1))
        return IncompressibleFlow(Problem(at, start, box, (1.0, 0.0), dx, 1.0, 0.01, 1.0, 1.0, shape=shape), chosen)

    middle, end = flow(0.5), flow(0.0)
    place, order = np.lexsort(middle.positions.T.round(6)), (end.positions + np.array([0.5, 0.0])) % 1.0
    same = np.lexsort(order.T.round(6))
    end.displacement.uneven[same] = middle.displacement.uneven[place]  # of the same particles, which have other numbers
    np.testing.assert_allclose(order[same], middle.positions[place], rtol=0, atol=1e-12)
    middle.advance(5)
    end.advance(5)
    np.testing.assert_allclose(end.velocities[same], middle.velocities[place], rtol=0, atol=1e-8)
    np.testing.assert_allclose(end.pressure[same], middle.pressure[place], rtol=0, atol=1e-6)


@pytest.mark.parametrize("wall_model", ["mirror_points", "adami", "sfdi", "natural"])
def test_left_is_as_good_as_right_and_up(wall_model: str) -> None:
    """A lid that slides to the left, and a right wall that slides upwards, drive the mirror images of the flow."""
    found = case("cavity", resolution=14, viscosity="oger", walls=wall_model, tolerance=1e-11).flow
    problem = found.problem
    images = {
        "mirrored": (
            np.stack((1.0 - problem.positions[:, 0], problem.positions[:, 1]), axis=1),
            Rectangle((0.0, 0.0), (1.0, 1.0), velocities={"upper": (-1.0, 0.0)}),
            lambda u: u * [-1.0, 1.0],
        ),
        "exchanged": (
            np.ascontiguousarray(problem.positions[:, ::-1]),
            Rectangle((0.0, 0.0), (1.0, 1.0), velocities={"right": (0.0, 1.0)}),
            lambda u: u[:, ::-1],
        ),
    }
    assert isinstance(found, IncompressibleFlow)
    found.advance(12)
    for at, shape, image in images.values():
        other = IncompressibleFlow(replace(problem, positions=at, shape=shape), found.settings)
        other.displacement.uneven = image(found.displacement.uneven)
        other.advance(12)
        np.testing.assert_allclose(other.velocities, image(found.velocities), rtol=0, atol=1e-9)
        np.testing.assert_allclose(other.pressure, found.pressure, rtol=0, atol=1e-9)


@pytest.mark.parametrize("wall_model", ["mirror_points", "adami", "sfdi", "natural"])
@pytest.mark.parametrize(
    "corners",
    [
        ((0.05, 0.1), (0.95, 0.1), (0.05, 0.9)),  # several wall particles have one foot in the corners
        ((0.8395474248078525, 0.7683558875961131), (0.4536828615371135, 0.2727562564271032), (0.80015714, 0.40764246)),
    ],
    ids=["right", "sharp"],
)
def test_fluid_rests_in_sharp_corners(corners: tuple[tuple[float, float], ...], wall_model: str) -> None:
    shape = Polygon(corners)
    at = fluid_lattice(shape, 1 / 24, UNIT)
    flow = in_a_tank(24, shape=shape, at=at, viscosity="morris", walls=wall_model)
    flow.advance(5)
    fallen = 5 * flow.time_step
    assert np.abs(flow.velocities).max() < (0.8 if wall_model == "natural" else 0.3) * fallen


def test_a_shape_that_goes_on_beyond_a_wall_of_the_box_is_refused() -> None:
    with pytest.raises(SphearError, match="goes on beyond the wall of the box at x = 0: cut it there"):
        in_a_tank(24, shape=~Circle((0.5, 0.5), 0.2))
