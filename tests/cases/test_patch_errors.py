"""The four errors of a patch test: their definitions, and what they do not depend on."""

from __future__ import annotations

from dataclasses import astuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from sphear.cases.errors import PatchErrors, patch_errors

FIELDS = arrays(np.float64, st.tuples(st.integers(1, 9), st.integers(1, 3)), elements=st.floats(1.0, 100.0))


def disturbed(exact: np.ndarray, seed: int) -> np.ndarray:
    return exact * (1 + 0.1 * np.random.default_rng(seed).standard_normal(exact.shape))


def test_each_error_is_what_it_says() -> None:
    computed, exact = np.array([[1.0], [-2.0], [7.0]]), np.array([[2.0], [-2.0], [4.0]])
    found = patch_errors(computed, exact)
    assert found.l1 == pytest.approx((1 + 0 + 3) / (2 + 2 + 4))
    assert found.l2 == pytest.approx(np.sqrt((1 + 9) / (4 + 4 + 16)))
    assert found.max == pytest.approx(3 / 4)
    assert found.paper == pytest.approx(4 / 8 / 3)


@given(FIELDS, st.integers(0, 99))
def test_the_papers_error_is_l1_divided_by_the_number_of_points_once_more(exact: np.ndarray, seed: int) -> None:
    found = patch_errors(disturbed(exact, seed), exact)
    assert found.paper * len(exact) == pytest.approx(found.l1)


@given(FIELDS, st.integers(0, 99), st.integers(-300, 300))
def test_errors_do_not_depend_on_the_unit_of_the_field(exact: np.ndarray, seed: int, power: int) -> None:
    unit = 10.0**power
    computed = disturbed(exact, seed)
    assert astuple(patch_errors(unit * computed, unit * exact)) == pytest.approx(astuple(patch_errors(computed, exact)))


@given(FIELDS, st.integers(0, 99))
def test_errors_do_not_depend_on_the_order_of_the_points(exact: np.ndarray, seed: int) -> None:
    computed = disturbed(exact, seed)
    assert astuple(patch_errors(computed[::-1], exact[::-1])) == pytest.approx(astuple(patch_errors(computed, exact)))


@given(FIELDS, st.integers(0, 99))
def test_errors_are_proportional_to_the_deviation(exact: np.ndarray, seed: int) -> None:
    deviation = disturbed(exact, seed) - exact
    once, twice = (patch_errors(exact + factor * deviation, exact) for factor in (1, 2))
    assert astuple(twice) == pytest.approx(2 * np.array(astuple(once)), rel=1e-6)


@given(FIELDS)
def test_the_exact_field_has_no_error(exact: np.ndarray) -> None:
    assert astuple(patch_errors(exact, exact)) == (0, 0, 0, 0)


@given(FIELDS, st.integers(1, 5))
def test_repeated_points_change_only_the_papers_error(exact: np.ndarray, times: int) -> None:
    computed = disturbed(exact, 0)
    once, often = patch_errors(computed, exact), patch_errors(*(np.tile(f, (times, 1)) for f in (computed, exact)))
    assert (often.l1, often.l2, often.max) == pytest.approx((once.l1, once.l2, once.max))
    assert often.paper == pytest.approx(once.paper / times)


@pytest.mark.parametrize("count", [1, 4, 100])
def test_where_the_exact_field_is_zero_errors_are_absolute_means(count: int) -> None:
    found = patch_errors(np.full((count, 2), -3.0), np.zeros((count, 2)))
    assert (found.l1, found.l2, found.max) == pytest.approx((3.0, 3.0, 3.0))


def test_the_mean_of_several_runs_is_that_of_each_error() -> None:
    assert PatchErrors.mean([PatchErrors(1, 2, 3, 4), PatchErrors(3, 6, 9, 12)]) == PatchErrors(2, 4, 6, 8)


def test_errors_are_given_by_name() -> None:
    assert PatchErrors(1, 2, 3, 4).as_dict() == {"l1": 1, "l2": 2, "max": 3, "paper": 4}
