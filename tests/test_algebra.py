"""The algebra of formulas against numpy.linalg, on floats and on arrays."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from sphear import algebra

numbers = st.floats(-10.0, 10.0, allow_subnormal=False)
sizes = st.integers(1, 3)


def matrices(rows: int, columns: int) -> st.SearchStrategy[tuple[tuple[float, ...], ...]]:
    return st.tuples(*[st.tuples(*[numbers] * columns)] * rows)


squares = sizes.flatmap(lambda n: matrices(n, n))
pairs_of_squares = sizes.flatmap(lambda n: st.tuples(matrices(n, n), matrices(n, n)))
pairs_of_vectors = sizes.flatmap(lambda n: st.tuples(*[st.tuples(*[numbers] * n)] * 2))


def close(ours: Any, theirs: Any) -> None:
    np.testing.assert_allclose(ours, theirs, rtol=1e-12, atol=1e-11 * max(1.0, float(np.abs(theirs).max())))


@given(pairs_of_vectors, numbers)
def test_vectors(vectors: Any, factor: float) -> None:
    a, b = vectors
    close(algebra.add(a, b), np.add(a, b))
    close(algebra.subtract(a, b), np.subtract(a, b))
    close(algebra.scale(factor, a), factor * np.array(a))
    close(algebra.dot(a, b), np.dot(a, b))
    close(algebra.outer(a, b), np.outer(a, b))


@given(pairs_of_squares, numbers, numbers)
def test_matrices(both: Any, s: float, t: float) -> None:
    a, b = both
    close(algebra.multiply(a, b), np.array(a) @ np.array(b))
    close(algebra.apply(a, b[0]), np.array(a) @ np.array(b[0]))
    close(algebra.transpose(a), np.transpose(a))
    close(algebra.trace(a), np.trace(a))
    close(algebra.combine(s, a, t, b), s * np.array(a) + t * np.array(b))


@given(matrices(2, 3), matrices(3, 2))
def test_matrices_that_are_not_square(a: Any, b: Any) -> None:
    close(algebra.multiply(a, b), np.array(a) @ np.array(b))
    close(algebra.transpose(a), np.transpose(a))


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_identity(dimension: int) -> None:
    assert algebra.identity(dimension) == tuple(map(tuple, np.eye(dimension).tolist()))


@given(squares)
def test_determinant(a: Any) -> None:
    assert algebra.determinant(a) == pytest.approx(np.linalg.det(a), rel=1e-10, abs=1e-10)


@given(squares)
def test_adjugate_is_the_inverse_before_its_division(a: Any) -> None:
    expected = algebra.determinant(a) * np.eye(len(a))
    np.testing.assert_allclose(np.array(a) @ algebra.adjugate(a), expected, atol=1e-10)
    np.testing.assert_allclose(np.array(algebra.adjugate(a)) @ a, expected, atol=1e-10)


def test_adjugate_of_a_singular_matrix_is_finite() -> None:
    close(algebra.adjugate(((1.0, 2.0), (2.0, 4.0))), [[4.0, -2.0], [-2.0, 1.0]])


systems = st.integers(1, 6).flatmap(lambda n: st.tuples(matrices(n, n), st.tuples(*[numbers] * n)))


@given(systems)
def test_solve(system: Any) -> None:
    a, right = system
    assume(np.linalg.cond(a) < 1e6)
    pivot, x = algebra.solve(a, right)
    expected = np.linalg.solve(a, right)
    np.testing.assert_allclose(x, expected, rtol=1e-6, atol=1e-8 * max(1.0, np.abs(expected).max()))
    assert 0.0 < pivot <= np.abs(a).max() * 2.0 ** (len(right) - 1) + 1e-9


def test_rows_are_exchanged_where_a_pivot_is_zero() -> None:
    pivot, x = algebra.solve(((0.0, 2.0, 0.0), (4.0, 0.0, 1.0), (0.0, 0.0, -8.0)), (2.0, 5.0, -8.0))
    assert pivot == 2.0
    assert x == (1.0, 1.0, 1.0)


@pytest.mark.parametrize("a", [((1.0, 2.0), (2.0, 4.0)), ((0.0, 0.0), (0.0, 0.0)), ((0.0, 1.0), (0.0, 1.0))])
def test_the_smallest_pivot_of_a_singular_matrix_is_zero_and_nothing_overflows(a: Any) -> None:
    pivot, x = algebra.solve(a, (1.0, 1.0))
    assert pivot == 0.0
    assert all(map(math.isfinite, x))


@given(numbers, numbers, numbers, numbers)
def test_elementary_functions_are_the_same_on_floats_and_on_arrays(a: float, b: float, yes: float, no: float) -> None:
    array = np.array([a, b])
    assert algebra.where_less(a, b, yes, no) == (yes if a < b else no)
    assert algebra.positive_part(a) == max(a, 0.0)
    assert algebra.exp(a) == math.exp(a)
    assert algebra.sqrt(abs(a)) == math.sqrt(abs(a))
    np.testing.assert_array_equal(algebra.where_less(array, b, yes, no), [no if x >= b else yes for x in array])
    np.testing.assert_array_equal(algebra.positive_part(array), [max(x, 0.0) for x in array])
    np.testing.assert_allclose(algebra.exp(array), [math.exp(x) for x in array], rtol=1e-15)
    np.testing.assert_allclose(algebra.sqrt(abs(array)), [math.sqrt(abs(x)) for x in array], rtol=1e-15)


def test_elementary_functions_have_names_and_docstrings() -> None:
    for name in ("sqrt", "exp", "positive_part", "where_less"):
        function = getattr(algebra, name)
        assert function.__name__ == name
        assert function.__doc__


def test_vectors_of_different_lengths_are_refused() -> None:
    for function in (algebra.add, algebra.subtract, algebra.dot):
        with pytest.raises(ValueError, match="zip"):
            function((1.0,), (1.0, 2.0))
