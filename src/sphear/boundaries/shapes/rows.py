"""Evenly spaced numbers along and behind walls."""

from __future__ import annotations

import numpy as np

from sphear.boundaries.shapes.base import Array
from sphear.neighbours.domain import Domain

SLACK = 1e-9  # of a spacing, by which a row may lie beyond the depth it just reaches


def behind(spacing: float, depth: float) -> Array:
    """The depths (k + 1/2) spacing of the rows behind a wall, up to a depth."""
    return (np.arange(max(0, int(np.floor(depth / spacing + 0.5 + SLACK)))) + 0.5) * spacing


def inside(length: float, spacing: float) -> Array:
    """The cell centres (j + 1/2) length / n of the whole number n of cells that comes nearest the spacing."""
    n = max(1, round(length / spacing))
    return np.asarray((np.arange(n) + 0.5) * (length / n))


def along(length: float, spacing: float, beyond: float) -> Array:
    """The cell centres of a length, and those that go on beyond both of its ends."""
    out = behind(spacing, beyond)
    return np.concatenate((-out[::-1], inside(length, spacing), length + out))


def window_ticks(window: Domain, axis: int, spacing: float, beyond: float = 0.0) -> Array:
    """The cell centres of a window along an axis: a whole number in a period, else from its lower end on.

    Args:
        window: the box of interest.
        axis: of it.
        spacing: of the cells.
        beyond: how far they go on outside the window, but not along a periodic axis.
    """
    low, high = window.lower[axis], window.upper[axis]
    if axis in window.periodic_axes:
        return low + inside(high - low, spacing)
    out = len(behind(spacing, beyond))
    return np.asarray(low + (np.arange(-out, round((high - low) / spacing) + out) + 0.5) * spacing)


def grid(x: Array, y: Array) -> Array:
    """All places (len(x) len(y), 2) of two axes, the second the faster."""
    return np.stack(np.meshgrid(x, y, indexing="ij"), axis=2).reshape(-1, 2)
