"""Where particles are at the start: on lattices, and disordered."""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.spatial import cKDTree

from sphear.boundaries import Box
from sphear.boundaries.box import Side
from sphear.cases.flow.initial import particles_between
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings

Array = np.ndarray[Any, Any]

BOXES: dict[str, tuple[Side, Side]] = {
    "channel": ("periodic", "walls"),
    "cavity": ("walls", "walls"),
    "periodic": ("periodic", "periodic"),
}


@cache
def placed(initial: str, sides: str = "channel", n: int = 10, seed: int = 0) -> tuple[Array, float]:
    """In a box from (1, -1) to (5, 1), twice as long as high."""
    settings = WeaklyCompressibleSettings.model_validate({"initial": initial, "resolution": n, "seed": seed})
    return particles_between(Box((1.0, -1.0), (5.0, 1.0), BOXES[sides]), settings)


def rows(positions: Array) -> list[Array]:
    """The sorted x of each row, by y."""
    return [np.sort(positions[np.isclose(positions[:, 1], y), 0]) for y in np.unique(positions[:, 1].round(9))]


@pytest.mark.parametrize("sides", BOXES)
@pytest.mark.parametrize("initial", ["lattice", "staggered", "relaxed"])
def test_the_box_is_filled_with_a_particle_for_each_square(initial: str, sides: str) -> None:
    positions, spacing = placed(initial, sides)
    assert spacing == pytest.approx(0.2)
    assert len(positions) == 20 * 10


@pytest.mark.parametrize("sides", BOXES)
def test_the_lattice_is_half_a_spacing_away_from_all_sides(sides: str) -> None:
    positions, spacing = placed("lattice", sides)
    ticks = 1 + (np.arange(20) + 0.5) * spacing, -1 + (np.arange(10) + 0.5) * spacing
    expected = np.stack(np.meshgrid(*ticks, indexing="ij"), axis=-1).reshape(-1, 2)
    np.testing.assert_allclose(positions, expected, atol=1e-12)


@pytest.mark.parametrize("sides", BOXES)
def test_staggered_rows_are_shifted_by_half_a_spacing_against_each_other(sides: str) -> None:
    positions, spacing = placed("staggered", sides)
    found = rows(positions)
    assert [len(row) for row in found] == [20] * 10
    for row, following in pairwise(found):
        between = (row - following) / spacing
        np.testing.assert_allclose(np.abs(between - between.round()), 0.5, atol=1e-9)
        np.testing.assert_allclose(np.diff(row), spacing)


def test_staggered_rows_between_walls_leave_as_much_room_to_either_wall() -> None:
    positions, spacing = placed("staggered", "cavity")
    for row in rows(positions):
        ends = sorted(((row[0] - 1) / spacing, (5 - row[-1]) / spacing))
        np.testing.assert_allclose(ends, (0.25, 0.75), atol=1e-9)


def test_staggered_rows_close_over_a_periodic_side() -> None:
    positions, spacing = placed("staggered", "channel")
    for row in rows(positions):
        assert row[0] + 4 - row[-1] == pytest.approx(spacing)


@pytest.mark.parametrize("sides", BOXES)
@pytest.mark.parametrize("seed", [0, 1])
def test_relaxed_particles_keep_their_distance(sides: str, seed: int) -> None:
    """Also over periodic sides; from walls at least a quarter, where the lattice is half a spacing away."""
    positions, spacing = placed("relaxed", sides, 10, seed)
    images = [positions]
    for axis, length in enumerate((4.0, 2.0)):
        if BOXES[sides][axis] == "periodic":
            images += [image + sign * length * np.eye(2)[axis] for image in list(images) for sign in (-1, 1)]
    nearest = np.asarray(cKDTree(np.concatenate(images)).query(positions, k=2)[0])[:, 1]
    assert nearest.min() >= 0.8 * spacing
    for axis, (low, high) in enumerate(((1, 5), (-1, 1))):
        if BOXES[sides][axis] == "walls":
            x = positions[:, axis]
            assert min((x - low).min(), (high - x).min()) > 0.25 * spacing


@pytest.mark.parametrize("sides", ["channel", "cavity"])
def test_relaxed_particles_stay_between_the_walls(sides: str) -> None:
    for seed in range(3):
        x = placed("relaxed", sides, 10, seed)[0]
        inside = (x > (1, -1)) & (x < (5, 1))
        assert all(inside[:, axis].all() for axis in range(2) if BOXES[sides][axis] == "walls")


def test_relaxed_particles_are_on_no_lattice() -> None:
    positions, spacing = placed("relaxed")
    off = np.abs((positions[:, 1] + 1) / spacing % 1 - 0.5)
    assert np.mean(off) > 0.05


def test_a_seed_gives_the_same_particles_each_time() -> None:
    np.testing.assert_array_equal(placed("relaxed")[0], placed.__wrapped__("relaxed")[0])


def test_another_seed_gives_other_particles() -> None:
    assert np.abs(placed("relaxed", seed=0)[0] - placed("relaxed", seed=1)[0]).max() > 0.1 * 0.2
