"""Threads: ranges of rows of one sweep, run side by side while compiled code has let go of the interpreter's lock."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from numbers import Integral
from typing import TypeVar

from sphear.errors import SphearError, quoted

S = TypeVar("S")
T = TypeVar("T")

WORTH_A_THREAD = 10_000  # particles: below, handing out work costs more than it saves


def thread_count(threads: int | None, particles: int) -> int:
    """The number of threads to use: as asked, or all processors where there is enough work for them."""
    if threads is None:
        return max(1, min(_processors(), particles // WORTH_A_THREAD))
    if not isinstance(threads, Integral) or threads < 1:
        raise SphearError(f"threads must be a whole number of at least 1, not {quoted(threads)}")
    return int(threads)


def _processors() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@lru_cache
def _pool(threads: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(threads, thread_name_prefix="sphear")


def on_threads(function: Callable[[S], T], items: Sequence[S], threads: int) -> list[T]:
    """function(item) of each item, in their order; the first error of any is raised."""
    if threads == 1 or len(items) < 2:
        return [function(item) for item in items]
    return list(_pool(threads).map(function, items))
