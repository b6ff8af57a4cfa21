"""Pressure equations to solve: Laplacians of Morris' form over the package's own neighbours."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.sparse import csr_matrix, diags_array

from sphear.kernels import CubicSpline, Kernel, WendlandC2
from sphear.neighbours import Domain, Neighbours
from sphear.pressure import PressureSystem

Array = np.ndarray[Any, Any]

KERNELS: dict[str, tuple[type[Kernel], float]] = {"wendland_c2": (WendlandC2, 1.5), "cubic_spline": (CubicSpline, 1.2)}
SLOPES: dict[str, Callable[[Array, int], Array]] = {  # w'(q) / q
    "wendland_c2": lambda q, d: -3 * (1 - q / 2) ** 2 if d == 1 else -5 * (1 - q / 2) ** 3,
    "cubic_spline": lambda q, d: np.where(q < 1, 2.25 * q - 3, -0.75 * (2 - q) ** 2 / q),
}


def laplacian(positions: Array, domain: Domain, spacing: float, kernel: str = "wendland_c2") -> csr_matrix[Any]:
    """Rows sum_j 2 V W'(r) / r (p_i - p_j): natural Neumann conditions where there are no neighbours."""
    kind, ratio = KERNELS[kernel]
    weight = kind(h=ratio * spacing)
    near = Neighbours(positions, weight.radius, domain, threads=1)
    row = np.concatenate([np.repeat(near.particles(c), np.diff(c.first)) for c in near.chunks])
    entry = np.concatenate([np.repeat(near.entry[c.begin : c.end], np.diff(c.first)) for c in near.chunks])
    other = np.concatenate([c.neighbour[: c.pairs] for c in near.chunks])
    r2 = ((near.coordinates[:, entry] - near.coordinates[:, other]) ** 2).sum(axis=0)
    q, dimension, count = np.sqrt(r2) / weight.h, positions.shape[1], len(positions)
    scale = weight.sigma[dimension - 1] / weight.h ** (dimension + 2)
    entries = -2 * spacing**dimension * scale * SLOPES[kernel](q, dimension)
    off = csr_matrix((entries, (row, near.source[other])), shape=(count, count))
    off = csr_matrix((off + off.T) / 2)  # symmetric to the last bit
    return csr_matrix(off - diags_array(np.asarray(off.sum(axis=1)).ravel()))


def particles(counts: tuple[int, ...], spacing: float, jitter: float = 0.2, hole: float = 0.0, seed: int = 0) -> Array:
    """A lattice moved by up to `jitter` spacings each way, without a cylinder in the middle."""
    axes = [(np.arange(count) + 0.5) * spacing for count in counts]
    places = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, len(counts))
    places = places + 2 * jitter * spacing * (np.random.default_rng(seed).random(places.shape) - 0.5)
    outside = np.hypot(*(places - np.array(counts) * spacing / 2).T[:2]) > hole if hole else slice(None)
    return places[outside]


def box(
    counts: tuple[int, ...],
    *,
    periodic: tuple[bool, ...] | bool = False,
    jitter: float = 0.2,
    hole: float = 0.0,
    kernel: str = "wendland_c2",
    length: float = 1.0,
) -> PressureSystem:
    """A box of fluid, the first side of the given length, with walls or periodic; no pressure is fixed."""
    spacing = length / counts[0]
    domain = Domain((0.0,) * len(counts), tuple(count * spacing for count in counts), periodic)
    positions = particles(counts, spacing, jitter, hole * length)
    matrix = laplacian(positions, domain, spacing, kernel)
    flags = domain.periodic
    assert isinstance(flags, tuple)
    return PressureSystem(matrix, positions, domain.lower, domain.upper, flags, spacing, symmetric=True, singular=True)


def fixed(system: PressureSystem, known: Array) -> PressureSystem:
    """The system with the particles of `known` (n,) at p = 0 and no longer among the unknowns: a free surface."""
    free = ~known
    matrix = csr_matrix(system.matrix[free][:, free])
    return replace(system, matrix=matrix, positions=system.positions[free], singular=False)


def one_sided(system: PressureSystem) -> PressureSystem:
    """Rows renormalised so that each is exact for |r|^2 / (2 d): what rows near walls lack is made up for.

    As with every renormalised operator, row i is divided by a number of particle i, so the matrix is not symmetric.
    """
    pairs = system.matrix.tocoo()
    apart = ((system.positions[pairs.row] - system.positions[pairs.col]) ** 2).sum(axis=1)
    sums = np.bincount(pairs.row, pairs.data * apart, system.unknowns) / (2 * system.dimension)
    return replace(system, matrix=csr_matrix(diags_array(1 / sums) @ system.matrix), symmetric=False)


def random_right(system: PressureSystem, seed: int = 1) -> Array:
    """Noise: all wavelengths alike."""
    return np.random.default_rng(seed).standard_normal(system.unknowns)
