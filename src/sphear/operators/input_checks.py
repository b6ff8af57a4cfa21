"""Checks of inputs that are computed but hardly meant: particles without neighbours, volumes that are not theirs."""

from __future__ import annotations

import inspect
import warnings
from typing import Any

import numpy as np

from sphear.errors import SphearError, SphearWarning
from sphear.kernels import Kernel
from sphear.neighbours import Neighbours

Array = np.ndarray[Any, Any]

FACTOR = 5.0  # between the sum of the kernel over the volumes and one, for most particles
LOOKED_AT = 100  # particles, evenly spaced


class NoNeighboursError(SphearError):
    """None of the particles has a neighbour."""


def check_isolated(
    positions: Array, alone: Array, support: float, larger: str = "h, spacing or volumes", *, warn: bool = True
) -> None:
    """Refuse particles none of which has a neighbour, whose sums are all zero; warn of some that have none.

    Args:
        positions: of the particles, (N, d).
        alone: those that have no neighbour.
        support: of the kernel.
        larger: the settings to enlarge.
        warn: else some without neighbours are nothing new to the user.
    """
    if not len(alone):
        return
    of = f"{len(alone)} of {len(positions)} particles have no neighbour within the support of {support:.4g}"
    if len(alone) == len(positions):
        raise NoNeighboursError(f"{of}: take a larger {larger}")
    place = ", ".join(f"{x:.6g}" for x in positions[alone[0]])
    if warn:
        _warn(f"{of}, the first is particle {alone[0]} at ({place})")


def check_volumes(volumes: Array, kernel: Kernel, neighbours: Neighbours) -> None:
    """Warn of volumes with which the kernel sums to something far from one: they are not those of the particles."""
    if neighbours.count == 1 or "chunks" not in neighbours.__dict__:
        return
    sums = []
    for row in np.linspace(0, neighbours.count - 1, min(LOOKED_AT, neighbours.count)).astype(int):
        chunk = next(c for c in neighbours.chunks if c.begin <= row < c.end)
        i = neighbours.entry[row]
        j = chunk.neighbour[chunk.first[row - chunk.begin] : chunk.first[row - chunk.begin + 1]]
        r2 = ((neighbours.coordinates[:, j] - neighbours.coordinates[:, [i]]) ** 2).sum(axis=0)
        own = volumes[neighbours.source[i]] * kernel.value_at_zero(neighbours.dimension)
        sums.append(own + float(np.sum(volumes[neighbours.source[j]] * kernel.value(r2, neighbours.dimension))))
    usual = float(np.median(sums))
    if not 1.0 / FACTOR < usual < FACTOR:
        _warn(
            f"the kernel sums to about {usual:.3g} over the volumes instead of 1: the volumes given are hardly those of"
            f" these particles"
        )


def _warn(sentence: str) -> None:
    """Warn at the line that called this package."""
    level, frame = 1, inspect.currentframe()
    while frame is not None and frame.f_globals.get("__name__", "").partition(".")[0] == "sphear":
        level, frame = level + 1, frame.f_back
    warnings.warn(sentence, SphearWarning, stacklevel=level)
