"""The pseudo-inverse of a small Laplacian, beside that of LAPACK."""

from __future__ import annotations

import numpy as np
import pytest

from sphear.pressure.preconditioners.coarsest import pseudo_inverse

NULL = 1e-10


def laplacian(seed: int, nodes: int, coupled: float, fixed: float) -> np.ndarray:
    """A random graph's: a share of its pairs is coupled, a share of its nodes fixed."""
    random = np.random.default_rng(seed)
    weights = np.triu(random.random((nodes, nodes)) * (random.random((nodes, nodes)) < coupled), 1)
    weights = weights + weights.T
    return np.diag(weights.sum(axis=1) + (random.random(nodes) < fixed)) - weights


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("nodes", [1, 2, 9, 25, 32])
@pytest.mark.parametrize("coupled", [0.0, 0.05, 0.2, 1.0])  # nothing; many parts and empty nodes; one part
@pytest.mark.parametrize("fixed", [0.0, 0.1])
def test_it_is_that_of_lapack(seed: int, nodes: int, coupled: float, fixed: float) -> None:
    matrix = laplacian(seed, nodes, coupled, fixed)
    exact = np.linalg.pinv(matrix, rcond=NULL, hermitian=True)
    assert np.abs(pseudo_inverse(matrix, NULL) - exact).max() <= 1e-9 * np.abs(exact).max()


def test_it_is_symmetric_and_gives_no_constant() -> None:
    inverse = pseudo_inverse(laplacian(1, 30, 0.2, 0.0), NULL)
    assert np.abs(inverse - inverse.T).max() < 1e-14 * np.abs(inverse).max()
    assert np.abs(inverse.sum(axis=0)).max() < 1e-13 * np.abs(inverse).max()


def test_a_part_that_is_nearly_nothing_counts_as_nothing() -> None:
    matrix = np.zeros((4, 4))
    matrix[:2, :2] = [[1.0, -1.0], [-1.0, 1.0]]
    matrix[2:, 2:] = 1e-14 * matrix[:2, :2]
    exact = np.linalg.pinv(matrix, rcond=NULL, hermitian=True)
    assert np.abs(pseudo_inverse(matrix, NULL) - exact).max() < 1e-14
