"""The coarsest grid of multigrid, solved at once: the pseudo-inverse of a small Laplacian, without LAPACK.

LAPACK shares out to threads what has more than 25 unknowns, and these threads wait for each other by spinning: where
other programs keep the processors busy, its eigenvalues of a matrix of 30 x 30 took 30 times as long as with one.
"""

from __future__ import annotations

import numpy as np

from sphear.engine.cache import compiled


@compiled
def pseudo_inverse(matrix, null):  # type: ignore[no-untyped-def]
    """The Moore-Penrose inverse (n, n) of a symmetric, diagonally dominant matrix without positive couplings.

    Elimination without exchanges, A = L D L^T, is stable for such a matrix (Wilkinson 1961): what is left of it is of
    the same kind at every stage. A pivot vanishes where the nodes that are left are not coupled to those before, and
    nothing fixes the level of these: L^T v = e is then a null vector, constant on the connected part that ends there
    (or on an empty node). With G = L^-T D^+ L^-1 and P the projector beside all v, the inverse is P G P.

    Args:
        matrix: (n, n).
        null: relative to the largest diagonal entry, a pivot that is zero.
    """
    n = len(matrix)
    lower = np.zeros((n, n))
    pivot = np.zeros(n)
    largest = 0.0
    for k in range(n):
        largest = max(largest, matrix[k, k])
    for k in range(n):
        pivot[k] = matrix[k, k]
        for m in range(k):
            pivot[k] -= lower[k, m] ** 2 * pivot[m]
        lower[k, k] = 1.0
        if pivot[k] <= null * largest:
            pivot[k] = 0.0
            continue
        for i in range(k + 1, n):
            total = matrix[i, k]
            for m in range(k):
                total -= lower[i, m] * lower[k, m] * pivot[m]
            lower[i, k] = total / pivot[k]

    inverse = np.zeros((n, n))  # L^-1, row by row
    for k in range(n):
        inverse[k, k] = 1.0
        for m in range(k):
            for j in range(m + 1):
                inverse[k, j] -= lower[k, m] * inverse[m, j]
    result = np.zeros((n, n))
    for k in range(n):
        if pivot[k] > 0.0:
            for i in range(k + 1):
                for j in range(k + 1):
                    result[i, j] += inverse[k, i] * inverse[k, j] / pivot[k]
    for k in range(n):
        if pivot[k] == 0.0:  # row k of L^-1 is v: null vectors of different parts are orthogonal
            v = inverse[k].copy()
            v /= np.sqrt((v * v).sum())
            for _ in range(2):  # from the left, and by the transpose from the right
                for j in range(n):
                    along = 0.0
                    for i in range(n):
                        along += v[i] * result[i, j]
                    for i in range(n):
                        result[i, j] -= v[i] * along
                result = result.T.copy()
    return result
