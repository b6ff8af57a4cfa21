"""The lattice: its nodes, how far inside they lie, and its jitter."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from sphear.cases.lattice import lattice
from sphear.errors import SphearError


def nodes(intervals: int, dimension: int, layers: int) -> list[tuple[int, ...]]:
    """All nodes, the last axis running fastest."""
    return list(product(range(-layers, intervals + layers + 1), repeat=dimension))


@pytest.mark.parametrize("layers", [0, 2])
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_without_jitter_the_particles_are_at_the_nodes(dimension: int, layers: int) -> None:
    grid = lattice(5, dimension, layers=layers)
    np.testing.assert_allclose(grid.positions, np.array(nodes(5, dimension, layers)) / 5, rtol=0, atol=1e-15)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_inside_is_the_distance_to_the_nearest_edge_in_intervals(dimension: int) -> None:
    grid = lattice(4, dimension, layers=3, jitter=0.5)
    expected = [min(min(i, 4 - i) for i in node) for node in nodes(4, dimension, 3)]
    assert grid.inside.tolist() == expected


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_the_volumes_of_all_cells_fill_the_square(dimension: int) -> None:
    grid = lattice(8, dimension)
    assert grid.spacing == pytest.approx(1 / 8)
    assert grid.volume * 8**dimension == pytest.approx(1.0)


def test_jitter_is_uniform_from_minus_to_plus_half_its_amplitude() -> None:
    moved = 100 * (lattice(100, 2, jitter=0.4, seed=3).positions - lattice(100, 2).positions).ravel()
    shares, _ = np.histogram(moved, bins=8, range=(-0.2, 0.2))
    assert shares.sum() == moved.size
    assert np.abs(shares / moved.size - 1 / 8).max() < 0.01


def test_jitter_moves_the_axes_independently() -> None:
    moved = lattice(100, 3, jitter=1.0).positions[:10_000] - lattice(100, 3).positions[:10_000]
    assert np.abs(np.corrcoef(moved.T) - np.eye(3)).max() < 0.05


def test_the_same_seed_gives_the_same_particles() -> None:
    one, other = (lattice(6, 2, jitter=0.3, seed=11).positions for _ in range(2))
    assert (one == other).all()


def test_another_seed_moves_every_particle_elsewhere() -> None:
    one, other = (lattice(6, 2, jitter=0.3, seed=seed).positions for seed in (0, 1))
    assert (one != other).any(axis=1).all()


@pytest.mark.parametrize("intervals", [0, -3])
def test_a_lattice_needs_an_interval(intervals: int) -> None:
    with pytest.raises(SphearError, match=f"at least 1 interval, not {intervals}"):
        lattice(intervals, 2)


@pytest.mark.parametrize("jitter", [-0.1, 1.001, float("nan"), float("inf")])
def test_a_jitter_beyond_one_spacing_is_refused(jitter: float) -> None:
    with pytest.raises(SphearError, match=f"from 0 to 1 spacings.* not {jitter}"):
        lattice(4, 2, jitter=jitter)


@pytest.mark.parametrize(("intervals", "dimension"), [(50_000, 2), (1300, 3), (10**30, 2)])
def test_more_particles_than_can_be_counted_are_refused_before_memory_is_asked_for(
    intervals: int, dimension: int
) -> None:
    with pytest.raises(SphearError, match=f"{intervals} intervals a side.* too many"):
        lattice(intervals, dimension)
