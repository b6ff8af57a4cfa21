"""Fluid that turns with a round wall: an exact steady flow, whose pressure the wall's own acceleration makes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear.boundaries import Box
from sphear.boundaries.shapes import Circle, Polygon, Shape, fluid_lattice
from sphear.neighbours import Domain
from sphear.schemes.incompressible.flow import IncompressibleFlow
from sphear.schemes.incompressible.settings import IncompressibleSettings
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]

CENTRE, SPIN = (0.5, 0.5), 2.0
WHEEL = Circle(CENTRE, 0.47, spin=SPIN)
RING = WHEEL - Circle(CENTRE, 0.15, spin=SPIN)  # the axle turns as fast
SHAPES: dict[str, Shape] = {"wheel": WHEEL, "ring": RING}


def turning(x: Array) -> Array:
    return SPIN * np.stack((-(x[:, 1] - CENTRE[1]), x[:, 0] - CENTRE[0]), axis=1)


def flow(shape: Shape, count: int, **changes: Any) -> IncompressibleFlow:
    """As it should go on for ever."""
    x = fluid_lattice(shape, 1 / count, Domain((0.0, 0.0), (1.0, 1.0), periodic=False))
    box = Box((0.0, 0.0), (1.0, 1.0), ("walls", "walls"))
    problem = Problem(x, turning(x), box, (0.0, 0.0), 1 / count, 1.0, 0.01, 1.0, 1.0, shape=shape)
    return IncompressibleFlow(problem, IncompressibleSettings(alpha=0.0, time_step=0.01, tolerance=1e-8, **changes))


@pytest.mark.parametrize("name", SHAPES)
def test_fluid_goes_on_turning_with_its_walls(name: str) -> None:
    done = flow(SHAPES[name], 32)
    done.advance(50)
    exact = turning(done.positions)
    assert np.linalg.norm(done.velocities - exact) < 0.01 * np.linalg.norm(exact)
    assert (done.velocities**2).sum() == pytest.approx((exact**2).sum(), rel=0.01)


def test_pressure_holds_the_fluid_on_its_circles() -> None:
    done = flow(WHEEL, 32)
    done.advance(20)
    x = done.positions - CENTRE
    exact = 0.5 * SPIN**2 * (x**2).sum(axis=1)
    error = done.pressure - done.pressure.mean() - exact + exact.mean()
    assert np.linalg.norm(error) < 0.05 * np.linalg.norm(exact - exact.mean())


def test_walls_have_the_acceleration_that_turns_them() -> None:
    walls = flow(RING, 24).discretisation.walls
    assert walls is not None
    np.testing.assert_allclose(walls.accelerations, -(SPIN**2) * (walls.feet - CENTRE), atol=1e-12)


@pytest.mark.parametrize("count", [24, 60])
def test_straight_walls_that_slide_have_no_acceleration_where_they_meet_either(count: int) -> None:
    """A drum of sliding belts, with 60 of which the feet of wall particles are on its corners."""
    angles = 2.0 * np.pi * np.arange(count) / count
    corners = np.array(CENTRE) + 0.47 * np.stack((np.cos(angles), np.sin(angles)), axis=1)
    along = np.roll(corners, -1, axis=0) - corners
    along /= np.linalg.norm(along, axis=1)[:, None]
    belts = {k: (float(u), float(v)) for k, (u, v) in enumerate(SPIN * 0.47 * along)}
    done = flow(Polygon([(float(x), float(y)) for x, y in corners], belts), 32)
    walls = done.discretisation.walls
    assert walls is not None
    assert not walls.accelerations.any()
    done.advance(10)
    exact = turning(done.positions)
    assert np.linalg.norm(done.velocities - exact) < 0.03 * np.linalg.norm(exact)
