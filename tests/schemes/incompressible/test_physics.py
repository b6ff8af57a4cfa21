"""What a flow without compression must do whatever the particles, and flows whose solution is known."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear.boundaries import Box
from sphear.references.taylor_green import TaylorGreen
from sphear.schemes.incompressible.flow import IncompressibleFlow
from sphear.schemes.problem import Problem
from tests.particles import lattice
from tests.schemes.incompressible.flows import Array, at_rest, case, in_a_box, in_a_tank, vortices

CONSERVING: dict[str, Any] = {"gradient": "symmetric", "gradient_correction": "none", "viscosity": "morris"}


@pytest.mark.parametrize("changes", [{}, {"projection": "intermediate", "shifting": "xu"}, CONSERVING])
def test_a_uniform_flow_stays_uniform(changes: dict[str, Any]) -> None:
    velocity = np.array([0.6, -0.3])
    flow = in_a_box(lambda x: np.tile(velocity, (len(x), 1)), alpha=0.0, **changes)
    flow.advance(5)
    np.testing.assert_allclose(flow.velocities, np.tile(velocity, (flow.count, 1)), rtol=0, atol=1e-14)


@pytest.mark.parametrize("changes", [{}, {"projection": "intermediate"}, CONSERVING])
def test_a_velocity_of_all_changes_nothing_else(changes: dict[str, Any]) -> None:
    velocity, steps = np.array([0.5, 0.25]), 5
    still, moving = in_a_box(vortices, **changes), in_a_box(lambda x: vortices(x) + velocity, **changes)
    still.advance(steps)
    moving.advance(steps)
    way = steps * still.time_step * velocity
    np.testing.assert_allclose(moving.velocities - velocity, still.velocities, rtol=0, atol=1e-11)
    np.testing.assert_allclose(moving.positions - way, still.positions, rtol=0, atol=1e-13)
    # where they were found: half a step later particles are elsewhere in a field that moves on
    np.testing.assert_allclose(moving.pressures.fluid, still.pressures.fluid, rtol=0, atol=1e-9)


@pytest.mark.parametrize("name", ["cavity", "taylor-green"])
def test_threads_change_nothing(name: str) -> None:
    one, two = (case(name, resolution=16, threads=threads, tolerance=1e-11).flow for threads in (1, 2))
    one.advance(3)
    two.advance(3)
    np.testing.assert_allclose(two.velocities, one.velocities, rtol=0, atol=1e-10)
    np.testing.assert_allclose(two.pressure, one.pressure, rtol=0, atol=1e-9)


def test_a_flow_in_three_dimensions_is_that_of_the_plane() -> None:
    """Vortices that go on along the third axis; there the flow is uniform."""
    flat = in_a_box(vortices, 8, 0.0, alpha=0.0, shifting="none", viscosity="morris")
    x = lattice((8, 8, 8), 1 / 8)
    velocity = np.concatenate((vortices(x[:, :2]), np.full((len(x), 1), 0.3)), axis=1)
    box = Box((0.0,) * 3, (1.0,) * 3, ("periodic",) * 3)
    problem = Problem(x, velocity, box, (0.0,) * 3, 1 / 8, 1.0, 0.01, 1.0, 1.0)
    deep = IncompressibleFlow(problem, flat.settings)
    flat.advance(2)
    deep.advance(2)
    np.testing.assert_allclose(deep.velocities[:, 2], 0.3, rtol=0, atol=1e-12)
    kinetic = (deep.velocities[:, :2] ** 2).sum() / 8
    assert kinetic == pytest.approx((flat.velocities**2).sum(), rel=0.01)
    assert np.corrcoef(deep.pressure, np.repeat(flat.pressure, 8))[0, 1] > 0.999


def test_momentum_is_conserved_to_rounding() -> None:
    """Where gradient and viscous term are equal and opposite for the two of a pair, and particles are not shifted."""
    flow = in_a_box(vortices, shifting="none", alpha=0.05, **CONSERVING)
    before = flow.velocities.sum(axis=0)
    flow.advance(10)
    assert np.abs(flow.velocities).sum() > 50
    np.testing.assert_allclose(flow.velocities.sum(axis=0), before, rtol=0, atol=1e-12)


def test_momentum_is_not_conserved_by_differences() -> None:
    """So that the test above says something."""
    flow = in_a_box(vortices, shifting="none", alpha=0.05, viscosity="morris")
    before = flow.velocities.sum(axis=0)
    flow.advance(10)
    assert np.abs(flow.velocities.sum(axis=0) - before).max() > 1e-4


@pytest.mark.parametrize("projection", ["midpoint", "start", "intermediate"])
def test_a_projection_takes_divergence_out(projection: str) -> None:
    """Not all of it: divergence, gradient and Laplacian are not made of each other."""

    def dilating(x: Array) -> Array:
        return vortices(x) + 0.3 * np.sin(2.0 * np.pi * x)

    flow = in_a_box(dilating, 20, 0.0, alpha=0.0, shifting="none", projection=projection)
    before = flow.metrics()["divergence"]
    flow.advance(1)
    assert flow.metrics()["divergence"] < 0.25 * before
    assert before > 0.5


def approaching(x: Array) -> Array:
    """Towards the line x = 1/2."""
    return np.stack((np.sin(2.0 * np.pi * x[:, 0]), np.zeros(len(x))), axis=1) * 0.1


@pytest.mark.parametrize("projection", ["start", "midpoint"])
@pytest.mark.parametrize("alpha", [0.0, 0.5, 1.0])
def test_pressure_of_fluid_that_runs_together(alpha: float, projection: str) -> None:
    """Of velocities, on a lattice: -rho U k cos(k x) / k^2 / dt times 1 - alpha: none where all of it is density.

    After half a step the density knows half of it.
    """
    flow = in_a_box(approaching, 20, 0.0, alpha=alpha, shifting="none", viscosity="morris", projection=projection)
    flow.advance(1)
    share = 1.0 - alpha if projection == "start" else 1.0 - alpha / 2.0
    expected = share * -0.1 / (2.0 * np.pi * flow.time_step) * np.cos(2.0 * np.pi * flow.problem.positions[:, 0])
    np.testing.assert_allclose(flow.pressure, expected, rtol=0, atol=0.05 * 0.1 / flow.time_step)


@pytest.mark.parametrize("alpha", [0.0, 0.5, 1.0])
def test_pressure_of_fluid_that_is_crowded(alpha: float) -> None:
    """At rest: particles on a wave that crowds them around x = 1/2 are pushed apart, by alpha."""
    crowded = in_a_box(at_rest, 20, 0.0, alpha=alpha, shifting="none", viscosity="morris")
    start = crowded.positions.copy()
    crowded.x[:, 0] += 0.01 * np.sin(2.0 * np.pi * start[:, 0])
    crowded.advance(1)
    wave = -np.cos(2.0 * np.pi * start[:, 0])  # highest in the middle
    if alpha == 0.0:
        assert not crowded.pressure.any()
        return
    share = float((crowded.pressure * wave).sum() / (wave**2).sum())
    # rho' = -rho a k cos(k x) and lap p = -alpha rho' / dt^2
    assert share == pytest.approx(alpha * 0.01 / (2.0 * np.pi) / crowded.time_step**2, rel=0.2)
    away = crowded.velocities[:, 0] * -np.sin(2.0 * np.pi * start[:, 0])
    assert away.min() > -1e-9


def test_the_density_decays_with_alpha() -> None:
    """In the time dt / alpha, as the settings say."""
    flow = in_a_box(at_rest, 20, 0.0, alpha=0.2, shifting="none")
    flow.x[:, 0] += 0.01 * np.sin(2.0 * np.pi * flow.positions[:, 0])
    before = flow.metrics()["density_deviation"]
    flow.advance(20)
    assert flow.metrics()["density_deviation"] < 0.2 * before


@pytest.mark.parametrize(
    ("changes", "disorder", "tolerance"),
    [
        ({}, 0.0, 1e-12),
        ({"laplacian": "fatehi_manzari"}, 0.4, 1e-10),  # exact for linear fields on any particles
        ({"laplacian": "fatehi_manzari", "projection": "intermediate", "viscosity": "oger"}, 0.4, 1e-10),
        ({}, 0.3, 2e-3),
        ({"walls": "adami"}, 0.0, 1e-10),
        ({"walls": "sfdi"}, 0.0, 1e-10),
        ({"walls": "natural"}, 0.0, 1e-2),
    ],
)
def test_a_tank_stays_at_rest(changes: dict[str, Any], disorder: float, tolerance: float) -> None:
    flow = in_a_tank(disorder=disorder, shifting="none", **changes)
    flow.advance(3)
    fallen = 3 * flow.time_step  # what it would fall at without pressure
    assert fallen == pytest.approx(0.012)
    assert np.abs(flow.velocities).max() < tolerance
    slope = np.polyfit(flow.positions[:, 1], flow.pressure, 1)[0]
    assert slope == pytest.approx(-1.0, abs=100 * tolerance if tolerance < 1e-3 else 0.1)


@pytest.mark.parametrize("term", ["morris", "oger"])
def test_poiseuille_flow_follows_its_series(term: str) -> None:
    run = case("poiseuille", viscosity=term, resolution=16, until=1.0).run()
    assert run.end == "time"
    assert max(row["rms_error"] for row in run.history[len(run.history) // 5 :]) < 0.02
    assert run.history[-1]["rms_error"] < 0.006


def test_couette_flow_follows_its_series() -> None:
    run = case("couette", viscosity="oger", resolution=12, until=0.5).run()
    assert (run.end, run.history[-1]["rms_error"] < 0.004) == ("time", True)


def test_vortices_decay_as_they_should() -> None:
    run = case("taylor-green", resolution=32, until=0.5).run()
    assert run.history[-1]["kinetic_energy_ratio"] == pytest.approx(1.0, abs=0.05)
    assert run.history[-1]["smallest_distance"] > 0.5


def test_pressure_of_vortices() -> None:
    run = case("taylor-green", resolution=32, until=0.1).run()
    flow = run.flow
    assert isinstance(flow, IncompressibleFlow)
    exact = np.asarray(TaylorGreen(0.01).pressure(flow.positions, flow.pressure_time))
    error = flow.pressure - flow.pressure.mean() - exact + exact.mean()
    assert np.linalg.norm(error) < 0.08 * np.linalg.norm(exact)


@pytest.mark.parametrize("wall_model", ["mirror_points", "sfdi"])
def test_shifted_particles_stay_apart_where_the_divergence_sees_no_slip_too(wall_model: str) -> None:
    """They ran away where velocities followed shifts by the slope of continued ones, which a lid steepens."""
    run = case("cavity", resolution=20, reynolds=1000.0, until=2.0, wall_divergence="continued", walls=wall_model).run()
    assert run.end == "time"
    assert min(row["smallest_distance"] for row in run.history) > 0.5
