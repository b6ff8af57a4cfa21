"""Flexible GMRES: the preconditioner may differ from one iteration to the next."""

from __future__ import annotations

from typing import Any

import numpy as np

from sphear.pressure.krylov import KrylovResult, Operator, Vector
from sphear.pressure.vectors import norm

RESTART = 60  # iterations after which the basis is dropped


def flexible_gmres(
    times: Operator, right: Vector, values: Vector, inverse: Operator, tolerance: float, most: int
) -> KrylovResult:
    """Saad 1993, preconditioned from the right, so that the residual that it measures is that of the equation.

    Args:
        times: the product by the matrix.
        right: (n,), of length one, or any that `tolerance` is meant for.
        values: (n,), where to begin.
        inverse: the preconditioner.
        tolerance: of the residual's length.
        most: iterations.
    """
    spent = 0
    while True:
        residual = right - times(values)
        length = norm(residual)
        if not length > tolerance or spent >= most:
            return KrylovResult(values, spent, "fgmres", length <= tolerance)
        basis, steps = [residual / length], list[Vector]()
        size = min(RESTART, most - spent)
        hessenberg, rotations = np.zeros((size + 1, size)), np.zeros((size, 2))
        short = np.zeros(size + 1)
        short[0] = length
        for k in range(size):
            steps.append(inverse(basis[k]))
            along = times(steps[k])
            for _ in range(2):  # orthogonal to rounding
                for j in range(k + 1):
                    part = _dot(basis[j], along)
                    hessenberg[j, k] += part
                    along = along - part * basis[j]
            hessenberg[k + 1, k] = height = norm(along)
            spent += 1
            _rotate(hessenberg, rotations, short, k)
            if not abs(short[k + 1]) > tolerance or height == 0.0:
                break
            basis.append(along / height)
        count = len(steps)
        shares = np.linalg.solve(hessenberg[:count, :count], short[:count])
        for share, step in zip(shares, steps, strict=True):
            values = values + share * step
        if not np.isfinite(values).all():
            return KrylovResult(values, spent, "fgmres", False)


def _dot(a: Vector, b: Vector) -> float:
    return float(np.einsum("i,i->", a, b))


def _rotate(hessenberg: Any, rotations: Any, short: Any, k: int) -> None:
    """Bring a new column of the Hessenberg matrix to triangular form (Givens)."""
    column = hessenberg[:, k]
    for j in range(k):
        c, s = rotations[j]
        column[j], column[j + 1] = c * column[j] + s * column[j + 1], c * column[j + 1] - s * column[j]
    size = float(np.hypot(column[k], column[k + 1]))
    c, s = (column[k] / size, column[k + 1] / size) if size > 0.0 else (1.0, 0.0)
    rotations[k] = c, s
    column[k], column[k + 1] = size, 0.0
    short[k], short[k + 1] = c * short[k], -s * short[k]
