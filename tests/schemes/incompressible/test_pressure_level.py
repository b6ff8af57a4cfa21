"""The pressure's gradient and its level, and dummies that move with their wall."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear.errors import SphearError
from sphear.schemes.incompressible.flow import IncompressibleFlow
from sphear.schemes.incompressible.pressure_level import Level, levelled
from tests.schemes.incompressible.flows import case, in_a_tank


def test_levels() -> None:
    positions = np.array([[0.5, 0.5], [0.1, 0.1], [0.9, 0.1]])
    pressures = np.array([2.0, 1.0, -1.0, -3.0])  # the last is behind a wall
    expected: dict[Level, list[float]] = {
        "free": [2.0, 1.0, -1.0, -3.0],
        "corner": [1.0, 0.0, -2.0, -4.0],
        "least": [3.0, 2.0, 0.0, -2.0],
        "cut": [2.0, 1.0, 0.0, 0.0],
    }
    for level, values in expected.items():
        assert levelled(pressures, level, positions).tolist() == values


def test_sfdi_gradients_of_linear_pressures_are_exact() -> None:
    flow = in_a_tank(disorder=0.4, gradient="sfdi")
    sums = flow.discretisation.at(flow.x)
    slope = np.array((3.0, -2.0))
    found = sums.pressure_gradient(5.0 + sums.particles.positions @ slope)
    np.testing.assert_allclose(found, np.broadcast_to(slope, found.shape), atol=1e-10)


def test_a_raised_level_pushes_particles_apart_by_the_symmetric_gradient_only() -> None:
    symmetric: dict[str, Any] = {"gradient": "symmetric", "gradient_correction": "none"}
    pressures, gradients = None, {}
    for level in ("free", "least"):
        flow = in_a_tank(disorder=0.2, pressure_level=level, **symmetric)
        sums = flow.discretisation.at(flow.x)
        pressures = -sums.particles.positions[:, 1]
        gradients[level] = sums.pressure_gradient(pressures)
    assert pressures is not None
    raised = -pressures[: flow.count].min()
    ones = np.full(len(pressures), raised)
    added = in_a_tank(disorder=0.2, **symmetric).discretisation.at(flow.x).pressure_gradient(ones)
    np.testing.assert_allclose(gradients["least"] - gradients["free"], added, atol=1e-12)
    assert np.abs(added).max() > 0.1


@pytest.mark.parametrize("level", ["corner", "least"])
def test_a_level_that_changes_nothing_is_refused(level: str) -> None:
    with pytest.raises(SphearError, match=f"pressure_level={level} changes nothing with gradient=differences"):
        case("cavity", pressure_level=level, resolution=10)


def test_a_free_surface_has_its_own_level() -> None:
    with pytest.raises(SphearError, match="a free surface fixes the level of the pressure"):
        case("dam-break", pressure_level="cut")


def test_dummies_move_with_their_wall() -> None:
    flow = case("cavity", resolution=10, continuation="wall").flow
    assert isinstance(flow, IncompressibleFlow)
    walls = flow.discretisation.walls
    assert walls is not None
    behind = flow.discretisation.at(flow.positions).continued(np.ones_like(flow.positions))[flow.count :]
    np.testing.assert_array_equal(behind, walls.velocities)
    assert set(np.unique(behind[:, 0])) == {0.0, 1.0}
