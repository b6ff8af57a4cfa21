"""Weights kept pair by pair against the sums that are made of them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear import Domain, Neighbours, WendlandC2
from sphear.corrections import NoCorrection
from sphear.engine.weights import chunk_weights
from sphear.interactions import Laplacian
from sphear.interactions.laplacian_weights import LaplacianWeights
from sphear.neighbours.sparse import sparse_rows
from sphear.schemes.incompressible.particle_sums import ParticleSums
from sphear.viscosity import VISCOSITY
from sphear.viscosity.morris import Morris
from tests.pair_matrix import pair_matrix
from tests.particles import Array, all_pairs, box, jittered

KERNEL = WendlandC2(1.57)
COUNTS = {1: (40,), 2: (13, 12), 3: (7, 6, 6)}
# compiling a formula takes long: a term that is prepared in each dimension, the others in the plane
TERMS = [("morris", 1), ("oger", 1), ("fatehi_manzari", 2), ("oger", 2), ("morris", 2), ("morris", 3), ("oger", 3)]


def places(dimension: int, threads: int = 1, count: int | None = None, periodic: bool = True) -> ParticleSums:
    """Jittered particles of different volumes; sums are made for the first `count`."""
    positions = jittered(COUNTS[dimension], 0.4, seed=dimension)
    volume = np.random.default_rng(5).uniform(0.8, 1.2, len(positions))
    domain = box(COUNTS[dimension]) if periodic else None
    return ParticleSums(positions, count or len(positions), KERNEL, volume, domain, threads)


def field(places: ParticleSums, components: int = 1) -> Array:
    return np.random.default_rng(6).random((places.total, components))


def matrix(term: Any, where: ParticleSums) -> Any:
    """Row k is of particle `neighbours.rows[k]`."""
    weights = LaplacianWeights(term, KERNEL, NoCorrection())
    return pair_matrix(where, weights, term.preparation(KERNEL, NoCorrection()))


def laplacian(term: Any, where: ParticleSums, values: Array) -> Array:
    sweep = Laplacian(term, KERNEL, NoCorrection())
    return where.sum(sweep, term.preparation(KERNEL, NoCorrection()), values=values)


@pytest.mark.parametrize(("name", "dimension"), TERMS)
@pytest.mark.parametrize("threads", [1, 2])
def test_weights_times_differences_are_the_sweep(name: str, dimension: int, threads: int) -> None:
    term, where = VISCOSITY[name], places(dimension, threads)
    assert len(where.neighbours.chunks) == (1 if threads == 1 else 4)
    values = field(where)
    rows, listed = matrix(term, where), where.neighbours.rows
    total = np.asarray(rows.sum(axis=1))
    found = rows @ values[:, 0] - total * values[listed, 0]
    swept = laplacian(term, where, values)[listed, 0]
    np.testing.assert_allclose(found, swept, rtol=0, atol=1e-12 * abs(rows).sum(axis=1).max())


@pytest.mark.parametrize("name", ["morris", "fatehi_manzari", "oger"])
@pytest.mark.parametrize(("count", "periodic"), [(40, True), (155, False), (1, True)])
def test_weights_of_the_first_particles_only(name: str, count: int, periodic: bool) -> None:
    term = VISCOSITY[name]
    some, everywhere = places(2, count=count, periodic=periodic), places(2, periodic=periodic)
    assert sorted(some.neighbours.rows) == list(range(count))
    part, whole = matrix(term, some), matrix(term, everywhere)
    assert part.shape == (count, everywhere.total)
    in_order = whole[np.argsort(everywhere.neighbours.rows)].toarray()
    np.testing.assert_allclose(part.toarray(), in_order[some.neighbours.rows], rtol=1e-12, atol=1e-14)


def test_weights_of_morris_by_hand() -> None:
    """w = -2 W'/r, W' of Wendland's function in the plane, added up over the images of a neighbour."""
    where = places(2)
    i, j, d = all_pairs(where.positions, KERNEL.radius, box(COUNTS[2]))
    far = 1.0 - np.sqrt((d**2).sum(axis=1)) / (2.0 * KERNEL.h)
    expected = np.zeros((where.total, where.total))
    volume = where.fields["volume"]
    np.add.at(expected, (i, j), volume[j] * 2.0 * 5.0 * 7.0 / (4.0 * np.pi) / KERNEL.h**4 * far**3)
    found = matrix(VISCOSITY["morris"], where).toarray()
    np.testing.assert_allclose(found, expected[where.neighbours.rows], rtol=1e-10, atol=1e-13)


def test_weights_come_in_the_order_of_the_list() -> None:
    """Also where the number of neighbours is no multiple of those taken at once."""
    positions = jittered((9, 9), 0.5, seed=3)
    neighbours = Neighbours(positions, KERNEL.radius, threads=2)
    fields = {"volume": np.ones(len(positions))}
    found = chunk_weights(LaplacianWeights(Morris(), KERNEL, NoCorrection()), neighbours, fields)
    assert np.concatenate(found, axis=1).shape == (1, neighbours.pairs)
    rows = sparse_rows(neighbours.chunks, [part[0] for part in found], neighbours.source, len(positions))
    i, j, d = all_pairs(positions, KERNEL.radius)
    assert rows.nnz == len(i)
    far = 1.0 - np.sqrt((d**2).sum(axis=1)) / (2.0 * KERNEL.h)
    expected = np.zeros((len(positions), len(positions)))
    expected[i, j] = 35.0 / (2.0 * np.pi) / KERNEL.h**4 * far**3
    np.testing.assert_allclose(rows.toarray(), expected[neighbours.rows], rtol=0, atol=1e-12)


def test_a_particle_that_is_alone_has_an_empty_row() -> None:
    positions = np.array([[0.0, 0.0], [100.0, 0.0], [1.0, 0.5]])
    where = ParticleSums(positions, 3, KERNEL, np.ones(3), None, 1)
    rows = matrix(VISCOSITY["morris"], where)
    lengths = dict(zip(where.neighbours.rows.tolist(), np.diff(rows.indptr).tolist(), strict=True))
    assert lengths == {0: 1, 1: 0, 2: 1}


def test_columns_may_be_renamed() -> None:
    where = places(2, count=50)
    column = np.random.default_rng(1).permutation(where.total).astype(np.int32)
    term = Morris()
    plain = matrix(term, where).toarray()
    weights = LaplacianWeights(term, KERNEL, NoCorrection())
    renamed = pair_matrix(where, weights, None, column, where.total + 3).toarray()
    assert renamed.shape == (50, where.total + 3)
    np.testing.assert_array_equal(renamed[:, column], plain)
    assert not renamed[:, where.total :].any()


def test_points_without_volume_see_particles_at_their_own_place() -> None:
    positions = jittered((6, 6), 0.3, seed=2)
    both = np.concatenate((positions[:1], positions))
    domain = Domain((0.0, 0.0), (6.0, 6.0), False)
    neighbours = Neighbours(both, KERNEL.radius, domain, rows=1, keep_coincident=True)
    nearest = neighbours.chunks[0].neighbour[: neighbours.pairs]
    assert 1 in neighbours.source[nearest]
