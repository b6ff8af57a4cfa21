"""Neighbours against SciPy's trees, in clusters, with outliers, in periodic boxes, and what is refused."""

from __future__ import annotations

import re
from itertools import product
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from sphear import Domain, Neighbours, SphearError
from sphear.neighbours.cell_sort import cell_sort
from tests.particles import Array, jittered, lattice

SUPPORT = 1.3
Pairs = list[tuple[int, int]]


def listed(neighbours: Neighbours) -> Pairs:
    """(i, j) of every listed pair, sorted; j once for each image."""
    pairs: Pairs = []
    for chunk in neighbours.chunks:
        for row, particle in enumerate(neighbours.particles(chunk)):
            entries = chunk.neighbour[chunk.first[row] : chunk.first[row + 1]]
            pairs += [(int(particle), int(j)) for j in neighbours.source[entries]]
    return sorted(pairs)


def by_tree(positions: Array, support: float, domain: Domain | None = None) -> Pairs:
    """The same pairs from SciPy, with all images in a box of three periods (or nine) an axis."""
    reach = 4 if domain and min(np.subtract(domain.upper, domain.lower)) < support else 1
    periods: Any = np.zeros(positions.shape[1]) if domain is None else np.subtract(domain.upper, domain.lower)
    axes = () if domain is None else domain.periodic_axes
    steps = [range(-reach, reach + 1) if axis in axes else range(1) for axis in range(positions.shape[1])]
    # the particles themselves first
    images = np.concatenate([positions + np.multiply(shift, periods) for shift in sorted(product(*steps), key=any)])
    near: Any = cKDTree(images).query_ball_point(positions, support * (1 - 1e-12))
    return sorted((i, j % len(positions)) for i, found in enumerate(near) for j in found if j != i)


def wrapped(positions: Array, domain: Domain) -> Array:
    low, period = np.array(domain.lower), np.subtract(domain.upper, domain.lower)
    return np.where(domain.periodic, low + (positions - low) % period, positions)


@given(st.integers(1, 3), st.integers(1, 150), st.floats(0.05, 0.8), st.integers(0, 10_000))
def test_pairs_are_those_of_a_tree(dimension: int, count: int, relative: float, seed: int) -> None:
    positions = np.random.default_rng(seed).random((count, dimension)) * 5.0 - 2.0
    assert listed(Neighbours(positions, 5.0 * relative)) == by_tree(positions, 5.0 * relative)


@given(st.integers(1, 3), st.integers(1, 60), st.floats(0.2, 3.0), st.integers(0, 10_000), st.data())
def test_pairs_in_periodic_boxes_are_those_of_a_tree_of_images(
    dimension: int, count: int, support: float, seed: int, data: st.DataObject
) -> None:
    flags = data.draw(st.tuples(*[st.booleans()] * dimension))
    generator = np.random.default_rng(seed)
    domain = Domain((-1.0,) * dimension, tuple(-1.0 + generator.uniform(0.9, 3.0, dimension)), flags)
    # several periods away, and to be wrapped
    positions = generator.uniform(-3.0, 4.0, (count, dimension))
    inside = wrapped(positions, domain)
    assert listed(Neighbours(positions, support, domain)) == by_tree(inside, support, domain)


@pytest.mark.parametrize("threads", [1, 2, 7])
def test_chunks_cover_every_row_once(threads: int) -> None:
    positions = jittered((9, 9), 0.5, seed=0)
    neighbours = Neighbours(positions, SUPPORT, threads=threads)
    assert len(neighbours.chunks) % threads == 0
    assert sorted(i for chunk in neighbours.chunks for i in neighbours.particles(chunk)) == list(range(81))
    pairs = by_tree(positions, SUPPORT)
    assert listed(neighbours) == pairs
    assert neighbours.pairs == len(pairs)


