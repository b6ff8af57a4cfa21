"""The fluid at the beginning: all of the lattice that is fluid, and a little away from the walls."""

from __future__ import annotations

import numpy as np
import pytest

from sphear import SphearError
from sphear.boundaries.shapes import Circle, Rectangle, fluid_lattice
from sphear.neighbours.domain import Domain
from tests.boundaries.shapes.examples import (
    ALL,
    CAVITY,
    CHANNEL,
    CYLINDER,
    SQUARE,
    WALLS,
    same_places,
)

DX = 1 / 40
CELLS = np.stack(np.meshgrid((np.arange(40) + 0.5) * DX, (np.arange(40) + 0.5) * DX), axis=2).reshape(-1, 2)


def test_a_cavity_is_full() -> None:
    same_places(fluid_lattice(CAVITY, DX, SQUARE), CELLS)


def test_cells_in_the_fluid_are_kept_and_moved_away_from_the_wall() -> None:
    shape = CAVITY - CYLINDER
    found = fluid_lattice(shape, DX, SQUARE)
    cells = CELLS[shape.distance(CELLS) > 0]
    assert len(found) == len(cells)
    assert len(found) * DX**2 == pytest.approx(1 - np.pi / 16, rel=5e-3)
    away = shape.distance(cells) >= 0.25 * DX
    assert shape.distance(found).min() == pytest.approx(0.25 * DX)
    kept = {tuple(place) for place in found.round(9)}
    assert kept >= {tuple(place) for place in cells[away].round(9)}


@pytest.mark.parametrize("name", ALL)
def test_no_particle_is_nearer_to_a_wall(name: str) -> None:
    shape = ALL[name]
    assert shape.distance(fluid_lattice(shape, DX, SQUARE)).min() > 0.2499 * DX


def test_a_whole_number_fits_a_period() -> None:
    window = Domain((0.0, 0.0), (1.01, 1.0), (True, False))
    found = fluid_lattice(WALLS, DX, window)
    assert len(found) == 1600
    np.testing.assert_allclose(np.unique(found[:, 0].round(9)), (np.arange(40) + 0.5) * 1.01 / 40, atol=1e-8)


def test_images_of_a_cylinder_leave_their_room() -> None:
    beside = fluid_lattice(WALLS - Circle((0.0, 0.5), 0.25), DX, CHANNEL)
    middle = fluid_lattice(WALLS - Circle((0.5, 0.5), 0.25), DX, CHANNEL)
    same_places(CHANNEL.wrapped(beside + np.array([0.5, 0.0])), middle)


def test_walls_that_leave_no_fluid_are_refused() -> None:
    message = r"the walls leave no fluid for particles 0.025 apart in the window from \(0, 0\) to \(1, 1\)"
    for shape in (Rectangle((2, 2), (3, 3)), CAVITY - Circle((0.5, 0.5), 2), ~CAVITY):
        with pytest.raises(SphearError, match=message):
            fluid_lattice(shape, DX, SQUARE)
    with pytest.raises(SphearError, match="the spacing of particles is positive"):
        fluid_lattice(CAVITY, -DX, SQUARE)
