"""Sums for the first particles only: the others are their neighbours and nothing else."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sphear import Neighbours, WendlandC2
from sphear.algebra import scale
from sphear.engine.formula import Sum
from sphear.engine.sweep import sweep
from sphear.errors import SphearError
from sphear.neighbours.sparse import sparse_rows
from tests.particles import Array, all_pairs, box, jittered, summed

KERNEL = WendlandC2(1.2)
COUNTS = (9, 8)


@dataclass(frozen=True)
class Flux(Sum):
    """Something of both particles."""

    def pair(self, own: Any, other: Any, d: Any, r2: Any) -> Any:
        return scale(own.charge * other.charge * KERNEL.value(r2, len(d)), d)


def flux(positions: Array, charge: Array, neighbours: Neighbours) -> Array:
    """The sums of each particle that sums are made for, in the order of the particles."""
    return sweep(Flux(), neighbours, charge=charge)


@given(count=st.integers(1, 72), seed=st.integers(0, 99), periodic=st.booleans(), threads=st.sampled_from([1, 2]))
def test_sums_of_the_first_particles(count: int, seed: int, periodic: bool, threads: int) -> None:
    positions = jittered(COUNTS, 0.8, seed)
    positions = positions[np.random.default_rng(seed).permutation(len(positions))]
    charge = np.random.default_rng(seed + 1).random(len(positions))
    domain = box(COUNTS) if periodic else None
    neighbours = Neighbours(positions, KERNEL.radius, domain, threads=threads, rows=count)
    i, j, d = all_pairs(positions, KERNEL.radius, domain)
    far = 1.0 - np.sqrt((d**2).sum(axis=1)) / (2.0 * KERNEL.h)
    weight = 7.0 / (4.0 * np.pi * KERNEL.h**2) * far**4 * (1.0 + 4.0 * (1.0 - far))
    expected = summed(i, (charge[i] * charge[j] * weight)[:, None] * d, len(positions))[:count]
    assert neighbours.count == len(neighbours.rows) == count
    assert sorted(neighbours.rows) == list(range(count))
    assert neighbours.pairs == int((i < count).sum())
    np.testing.assert_allclose(flux(positions, charge, neighbours), expected, rtol=0, atol=1e-13)


def test_others_may_lie_at_one_place_and_those_summed_for_may_not() -> None:
    """Wall particles of two walls may meet in a corner: nothing is summed for them."""
    positions = jittered((5, 5), 0.2, seed=0)
    doubled = np.concatenate((positions, [[9.0, 9.0], [9.0, 9.0]]))
    assert Neighbours(doubled, 2.0, rows=25).count == 25
    with pytest.raises(SphearError, match="particles 25 and 26 are at the same place"):
        Neighbours(doubled, 2.0)
    with pytest.raises(SphearError, match="particles 3 and 25 are at the same place"):
        Neighbours(np.concatenate((positions, positions[3:4])), 2.0, rows=25)


@pytest.mark.parametrize("rows", [None, 20])
@pytest.mark.parametrize("threads", [1, 2])
def test_the_list_as_a_sparse_matrix(rows: int | None, threads: int) -> None:
    positions = jittered(COUNTS, 0.5, seed=4)
    neighbours = Neighbours(positions, KERNEL.radius, box(COUNTS), threads=threads, rows=rows)
    weights = [np.ones(chunk.pairs) for chunk in neighbours.chunks]
    ones = sparse_rows(neighbours.chunks, weights, neighbours.source, len(positions))
    assert ones.shape == (neighbours.count, len(positions))
    i, j, _ = all_pairs(positions, KERNEL.radius, box(COUNTS))
    expected = np.zeros((len(positions), len(positions)))
    np.add.at(expected, (i, j), 1.0)
    np.testing.assert_array_equal(ones.toarray(), expected[neighbours.rows])