def test_more_threads_than_particles() -> None:
    assert listed(Neighbours(lattice((2, 1)), 1.5, threads=5)) == [(0, 1), (1, 0)]


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_a_single_particle_has_no_neighbours(dimension: int) -> None:
    assert Neighbours(np.zeros((1, dimension)), 1.0).pairs == 0


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_a_single_particle_in_a_small_box_has_its_own_images(dimension: int) -> None:
    domain = Domain((0.0,) * dimension, (1.0,) * dimension)
    neighbours = Neighbours(np.full((1, dimension), 0.5), 1.1, domain)
    assert listed(neighbours) == [(0, 0)] * 2 * dimension


@pytest.mark.parametrize("distance", [1.0, np.nextafter(1.0, 0.0)])
def test_particles_at_the_support_are_not_neighbours_but_just_within_are(distance: float) -> None:
    assert Neighbours(np.array([[0.0], [distance]]), 1.0).pairs == (0 if distance == 1.0 else 2)


@pytest.mark.parametrize("dimension", [2, 3])
def test_the_pair_list_grows_where_density_is_very_uneven(dimension: int) -> None:
    """A guess from the mean density would hold a hundredth of the pairs of a crowd of particles in one place."""
    generator = np.random.default_rng(2)
    crowd = 0.2 * generator.random((400, dimension))
    positions = np.concatenate((jittered((12,) * dimension, 0.8, seed=1, dx=0.9), crowd))
    assert listed(Neighbours(positions, 1.0)) == by_tree(positions, 1.0)


@pytest.mark.parametrize("far", [1e3, 1e9, 1e200])
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_a_far_outlier_costs_no_memory(dimension: int, far: float) -> None:
    positions = np.concatenate((jittered((4,) * dimension, 0.5, seed=4), np.full((1, dimension), far)))
    cells = cell_sort(positions, SUPPORT)
    assert len(cells.start) < 8 * len(positions) + 1010
    inner = by_tree(positions[:-1], SUPPORT)
    assert listed(Neighbours(positions, SUPPORT)) == inner


@given(st.floats(1e-9, 1e9), st.floats(-1e3, 1e3))
def test_the_unit_of_length_and_the_origin_do_not_matter(unit: float, origin: float) -> None:
    positions = jittered((6, 6), 0.4, seed=6)
    expected = listed(Neighbours(positions, SUPPORT))
    assert listed(Neighbours((positions + origin) * unit, SUPPORT * unit)) == expected


def test_particles_outside_a_periodic_box_count_as_inside() -> None:
    domain = Domain((0.0, 0.0), (4.0, 4.0), (True, False))
    moved = lattice((4, 4))
    expected = listed(Neighbours(moved, SUPPORT, domain))
    moved[::3, 0] += 40.0
    moved[1::3, 0] -= 8.0
    assert listed(Neighbours(moved, SUPPORT, domain)) == expected


def test_a_particle_just_below_a_periodic_edge_stays_in_the_box() -> None:
    """-1e-20 modulo 4 rounds to 4: outside, and at the same place as a particle at 0."""
    domain = Domain((0.0,), (4.0,))
    inside = domain.wrapped(np.array([[-1e-20], [4.0], [-4.0], [8.5], [-0.5]]))
    np.testing.assert_allclose(inside[:, 0] % 4.0, [0.0, 0.0, 0.0, 0.5, 3.5], atol=1e-15)
    assert listed(Neighbours(np.array([[-1e-20], [1.0], [2.0], [3.0]]), SUPPORT, domain)) == sorted(
        (i, (i + step) % 4) for i in range(4) for step in (1, -1)
    )


@pytest.mark.parametrize("threads", [1, 3])
@pytest.mark.parametrize("apart", [0.0, 1e-12])
@pytest.mark.parametrize(("first", "second"), [(0, 1), (3, 30), (48, 20)])
def test_coincident_particles_are_refused_by_name(first: int, second: int, apart: float, threads: int) -> None:
    positions = jittered((7, 7), 0.3, seed=8)
    positions[second] = positions[first] + apart
    a, b = sorted((first, second))
    with pytest.raises(SphearError, match=rf"^particles {a} and {b} are at the same place \(.*\): .*must be apart$"):
        Neighbours(positions, SUPPORT, threads=threads)


