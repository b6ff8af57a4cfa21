"""Many small symmetric systems, one a particle, with a measure of how nearly singular each is.

A library's batched solver stops at the first singular matrix of a batch, or does not say how near a matrix came;
a least-squares fit with too few neighbours has to be reported, particle by particle.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from sphear.engine.cache import compiled

Array = np.ndarray[Any, Any]


@compiled
def solve_normal_equations(moments, index, right, quality, solution):  # type: ignore[no-untyped-def]
    """Solve M x = right with M[a, b] = moments[index[a, b]] for each row of moments, by Cholesky's method.

    M is scaled to a unit diagonal first, so that the smallest pivot, stored in `quality`, lies between 0 (singular)
    and 1 (orthogonal columns) whatever the units.

    Args:
        moments: (rows, m).
        index: (n, n), where in a row of moments each entry of M stands.
        right: (n,), the same for every row.
        quality: (rows,), written.
        solution: (rows, n), written; zeros where a pivot is not positive.
    """
    n = len(right)
    factor = np.empty((n, n))
    unit = np.empty(n)
    x = np.empty(n)
    for row in range(len(moments)):
        for a in range(n):
            diagonal = moments[row, index[a, a]]
            unit[a] = 1.0 / np.sqrt(diagonal) if diagonal > 0.0 else 0.0
        smallest = 1.0
        for a in range(n):
            for b in range(a + 1):
                value = moments[row, index[a, b]] * unit[a] * unit[b]
                for k in range(b):
                    value -= factor[a, k] * factor[b, k]
                if a > b:
                    factor[a, b] = value * factor[b, b]
                else:
                    smallest = min(smallest, value)
                    factor[a, a] = 1.0 / np.sqrt(value) if value > 0.0 else 0.0  # the pivot's inverse root
        quality[row] = max(smallest, 0.0)
        for a in range(n):
            value = right[a] * unit[a]
            for k in range(a):
                value -= factor[a, k] * x[k]
            x[a] = value * factor[a, a]
        for a in range(n - 1, -1, -1):
            value = x[a]
            for k in range(a + 1, n):
                value -= factor[k, a] * x[k]
            x[a] = value * factor[a, a]
        for a in range(n):
            solution[row, a] = x[a] * unit[a] if smallest > 0.0 else 0.0
