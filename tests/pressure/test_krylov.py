from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csr_array
from scipy.sparse.linalg import cg

from sphear.pressure import Jacobi, PressureSystem
from sphear.pressure.krylov import bicgstab, conjugate_gradients, iterate, product
from sphear.pressure.vectors import dot, norm
from tests.pressure.problems import Array, box, one_sided, random_right


def small(symmetric: bool) -> PressureSystem:
    matrix = csr_array(np.array([[-3.0, 1.0], [1.0 if symmetric else 0.5, -2.0]]))
    places = np.array([[0.2, 0.5], [0.6, 0.5]])
    return PressureSystem(matrix, places, (0, 0), (1, 1), (False, False), 0.4, symmetric=symmetric, singular=False)


def turned(system: PressureSystem) -> Array:
    """What makes A M a quarter turn, in which a residual is orthogonal to its image: all divisors vanish."""
    inverse: Array = np.linalg.solve(system.matrix.toarray(), np.array([[0.0, 1.0], [-1.0, 0.0]]))
    return inverse


def test_bicgstab_that_breaks_down_is_followed_by_gmres() -> None:
    system, right = small(False), np.array([0.6, 0.8])
    inverse = turned(system)
    broken = bicgstab(product(system), right, np.zeros(2), lambda x: inverse @ x, 1e-9, 50)
    assert broken.iterations == 0
    run = iterate(system, right, None, lambda x: inverse @ x, 1e-9, 50)
    assert run.method == "gmres"
    assert np.allclose(system.matrix @ run.values, right)


def test_conjugate_gradients_that_break_down_end() -> None:
    system, right = small(True), np.array([0.6, 0.8])
    run = conjugate_gradients(product(system), right, np.zeros(2), lambda x: np.array([x[1], -x[0]]), 1e-9, 50)
    assert run.iterations == 0


def test_conjugate_gradients_are_those_of_scipy() -> None:
    system = box((15, 15))
    right = random_right(system)
    right = (right - right.mean()) / norm(right - right.mean())
    run = conjugate_gradients(product(system), right, np.zeros(225), Jacobi().build(system), 1e-30, 20)
    scipys, _ = cg(-system.matrix, -right, M=np.diag(-1 / system.matrix.diagonal()), rtol=1e-30, maxiter=20)
    assert run.iterations == 20
    assert np.allclose(run.values, scipys, rtol=1e-8, atol=1e-10)


def test_a_guess_is_left_as_it_is() -> None:
    for system in (box((10, 10)), one_sided(box((10, 10)))):
        guess = random_right(system, 2)
        kept = guess.copy()
        for robust in (False, True):
            iterate(system, random_right(system), guess, Jacobi().build(system), 1e-3, 50, robust=robust)
            assert np.array_equal(guess, kept)


@given(st.integers(0, 40), st.sampled_from([1e-200, 1.0, 1e200]))
def test_sums(count: int, unit: float) -> None:
    a, b = np.random.default_rng(count).standard_normal((2, count))
    assert dot(a, b) == pytest.approx(float(np.sum(a * b)))
    assert norm(unit * a) == pytest.approx(unit * float(np.linalg.norm(a)))
