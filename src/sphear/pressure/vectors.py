"""Sums over vectors without BLAS.

OpenBLAS shares the product of two vectors of more than 10,000 numbers out to threads that wait for each other by
spinning: where other programs keep the processors busy, as when several flows are computed side by side, conjugate
gradients from SciPy took 20 times as long with two such threads as with one. These run on the thread that calls, in
the same order every time, so that a solve is the same to the last bit on any number of processors.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from sphear.engine.cache import compiled

Array = np.ndarray[Any, Any]


@compiled
def dot(a, b):  # type: ignore[no-untyped-def]
    """a . b in four sums, because one would wait for each addition to end."""
    s0, s1, s2, s3 = 0.0, 0.0, 0.0, 0.0
    most = len(a) - len(a) % 4
    for k in range(0, most, 4):
        s0 += a[k] * b[k]
        s1 += a[k + 1] * b[k + 1]
        s2 += a[k + 2] * b[k + 2]
        s3 += a[k + 3] * b[k + 3]
    for k in range(most, len(a)):
        s0 += a[k] * b[k]
    return (s0 + s1) + (s2 + s3)


def norm(a: Array) -> float:
    """||a||, also where squares are too large or small for a float."""
    largest = float(np.abs(a).max(initial=0.0))
    if largest == 0.0 or not math.isfinite(largest):
        return largest
    scaled = a / largest
    return largest * math.sqrt(dot(scaled, scaled))


@compiled
def advance(values, residual, direction, product, step):  # type: ignore[no-untyped-def]
    """values += step direction and residual -= step product, in place; the new residual . residual."""
    for k in range(len(values)):
        values[k] += step * direction[k]
        residual[k] -= step * product[k]
    return dot(residual, residual)


@compiled
def update_direction(direction, towards, share):  # type: ignore[no-untyped-def]
    """direction = towards + share direction, in place."""
    for k in range(len(direction)):
        direction[k] = towards[k] + share * direction[k]
