"""Memory of large arrays that are made anew in each step."""

from __future__ import annotations

import ctypes

TRIM_THRESHOLD, MMAP_THRESHOLD = -1, -3  # of <malloc.h>
LARGEST = 2**31 - 1


def keep_freed_memory() -> None:
    """Let the C library keep what is freed for the next step, where it is glibc.

    It would give large arrays back to the system, which clears them page by page when they are asked for again: a third
    of the time of a step of 100,000 particles, see docs/measurements/performance.md.
    """
    try:
        mallopt = ctypes.CDLL(None).mallopt
    except (OSError, AttributeError, TypeError):  # another C library, or none to be found
        return
    for parameter in (TRIM_THRESHOLD, MMAP_THRESHOLD):
        mallopt(parameter, LARGEST)
