"""Fixed particles behind walls: the lattice of the fluid goes on."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear.boundaries import Box, WallParticles, wall_particles
from tests.particles import lattice

Array = np.ndarray[Any, Any]
LID = (2.0, 0.0)
CHANNEL = Box((0.0, -1.0), (2.0, 0.0), ("periodic", "walls"), upper_velocity=LID)
CAVITY = Box((0.0, -1.0), (2.0, 0.0), ("walls", "walls"), upper_velocity=LID)
SPACING, LAYERS = 0.25, 3


def outside(box: Box, places: Array) -> Array:
    return np.array(((places < box.lower) | (places > box.upper)).any(axis=1))


def behind(box: Box) -> WallParticles:
    return wall_particles(box, SPACING, LAYERS)


@pytest.mark.parametrize(("box", "layers"), [(CHANNEL, (0, 3)), (CAVITY, (3, 3))])
def test_they_continue_the_lattice_beyond_the_walls(box: Box, layers: tuple[int, int]) -> None:
    counts = 8 + 2 * layers[0], 4 + 2 * layers[1]
    everywhere = lattice(counts, SPACING) + np.array(box.lower) - SPACING * np.array(layers)
    expected = everywhere[outside(box, everywhere)]
    found = behind(box).positions
    assert len(found) == {0: 2 * 3 * 8, 3: 14 * 10 - 8 * 4}[layers[0]]
    np.testing.assert_allclose(found[np.lexsort(found.T)], expected[np.lexsort(expected.T)], atol=1e-12)


@pytest.mark.parametrize("box", [CHANNEL, CAVITY])
def test_normals_and_depths_lead_to_the_wall(box: Box) -> None:
    found = behind(box)
    straight = found.depths > 0
    np.testing.assert_array_equal(np.abs(found.normals[straight]).sum(axis=1), 1.0)
    at_wall = found.positions + found.depths[:, None] * found.normals
    axis = np.argmax(np.abs(found.normals), axis=1)[straight]
    rows = np.arange(len(axis))
    ends = np.where(found.normals[straight] > 0, box.lower, box.upper)
    np.testing.assert_allclose(at_wall[straight][rows, axis], ends[rows, axis], atol=1e-12)
    assert not outside(box, (at_wall + 1e-9 * found.normals)[straight]).any()


def test_corners_have_neither_normal_nor_depth() -> None:
    found = behind(CAVITY)
    corners = ((found.positions < CAVITY.lower) | (found.positions > CAVITY.upper)).all(axis=1)
    assert corners.sum() == 4 * LAYERS**2
    np.testing.assert_array_equal(corners, found.depths == 0)
    assert not found.normals[corners].any()
    assert behind(CHANNEL).depths.all()


@pytest.mark.parametrize("box", [CHANNEL, CAVITY])
def test_the_nearest_stands_in_the_first_layer_before_them(box: Box) -> None:
    found = behind(box)
    first = found.positions + (found.depths - 0.5 * SPACING)[:, None] * found.normals
    corners = found.depths == 0
    first[corners] = found.positions[corners]
    np.testing.assert_allclose(found.positions[found.nearest], first, atol=1e-12)


@pytest.mark.parametrize("box", [CHANNEL, CAVITY])
def test_the_lid_moves_and_corners_belong_to_the_slower_wall(box: Box) -> None:
    found = behind(box)
    under_the_lid = (found.positions[:, 1] > 0.0) & (found.positions[:, 0] > 0.0) & (found.positions[:, 0] < 2.0)
    np.testing.assert_array_equal(found.velocities, np.where(under_the_lid[:, None], LID, 0.0))


def test_no_layers_and_no_walls_are_no_particles() -> None:
    periodic = Box((0.0, 0.0), (1.0, 1.0), ("periodic", "periodic"))
    for found in (wall_particles(CAVITY, SPACING, 0), wall_particles(periodic, SPACING, 3)):
        assert found.positions.shape == found.normals.shape == found.velocities.shape == (0, 2)
        assert found.depths.shape == found.nearest.shape == (0,)


def test_three_dimensions() -> None:
    box = Box((0.0, 0.0, 0.0), (0.5, 1.0, 1.0), ("periodic", "walls", "walls"))
    found = wall_particles(box, SPACING, 2)
    assert len(found.positions) == 2 * (8 * 8 - 4 * 4)
    assert (found.depths == 0).sum() == 2 * 4 * 2**2
