from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.sparse import csr_array, csr_matrix, diags_array

from sphear.errors import SphearError
from sphear.pressure import PressureSystem, solve
from tests.pressure.problems import box, random_right


@pytest.fixture(scope="module")
def system() -> PressureSystem:
    return box((6, 6))


def changed(system: PressureSystem, row: int, column: int, value: float) -> csr_matrix[Any]:
    matrix = system.matrix.tolil()
    matrix[row, column] = value
    return csr_matrix(matrix)


def without_neighbours(system: PressureSystem, row: int) -> csr_matrix[Any]:
    keep = np.ones(system.unknowns)
    keep[row] = 0.0
    return csr_matrix(diags_array(keep) @ system.matrix)


@pytest.mark.parametrize(
    ("fault", "sentence"),
    [
        (lambda s: {"matrix": without_neighbours(s, 7)}, r"particle 7 at \(0\.\d+, 0\.\d+\) has no neighbour"),
        (lambda s: {"matrix": changed(s, 3, 4, np.nan)}, "particle 3 .* not finite"),
        (lambda s: {"matrix": changed(s, 3, 3, 0.0)}, "particle 3 .* not negative"),
        (lambda s: {"matrix": changed(s, 3, 3, 1.0)}, "particle 3 .* not negative"),
        (lambda s: {"matrix": changed(s, 3, 3, -1e6)}, "fix no pressure, but the row of particle 3 .* sum to zero"),
        (lambda s: {"singular": False}, "fixes no pressure anywhere"),
        (lambda s: {"matrix": csr_matrix((5, 5))}, "36 particles needs a 36 x 36 matrix, not 5 x 5"),
        (lambda s: {"positions": s.positions[:0]}, "nothing to solve for"),
        (lambda s: {"positions": np.full_like(s.positions, np.inf)}, "positions .* must be finite"),
        (lambda s: {"lower": (0.0,)}, "needs 2 axes"),
        (lambda s: {"upper": (0.0, 1.0)}, "must extend"),
        (lambda s: {"spacing": 0.0}, "spacing .* must be positive"),
    ],
)
def test_refusals(system: PressureSystem, fault: Any, sentence: str) -> None:
    with pytest.raises(SphearError, match=sentence):
        replace(system, **fault(system))


def test_a_particle_with_given_pressures_around_it_is_an_equation_of_its_own() -> None:
    matrix = csr_array(np.array([[-4.0, 1.0, 0.0], [1.0, -4.0, 0.0], [0.0, 0.0, -2.0]]))
    positions = np.array([[0.1, 0.1], [0.2, 0.1], [0.9, 0.9]])
    system = PressureSystem(matrix, positions, (0, 0), (1, 1), (False, False), 0.1, symmetric=True, singular=False)
    assert np.allclose(solve(system, np.array([3.0, 3.0, 4.0])).values, [-1.0, -1.0, -2.0])


@pytest.mark.parametrize("kind", [csr_matrix, csr_array])
def test_both_kinds_of_sparse_matrices(system: PressureSystem, kind: Any) -> None:
    right = random_right(system)
    for preconditioner in ("grid", "amg", "jacobi"):
        found = solve(replace(system, matrix=kind(system.matrix)), right, preconditioner=preconditioner)
        assert np.allclose(found.values, solve(system, right, tolerance=1e-10).values, atol=1e-4)