def test_particles_that_coincide_across_a_periodic_edge_are_refused() -> None:
    with pytest.raises(SphearError, match=r"^particles 0 and 2 are at the same place"):
        Neighbours(np.array([[0.0, 0.5], [1.0, 0.5], [2.0, 0.5]]), 0.9, Domain((0.0, 0.0), (2.0, 2.0)))


def test_coincident_particles_are_listed_where_they_are_wanted() -> None:
    neighbours = Neighbours(np.array([[0.0], [0.0], [1.0]]), 0.5, keep_coincident=True)
    assert (0, 1) in listed(neighbours)
    assert (1, 0) in listed(neighbours)


def test_three_particles_in_one_place_are_refused() -> None:
    with pytest.raises(SphearError, match=r"^particles \d and \d are at the same place \(1, 1\)"):
        Neighbours(np.array([[1.0, 1.0], [0.0, 0.0], [1.0, 1.0], [1.0, 1.0]]), 0.5)


@pytest.mark.parametrize("threads", [0, -1, 1.5, "2"])
def test_at_least_one_thread(threads: Any) -> None:
    with pytest.raises(SphearError, match=f"threads must be a whole number of at least 1, not {threads!r}"):
        Neighbours(lattice((2, 2)), 1.5, threads=threads)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (((0.0, 0.0), (1.0,)), "1 to 3 axes, not 2, 1 and 2"),
        (((0.0,), (1.0,), (True, False)), "1 to 3 axes, not 1, 1 and 2"),
        (((), ()), "1 to 3 axes, not 0, 0 and 0"),
        (((0.0,) * 4, (1.0,) * 4), "1 to 3 axes, not 4, 4 and 4"),
        (((0.0, 1.0), (1.0, 1.0)), "must extend along axis 1: 1 to 1 does not"),
        (((0.0, 0.0), (-1.0, 1.0)), "must extend along axis 0: 0 to -1 does not"),
        (((0.0,), (np.nan,)), "must extend along axis 0: 0 to nan does not"),
        (((0.0,), (np.inf,)), "must extend along axis 0: 0 to inf does not"),
        ((0.0, 1.0), "a domain needs"),
        ((("a",), ("b",)), "a domain needs"),
    ],
)
def test_a_domain_that_is_none_is_refused(arguments: Any, message: str) -> None:
    with pytest.raises(SphearError, match=re.escape(message)):
        Domain(*arguments)


def test_a_domain_takes_any_sequence_and_compares_by_value() -> None:
    domain = Domain(np.zeros(2), [1, 2], np.array([True, False]))  # type: ignore[arg-type]
    assert domain == Domain((0.0, 0.0), (1.0, 2.0), (True, False))
    assert hash(domain) == hash(Domain((0.0, 0.0), (1.0, 2.0), (True, False)))
    assert Domain((0.0, 0.0), (1.0, 2.0), np.True_).periodic_axes == (0, 1)  # type: ignore[arg-type]
    assert (domain.dimension, domain.periodic_axes) == (2, (0,))


@pytest.mark.parametrize("threads", [2, 3])
def test_entries_are_sorted_in_the_same_order_on_any_number_of_threads(threads: int) -> None:
    positions = np.random.default_rng(5).uniform(size=(13_000, 2))
    alone, shared = cell_sort(positions, 0.03), cell_sort(positions, 0.03, threads)
    for name in ("coordinates", "order", "cell", "start", "rows"):
        np.testing.assert_array_equal(getattr(shared, name), getattr(alone, name))
    assert (np.diff(alone.order[: alone.start[-1]][alone.cell == alone.cell[0]]) > 0).all()
