"""The number of particles that there is memory for, checked before they are made."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from sphear.errors import SphearError, shortened

MOST = 2**31 - 1  # particles with their images: numbers of 32 bits
PER_PARTICLE = 500  # bytes at least that a run takes for one, its neighbours included: 1,200 incompressible
_LIMITS = ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes")  # of a container


def check_size(name: str, resolution: int, extents: Sequence[float]) -> None:
    """Refuse more particles than there can be or is memory for.

    Args:
        name: of the setting.
        resolution: particles along a length of one.
        extents: of the fluid, in that length.

    Raises:
        SphearError: there are too many, with their number and the memory.
    """
    try:
        count = math.prod(float(resolution) * extent for extent in extents)
    except OverflowError:
        count = math.inf
    check_count(count, f"{name}={_short(resolution)}", len(extents), f"a {name}", resolution)


def check_count(count: float, what: str, dimension: int, smaller: str, now: int) -> None:
    """Refuse a number of particles that is too large.

    Args:
        count: of particles.
        what: makes so many.
        dimension: of space.
        smaller: what is to be made smaller.
        now: its value.

    Raises:
        SphearError: there can be no so many, or they take more memory than there is.
    """
    memory = memory_limit()
    most = min(MOST, math.inf if memory is None else memory / PER_PARTICLE)
    if count <= most:
        return
    largest = int(now * (most / count) ** (1 / dimension)) if math.isfinite(count) else 0
    remedy = f"take {smaller} of {largest} or less" if largest else f"take {smaller} that is far smaller"
    why = f"which take {count * PER_PARTICLE / 1e9:.3g} GB or more where there are {(memory or 0) / 1e9:.3g}"
    if most == MOST:
        why = f"of which no more than {MOST} can be numbered"
    raise SphearError(f"{what} makes {count:.3g} particles, {why}: {remedy}")


def memory_limit() -> int | None:
    """The bytes of memory that this process may have; None where nothing says."""
    found = []
    if hasattr(os, "sysconf"):
        with suppress(ValueError, OSError):
            found.append(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    for path in _LIMITS:
        with suppress(ValueError, OSError):
            found.append(int(Path(path).read_text(encoding="ascii")))
    found += _address_space()
    return min((size for size in found if size > 0), default=None)


def _address_space() -> list[int]:
    try:
        import resource
    except ImportError:  # not on Windows
        return []
    limit = resource.getrlimit(resource.RLIMIT_AS)[0]
    return [] if limit == resource.RLIM_INFINITY else [limit]


def _short(number: int) -> str:
    try:
        return shortened(str(number))
    except ValueError:  # of thousands of digits
        return "a number of thousands of digits"
