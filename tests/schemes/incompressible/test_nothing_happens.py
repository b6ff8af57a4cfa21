"""Flows at rest, uniform or parallel, in boxes whose cells are no squares; positions that stay in their box."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear.boundaries import Box
from sphear.schemes.incompressible.flow import IncompressibleFlow
from sphear.schemes.incompressible.settings import IncompressibleSettings
from sphear.schemes.problem import Problem
from tests.schemes.incompressible.flows import Array


def flow(
    period: float, walled: bool, force: tuple[float, float], velocity: tuple[float, float], **changes: Any
) -> IncompressibleFlow:
    """Ten particles a unit across the channel, a lattice along it that fills the period."""
    along, across = (np.arange(round(10 * period)) + 0.5) / round(10 * period) * period, (np.arange(10) + 0.5) / 10
    x = np.stack(np.meshgrid(along, across, indexing="ij"), axis=-1).reshape(-1, 2)
    box = Box((0.0, 0.0), (period, 1.0), ("periodic", "walls" if walled else "periodic"))
    problem = Problem(x, velocity + 0.0 * x, box, force, 0.1, 1.0, 0.1, 1.0, 1.0)
    settings = {"viscosity": "morris", "tolerance": 1e-6, **changes}
    return IncompressibleFlow(problem, IncompressibleSettings.model_validate(settings))


@pytest.mark.parametrize("period", [1.0, 1.03, 1.05, 1.21, 1.3])
@pytest.mark.parametrize("wall_model", ["mirror_points", "adami", "sfdi", "natural"])
def test_a_channel_of_any_period(period: float, wall_model: str) -> None:
    run = flow(period, True, (1.0, 0.0), (0.0, 0.0), walls=wall_model)
    run.advance(1)
    assert np.abs(run.velocities[:, 1]).max() < 1e-9
    run.advance(3)
    assert run.time * 0.3 < run.velocities[:, 0].max() <= run.time * (1.0 + 1e-9)
    assert np.abs(run.velocities[:, 1]).max() < 5e-6  # sums over lattices that are sheared see another density


@pytest.mark.parametrize("period", [1.03, 1.3])
@pytest.mark.parametrize("wall_model", ["mirror_points", "adami", "sfdi"])
def test_nothing_moves_at_rest(period: float, wall_model: str) -> None:
    run = flow(period, True, (0.0, -1.0), (0.0, 0.0), walls=wall_model)
    run.advance(4)
    assert np.abs(run.velocities).max() < 1e-6
    exact: Array = -run.positions[:, 1]
    np.testing.assert_allclose(run.pressure - run.pressure.mean(), exact - exact.mean(), atol=1e-5)


@pytest.mark.parametrize("period", [1.03, 1.21])
def test_a_stream_stays_uniform_and_in_its_box(period: float) -> None:
    run = flow(period, False, (0.0, 0.0), (1.0, 0.7), time_step=0.03)
    start = run.positions.copy()
    run.advance(30)
    np.testing.assert_allclose(run.velocities, [(1.0, 0.7)] * run.count, atol=1e-6)
    assert (run.positions >= 0.0).all()
    assert (run.positions < (period, 1.0)).all()
    way = run.positions - start - run.time * np.array((1.0, 0.7))
    np.testing.assert_allclose(way - np.rint(way / (period, 1.0)) * (period, 1.0), 0.0, atol=1e-6)
