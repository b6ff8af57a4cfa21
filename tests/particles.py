"""Particle arrangements, and the pairs among them by brute force: what the fast code is checked against."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np

from sphear import Domain

Array = np.ndarray[Any, Any]


def lattice(counts: tuple[int, ...], dx: float = 1.0, origin: float = 0.5) -> Array:
    """Particles at (i + origin) dx, the first axis running slowest."""
    axes = [(np.arange(count) + origin) * dx for count in counts]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(counts))


def jittered(counts: tuple[int, ...], amplitude: float, seed: int, dx: float = 1.0, origin: float = 0.5) -> Array:
    """A lattice with each coordinate moved by amplitude dx (U - 1/2)."""
    places = lattice(counts, dx, origin)
    return places + amplitude * dx * (np.random.default_rng(seed).random(places.shape) - 0.5)


def interior(positions: Array, margin: float) -> Array:
    """Which particles are at least `margin` from the edges of the box around all."""
    lower, upper = positions.min(axis=0), positions.max(axis=0)
    inside: Array = ((positions > lower + margin) & (positions < upper - margin)).all(axis=1)
    return inside


def box(counts: tuple[int, ...], dx: float = 1.0) -> Domain:
    """The periodic box of a lattice."""
    return Domain((0.0,) * len(counts), tuple(count * dx for count in counts))


def all_pairs(positions: Array, support: float, domain: Domain | None = None) -> tuple[Array, Array, Array]:
    """(i, j, r_i - r_j) of all pairs nearer than the support, periodic images included, by looking at all."""
    shifts = np.zeros((1, positions.shape[1]))
    if domain is not None:
        periods = np.subtract(domain.upper, domain.lower)
        most = [int(2 + support / period) if axis in domain.periodic_axes else 0 for axis, period in enumerate(periods)]
        shifts = np.array(list(product(*(range(-n, n + 1) for n in most)))) * periods
    firsts, seconds, differences = [], [], []
    for shift in shifts:
        d = positions[:, None, :] - positions[None, :, :] - shift
        near = (d**2).sum(axis=-1) < support**2
        if not shift.any():
            np.fill_diagonal(near, False)
        i, j = np.nonzero(near)
        firsts.append(i)
        seconds.append(j)
        differences.append(d[i, j])
    return np.concatenate(firsts), np.concatenate(seconds), np.concatenate(differences)


def summed(i: Array, values: Array, count: int) -> Array:
    """The sum of the pairs' values (pairs, ...) at each first particle."""
    total = np.zeros((count, *values.shape[1:]))
    np.add.at(total, i, values)
    return total
