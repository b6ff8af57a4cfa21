"""The matrix of the pressure equation by its pair list against dense arithmetic."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csr_array, random_array

from sphear.neighbours import Chunk
from sphear.pressure.pair_rows import PairRows, WallRows
from sphear.pressure.rows import CompressedRows

Array = np.ndarray[Any, Any]


def dense(weights: Array, mirrored: Array | None, jump: Array, fixed: Array, unknowns: int) -> tuple[Array, Array]:
    """w (p_j - p_i) with p_w = M p + jump; a wall without fluid before it is left out, fixed pressures are zero."""
    rows = len(weights)
    fluid, walls = weights[:, :unknowns], weights[:, unknowns:]
    if mirrored is None:
        walls = np.zeros_like(walls)
        mirrored, jump = np.zeros((walls.shape[1], unknowns)), np.zeros(walls.shape[1])
    walls = np.where((mirrored != 0).any(axis=1), walls, 0.0)
    matrix = fluid + walls @ mirrored
    matrix[np.arange(rows), np.arange(rows)] -= fluid.sum(axis=1) + walls.sum(axis=1)
    jump_terms = walls @ jump
    matrix[:, fixed] = np.where(np.eye(rows, unknowns, dtype=bool)[:, fixed], matrix[:, fixed], 0.0)
    for row in np.flatnonzero(fixed[:rows]):
        diagonal = -fluid[row].sum() - walls[row].sum()
        matrix[row], jump_terms[row] = 0.0, 0.0
        matrix[row, row] = diagonal if diagonal < 0 else -1.0
    return matrix, jump_terms


def narrow(matrix: Any) -> csr_array:
    """As compressed rows with 32-bit indices."""
    rows = csr_array(matrix)
    rows.indices, rows.indptr = rows.indices.astype(np.int32), rows.indptr.astype(np.int32)
    return rows


def paired(weights: csr_array, mirrored: csr_array | None, jump: Array, fixed: Array, parts: int = 1) -> PairRows:
    """The rows of weights whose columns are the entries of the pair list, on as many threads as it has parts."""
    ends = np.linspace(0, weights.shape[0], parts + 1).astype(int)
    chunks, numbers = [], []
    for begin, end in pairwise(ends.tolist()):
        first = weights.indptr[begin : end + 1].astype(np.int64)
        chunks.append(Chunk(begin, end, first - first[0], weights.indices[first[0] : first[-1]].copy()))
        numbers.append(weights.data[first[0] : first[-1]].astype(np.float64))
    unknown = np.arange(weights.shape[1], dtype=np.int32)
    if mirrored is None:
        behind = weights.shape[1] - len(fixed)
        walls, jump = WallRows(np.zeros(behind + 1), np.zeros(0), np.zeros(0)), np.zeros(behind)
    else:
        walls = WallRows(mirrored.indptr, mirrored.indices, mirrored.data)
    return PairRows(chunks, numbers, unknown, walls, jump, fixed, np.zeros(weights.shape[0]), threads=parts)


def draw(seed: int, unknowns: int, walls: int, share: float) -> tuple[csr_array, csr_array, Array, Array]:
    generator = np.random.default_rng(seed)
    weights = random_array((unknowns, unknowns + walls), density=0.3, rng=generator).tolil()
    weights.setdiag(0.0)
    mirrored = random_array((walls, unknowns), density=0.2, rng=generator)
    rows = narrow(weights)
    rows.eliminate_zeros()
    return rows, narrow(mirrored), generator.random(walls), generator.random(unknowns) < share


@given(
    seed=st.integers(0, 999),
    unknowns=st.integers(2, 25),
    walls=st.integers(1, 15),
    share=st.sampled_from([0.0, 0.3, 1.0]),
    natural=st.booleans(),
)
def test_it_is_what_dense_arithmetic_gives(seed: int, unknowns: int, walls: int, share: float, natural: bool) -> None:
    weights, mirrored, jump, fixed = draw(seed, unknowns, walls, share)
    rows = paired(weights, None if natural else mirrored, jump, fixed)
    given_jump = np.zeros(0) if natural else jump
    expected, right = dense(weights.toarray(), None if natural else mirrored.toarray(), given_jump, fixed, unknowns)
    np.testing.assert_allclose(rows.assembled().toarray(), expected, rtol=0, atol=1e-12)
    np.testing.assert_allclose(rows.jump_terms, right, rtol=0, atol=1e-12)
    np.testing.assert_allclose(rows.diagonal(), expected.diagonal(), rtol=0, atol=1e-12)
    vector = np.random.default_rng(seed).random(unknowns)
    np.testing.assert_allclose(rows.times(vector), expected @ vector, rtol=0, atol=1e-12)


def test_the_numbers_are_the_same_on_any_number_of_threads() -> None:
    weights, mirrored, jump, fixed = draw(3, 20, 10, 0.2)
    one, three = paired(weights, mirrored, jump, fixed), paired(weights, mirrored, jump, fixed, 3)
    vector = np.random.default_rng(1).random(20)
    np.testing.assert_array_equal(one.times(vector), three.times(vector))
    np.testing.assert_array_equal(one.diagonal(), three.diagonal())
    np.testing.assert_array_equal(one.jump_terms, three.jump_terms)


@given(seed=st.integers(0, 99), step=st.integers(1, 9))
def test_faults_and_coefficient_are_those_of_the_assembled_matrix(seed: int, step: int) -> None:
    weights, mirrored, jump, fixed = draw(seed, 20, 10, 0.0)
    total = np.asarray(mirrored.sum(axis=1))
    shares = narrow(mirrored.toarray() / np.where(total > 0, total, 1.0)[:, None])
    rows = paired(weights, shares, jump, fixed, 2)
    positions, periods = np.random.default_rng(seed).random((20, 2)), np.array([0.0, 1.0])
    whole = CompressedRows(rows.assembled())
    assert rows.coefficient(positions, periods, step) == pytest.approx(whole.coefficient(positions, periods, step))
    for singular in (True, False):
        assert rows.first_fault(singular) == whole.first_fault(singular)


@pytest.mark.parametrize("walls", [1, 40])
def test_walls_may_see_much_fluid(walls: int) -> None:
    """Each row has one neighbour behind a wall, which stands for all the fluid: far more than the pair list has."""
    unknowns = 60
    places = np.arange(unknowns), unknowns + np.arange(unknowns) % walls
    behind = narrow(csr_array((np.ones(unknowns), places), shape=(unknowns, unknowns + walls)))
    mirrored = narrow(np.random.default_rng(0).random((walls, unknowns)) * 0.8 + 0.1)
    jump, fixed = np.arange(walls, dtype=float), np.zeros(unknowns, bool)
    rows = paired(behind, mirrored, jump, fixed)
    matrix, jump_terms = rows.assembled(), rows.jump_terms
    expected, right = dense(behind.toarray(), mirrored.toarray(), jump, fixed, unknowns)
    assert matrix.nnz == unknowns**2
    np.testing.assert_allclose(matrix.toarray(), expected, atol=1e-12)
    np.testing.assert_allclose(jump_terms, right, atol=1e-12)


def test_rows_sum_to_zero_where_walls_continue_a_constant() -> None:
    weights, mirrored, jump, fixed = draw(5, 25, 12, 0.0)
    total = np.asarray(mirrored.sum(axis=1))
    shares = narrow(mirrored.toarray() / np.where(total > 0, total, 1.0)[:, None])
    matrix = paired(weights, shares, jump, fixed).assembled()
    np.testing.assert_allclose(matrix.sum(axis=1), 0.0, atol=1e-13)


def test_a_wall_whose_fluid_weighs_nothing_is_left_out() -> None:
    """As where a particle is only just within the support of a kernel: rows must sum to zero all the same."""
    weights = narrow(np.array([[0.0, 2.0, 3.0], [2.0, 0.0, 4.0]]))
    mirrored = csr_array((np.zeros(1), np.zeros(1, np.int32), np.array([0, 1], np.int32)), shape=(1, 2))
    rows = paired(weights, mirrored, np.array([5.0]), np.zeros(2, bool))
    matrix, jump_terms = rows.assembled(), rows.jump_terms
    np.testing.assert_array_equal(matrix.toarray(), [[-2.0, 2.0], [2.0, -2.0]])
    assert not jump_terms.any()


def test_a_row_that_walls_would_give_a_positive_diagonal_is_without_them() -> None:
    """As in a narrow corner, whose mirrored pressures are mostly the particle's own; other rows keep theirs."""
    weights = narrow(np.array([[0.0, 2.0, 3.0], [2.0, 0.0, 3.0]]))
    mirrored = narrow(np.array([[1.9, -0.9]]))
    rows = paired(weights, mirrored, np.array([5.0]), np.zeros(2, bool))
    matrix, jump_terms = rows.assembled(), rows.jump_terms
    np.testing.assert_allclose(matrix.toarray(), [[-2.0, 2.0], [2.0 + 3.0 * 1.9, -5.0 - 3.0 * 0.9]], atol=1e-14)
    np.testing.assert_array_equal(jump_terms, [0.0, 15.0])


def test_a_fixed_particle_that_is_alone_keeps_a_diagonal() -> None:
    nothing = csr_array((np.zeros(0), np.zeros(0, np.int32), np.zeros(3, np.int32)), shape=(2, 2))
    rows = paired(nothing, None, np.zeros(0), np.array([True, True]))
    matrix, jump_terms = rows.assembled(), rows.jump_terms
    np.testing.assert_array_equal(matrix.toarray(), [[-1.0, 0.0], [0.0, -1.0]])
    assert not jump_terms.any()
