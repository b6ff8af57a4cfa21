"""Poisson's equation on the nodes of a box, solved exactly by cosine (walls) and Fourier (periodic) transforms."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from scipy.fft import dctn, idctn, irfftn, rfftn

Array = np.ndarray[Any, Any]


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
        self.inverse = factor * _inverse_eigenvalues(counts, size, periodic)

    def __call__(self, grid: Array) -> Array:
        """The solution (nodes,) for a source (nodes,), both flat; the source may be written over."""
        field: Any = grid.reshape(self.counts)
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
def _inverse_eigenvalues(counts: tuple[int, ...], size: tuple[float, ...], periodic: tuple[bool, ...]) -> Array:
    repeating = [axis for axis, flag in enumerate(periodic) if flag]
    total: Array = np.zeros((1,) * len(counts))
    for axis, (count, step) in enumerate(zip(counts, size, strict=True)):
        modes = count // 2 + 1 if repeating and axis == repeating[-1] else count  # what a transform of reals keeps
        angle = (2 * np.pi if periodic[axis] else np.pi) * np.arange(modes) / count
        shape = [1] * len(counts)
        shape[axis] = -1
        total = total + ((2 - 2 * np.cos(angle)) / step**2).reshape(shape)
    total.flat[0] = np.inf
    inverse: Array = 1.0 / total
    return inverse
