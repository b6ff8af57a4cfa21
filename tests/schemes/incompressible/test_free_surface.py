"""The free surface: who is on it, what rests and falls below it, and a dam that breaks."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sphear.boundaries import Box
from sphear.errors import SphearError
from sphear.references import dam_break as reference
from sphear.schemes.incompressible.flow import IncompressibleFlow
from sphear.schemes.incompressible.settings import IncompressibleSettings
from sphear.schemes.problem import Problem
from tests.particles import jittered
from tests.schemes.incompressible.flows import Array, case

COUNT, GRAVITY = 12, 1.0
DX = 1.0 / COUNT


def block(low: tuple[float, float], disorder: float = 0.0, box: Any = None, **changes: Any) -> IncompressibleFlow:
    """A square of fluid, its lower left corner in a place of a tank that is twice as high."""
    at = jittered((COUNT, COUNT), disorder, seed=0, dx=DX) + np.array(low)
    box = Box((0.0, 0.0), (1.0, 2.0), ("walls", "walls")) if box is None else box
    problem = Problem(
        at, np.zeros_like(at), box, (0.0, -GRAVITY), DX, 1.0, 0.01, 2.0, 1.0, free_surface=True
    )  # fmt: skip
    chosen = {"tolerance": 1e-8, "time_step": 0.01, **changes}
    return IncompressibleFlow(problem, IncompressibleSettings.model_validate(chosen))


def depth(flow: IncompressibleFlow) -> Array:
    """Below the surface of a block that fills its tank to the height 1."""
    return np.asarray(1.0 - flow.positions[:, 1])


@pytest.mark.parametrize("wall_model", ["mirror_points", "adami"])
@pytest.mark.parametrize("gradient", ["differences", "symmetric"])
def test_a_lattice_rests_with_the_pressure_of_its_depth(wall_model: str, gradient: str) -> None:
    correction = "renormalised" if gradient == "differences" else "none"
    flow = block((0.0, 0.0), walls=wall_model, gradient=gradient, gradient_correction=correction, alpha=0.0)
    flow.advance(1)
    np.testing.assert_allclose(flow.pressure, depth(flow), atol=0.1)
    assert np.polyfit(depth(flow), flow.pressure, 1)[0] == pytest.approx(GRAVITY, abs=0.05)


@settings(max_examples=3, deadline=None)
@given(disorder=st.floats(0.05, 0.3))
def test_disordered_fluid_comes_to_rest(disorder: float) -> None:
    flow = block((0.0, 0.0), disorder)
    flow.advance(150)
    assert np.abs(flow.velocities).max() < 0.1 * np.sqrt(GRAVITY)
    assert np.polyfit(depth(flow), flow.pressure, 1)[0] == pytest.approx(GRAVITY, abs=0.1)
    assert flow.positions[:, 1].mean() == pytest.approx(0.5, abs=0.03)


def test_the_outermost_particles_are_on_the_surface_and_no_others() -> None:
    flow = block((0.0, 0.9))
    open_sides = flow.discretisation.at(flow.positions + np.array([0.0, -0.05])).surface
    assert open_sides is not None
    cells = np.rint((flow.positions - flow.positions.min(axis=0)) / DX).astype(int)
    at_edge = (cells[:, 1] == 0) | (cells[:, 1] == COUNT - 1)  # the others are at walls
    inner = (cells[:, 0] > 1) & (cells[:, 0] < COUNT - 2)
    np.testing.assert_array_equal(open_sides.on[inner], at_edge[inner])


def test_a_block_in_flight_falls_freely_without_pressure() -> None:
    box = Box((-3.0, -3.0), (3.0, 3.0), ("walls", "walls"))
    flow = block((0.0, 0.0), box=box, alpha=0.0)
    before = flow.positions.copy()
    flow.advance(10)
    np.testing.assert_allclose(flow.velocities, [[0.0, -GRAVITY * flow.time]] * flow.count, atol=1e-6)
    assert np.abs(flow.pressure).max() < 1e-4
    np.testing.assert_allclose(flow.positions - before, [[0.0, -0.5 * GRAVITY * flow.time**2]] * flow.count, atol=1e-6)


def test_a_particle_that_is_alone_falls_to_the_floor_and_stays_there() -> None:
    box = Box((0.0, 0.0), (1.0, 1.0), ("walls", "walls"))
    problem = Problem(
        np.array([[0.5, 0.3]]), np.zeros((1, 2)), box, (0.0, -1.0), 0.05, 1.0, 0.01, 1.0, 1.0, free_surface=True
    )
    flow = IncompressibleFlow(problem, IncompressibleSettings(time_step=0.01))
    flow.advance(50)
    assert flow.velocities[0, 1] == pytest.approx(-0.5)
    flow.advance(100)
    assert 0 < flow.positions[0, 1] < 0.05
    assert abs(flow.velocities[0, 1]) < 0.05


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"walls": "sfdi"}, "needs fluid before every wall"),
        ({"walls": "natural"}, "carries no weight on walls"),
        ({"laplacian": "oger"}, "needs neighbours on all sides"),
    ],
)
def test_what_cannot_have_a_free_surface(changes: dict[str, Any], why: str) -> None:
    with pytest.raises(SphearError, match=why) as told:
        block((0.0, 0.0), **changes)
    assert len(str(told.value).splitlines()) == 1


@pytest.mark.parametrize("viscosity", ["fatehi_manzari", "two_pass"])
def test_a_dam_breaks_as_in_the_experiment(viscosity: str) -> None:
    """The gate of Martin & Moyce takes time to open: fronts are ahead of theirs, by most where it began to move."""
    run = case("dam-break", viscosity=viscosity, resolution=10, until=2.2).run()
    assert run.end == "time"
    measured = np.interp([row["time"] for row in run.history], reference.TIMES, reference.FRONTS)
    late = np.array([row["time"] > reference.TIMES[1] for row in run.history])
    ahead = np.array([row["front"] for row in run.history]) - measured
    assert ahead[late].min() > 0.0
    assert ahead[late].max() < 0.4
    energies = np.array([row["energy"] for row in run.history])
    assert np.max(energies - np.minimum.accumulate(energies)) < 2e-3
    assert run.history[-1]["smallest_distance"] > 0.25
