"""Memory that images and pairs will take, estimated beforehand: what is too much is refused, with the numbers."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import Any

import numpy as np

from sphear.errors import SphearError

Array = np.ndarray[Any, Any]

SHARE = 0.5  # of the memory that is free, for images or for the pair list
ENTRY_BYTES = 150  # of an image: places, numbers, and its record in a sweep
PAIR_BYTES = 4
MOST_NEIGHBOURS = 100_000  # of a particle in the mean: no kernel is meant to have a thousandth of them
UNASKED = 2**29  # bytes that are taken without a look at how much is free


def free_memory() -> float:
    """Bytes that this process may still take: of the machine, or of its control group; infinity where nobody says."""
    free = np.inf
    with contextlib.suppress(OSError, ValueError, StopIteration):
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
        free = 1024.0 * int(next(line for line in lines if line.startswith("MemAvailable")).split()[1])
    group = Path("/sys/fs/cgroup")
    for most, used in (
        ("memory.max", "memory.current"),
        ("memory/memory.limit_in_bytes", "memory/memory.usage_in_bytes"),
    ):
        with contextlib.suppress(OSError, ValueError):
            free = min(free, float((group / most).read_text()) - float((group / used).read_text()))
    return max(free, 0.0)


def refuse_images(particles: int, periods: Array, reach: float) -> None:
    """Refuse more periodic images than memory holds.

    Args:
        particles: their number.
        periods: of the periodic axes.
        reach: images are wanted up to so far outside the box.

    Raises:
        SphearError: the images of all particles would take more than half of the free memory.
    """
    with np.errstate(over="ignore"):
        entries = particles * float(np.prod(1.0 + 2.0 * reach / periods))
    wanted = ENTRY_BYTES * entries
    if wanted > UNASKED and wanted > SHARE * (free := free_memory()):
        raise SphearError(
            f"a support of {reach:.3g} in a periodic box of {' by '.join(f'{x:.3g}' for x in periods)} needs"
            f" {entries:.2g} images of {particles} particles, {_size(wanted)} of the {_size(free)} of memory that are"
            f" free: take a smaller h, spacing or volumes"
        )


def refuse_pairs(start: Array, rows: Array, reach: int, entries: int, particles: int, once: bool) -> None:
    """Refuse more pairs than memory holds, judged by how many entries the cells hold.

    Args:
        start: (cells + 1,), the first entry of each cell.
        rows: offsets to the rows of cells within reach of a cell.
        reach: a row runs from so many cells before to so many after.
        entries: the number of all.
        particles: those of them that pairs are listed for.
        once: whether pairs are listed once.

    Raises:
        SphearError: the list would take more than half of the free memory, or have more than 100,000 neighbours for
            each particle.
    """
    held = np.diff(start).astype(np.float64)
    share = particles / max(1, entries) * (0.5 if once else 1.0)
    # sum_c n_c n_(c + k) <= sum_c n_c^2, so that this is enough for whatever lists are usual; not by `@`: of so many
    # cells its library wakes threads of its own, and on busy processors waits for them much longer than it computes
    if PAIR_BYTES * share * len(rows) * (2 * reach + 1) * float(np.einsum("c,c->", held, held)) < UNASKED:
        return
    used = np.flatnonzero(held)
    candidates = sum(
        float(held[used] @ (start[used + row + reach + 1] - start[used + row - reach]).astype(np.float64))
        for row in rows
    )
    block = len(rows) * (2 * reach + 1)
    ball = {5: 4.0, 25: 4.0 * np.pi, 125: 32.0 / 3.0 * np.pi}[block]  # cells within reach of a place, of this block
    pairs = share * candidates * ball / block
    neighbours, wanted = pairs / max(1, particles), PAIR_BYTES * pairs
    if wanted > UNASKED and wanted > SHARE * (free := free_memory()):
        limit = f"{_size(wanted)} of the {_size(free)} of memory that are free"
    elif neighbours > MOST_NEIGHBOURS:
        limit = f"more than {MOST_NEIGHBOURS}"
    else:
        return
    raise SphearError(
        f"{particles} particles have about {neighbours:.2g} neighbours each, {limit}: take a smaller h, spacing or"
        f" volumes"
    )


def _size(size: float) -> str:
    return f"{size / 2**30:.2g} GiB"
