"""Poisson's equation on the nodes of a box, solved exactly by cosine (walls) and Fourier (periodic) transforms."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from scipy.fft import dctn, idctn, irfftn, rfftn

Array = np.ndarray[Any, Any]

# nodes along each of two axes, up to which products with the modes are faster than SciPy's transforms, whose calls take
# longer than what they do; and as many as OpenBLAS multiplies on the thread that calls
FEW = 64


class BoxPoisson:
    """The inverse of the second-difference Laplacian on a box of nodes at the middles of cells.

    Both transforms diagonalise -(u_{k-1} - 2 u_k + u_{k+1}) / size^2, the cosine transform with u even about the walls:
    eigenvalues (2 - 2 cos(pi k / m)) / size^2, and (2 - 2 cos(2 pi k / m)) / size^2 where the axis is periodic. The
    constant, whose eigenvalue is zero, is taken out. Transforms are orthonormal, so the inverse is symmetric.

    Args:
        counts: (d,), nodes along each axis.
        size: (d,), their distance along each axis, in units of length.
        periodic: (d,), whether an axis repeats.
        factor: multiplies the result.
        threads: that transforms are computed on.
    """

    def __init__(
        self,
        counts: tuple[int, ...],
        size: tuple[float, ...],
        periodic: tuple[bool, ...],
        factor: float,
        threads: int = 1,
    ) -> None:
        self.counts, self.threads = counts, threads
        self.walls = tuple(axis for axis, flag in enumerate(periodic) if not flag)
        self.repeating = tuple(axis for axis, flag in enumerate(periodic) if flag)
        self.bases: tuple[Array, ...] = ()
        if len(counts) == 2 and max(counts) <= FEW:
            self.bases = tuple(_basis(count, flag) for count, flag in zip(counts, periodic, strict=True))
        self.inverse = factor * _inverse_eigenvalues(counts, size, periodic, bool(self.bases))

    def __call__(self, grid: Array) -> Array:
        """The solution (nodes,) for a source (nodes,), both flat; the source may be written over."""
        field: Any = grid.reshape(self.counts)
        if self.bases:
            along, across = self.bases
            solved: Array = along @ (self.inverse * (along.T @ field @ across)) @ across.T
            return solved.reshape(-1)
        if self.walls:
            field = dctn(field, axes=self.walls, norm="ortho", overwrite_x=True, workers=self.threads)
        if self.repeating:
            field = rfftn(field, axes=self.repeating, norm="ortho", overwrite_x=True, workers=self.threads)
        field *= self.inverse
        if self.repeating:
            lengths = [self.counts[axis] for axis in self.repeating]
            field = irfftn(field, s=lengths, axes=self.repeating, norm="ortho", overwrite_x=True, workers=self.threads)
        if self.walls:
            field = idctn(field, axes=self.walls, norm="ortho", overwrite_x=True, workers=self.threads)
        flat: Array = field.reshape(-1)
        return flat


@lru_cache(maxsize=8)  # the box of a run does not change from step to step
def _inverse_eigenvalues(
    counts: tuple[int, ...], size: tuple[float, ...], periodic: tuple[bool, ...], by_bases: bool
) -> Array:
    repeating = [axis for axis, flag in enumerate(periodic) if flag]
    total: Array = np.zeros((1,) * len(counts))
    for axis, (count, step) in enumerate(zip(counts, size, strict=True)):
        if by_bases:
            modes = _modes(count, periodic[axis])
        else:
            halved = repeating and axis == repeating[-1]  # what a transform of reals keeps
            modes = np.arange(count // 2 + 1 if halved else count)
        angle = (2 * np.pi if periodic[axis] else np.pi) * modes / count
        shape = [1] * len(counts)
        shape[axis] = -1
        total = total + ((2 - 2 * np.cos(angle)) / step**2).reshape(shape)
    total.flat[0] = np.inf
    inverse: Array = 1.0 / total
    return inverse


def _modes(count: int, periodic: bool) -> Array:
    """(count,), the wave number of each basis vector: those of a periodic axis are a cosine and a sine each."""
    numbers = np.arange(count)
    return (numbers + 1) // 2 if periodic else numbers


@lru_cache(maxsize=8)
def _basis(count: int, periodic: bool) -> Array:
    """(count, count), orthonormal: the columns are the modes of an axis at its nodes."""
    modes, nodes = _modes(count, periodic), np.arange(count)
    if periodic:
        angle = 2 * np.pi * np.outer(nodes, modes) / count
        basis = np.where(np.arange(count) % 2, np.cos(angle), np.sin(angle))
        basis[:, 0] = 1.0
    else:
        basis = np.cos(np.pi * np.outer(nodes + 0.5, modes) / count)
    result: Array = basis / np.linalg.norm(basis, axis=0)
    return result
