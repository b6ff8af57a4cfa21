"""Sums of the slopes of a velocity at each particle, in one pass over them.

NumPy walks short axes slowly: of gradients in the plane it takes five times as long.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from sphear.engine.cache import compiled

Array = np.ndarray[Any, Any]


@compiled
def _squared_traces(slopes, dimension, result):  # type: ignore[no-untyped-def]  # pragma: no cover
    for particle in range(len(result)):
        total = 0.0
        for a in range(dimension):
            for b in range(dimension):
                total += slopes[particle, a * dimension + b] * slopes[particle, b * dimension + a]
        result[particle] = total


@compiled
def _changes(slopes, ways, result):  # type: ignore[no-untyped-def]  # pragma: no cover
    dimension = ways.shape[1]
    for particle in range(len(ways)):
        for a in range(dimension):
            total = 0.0
            for b in range(dimension):
                total += slopes[particle, a * dimension + b] * ways[particle, b]
            result[particle, a] = total


@compiled
def add_scaled(vectors, factors, directions):  # type: ignore[no-untyped-def]  # pragma: no cover
    """vectors (N, d) += factors (N,) times directions (N, d), in place."""
    for particle in range(len(vectors)):
        for axis in range(vectors.shape[1]):
            vectors[particle, axis] += factors[particle] * directions[particle, axis]


def traces(slopes: Array, dimension: int) -> Array:
    """(N,), tr G of slopes G (N, d d)."""
    result: Array = slopes[:, 0].copy()
    for axis in range(1, dimension):
        result += slopes[:, axis * (dimension + 1)]
    return result


def squared_traces(slopes: Array, dimension: int) -> Array:
    """(N,), tr(G^2) of slopes G (N, d d)."""
    result = np.empty(len(slopes))
    _squared_traces(slopes, dimension, result)
    return result


def changes(slopes: Array, ways: Array) -> Array:
    """(N, d), G w of slopes G (N, d d) and ways w (N, d)."""
    result = np.empty_like(ways)
    _changes(slopes, ways, result)
    return result
