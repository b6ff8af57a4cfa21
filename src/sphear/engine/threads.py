"""Threads: ranges of rows of one sweep, run side by side while compiled code has let go of the interpreter's lock."""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable, Sequence
from functools import lru_cache
from itertools import count, takewhile
from numbers import Integral
from queue import SimpleQueue
from typing import Any, TypeVar

from sphear.errors import SphearError, quoted

S = TypeVar("S")
T = TypeVar("T")

WORTH_A_THREAD = 10_000  # particles: below, handing out work costs more than it saves
MOST_THREADS = 1024


def thread_count(threads: int | None, particles: int) -> int:
    """The number of threads to use: as asked, or all processors where there is enough work for them."""
    if threads is None:
        return max(1, min(processors(), particles // WORTH_A_THREAD))
    if not isinstance(threads, Integral) or threads < 1:
        raise SphearError(f"threads must be a whole number of at least 1, not {quoted(threads)}")
    if threads > MOST_THREADS:
        raise SphearError(f"threads must be at most {MOST_THREADS}, not {quoted(threads)}")
    return int(threads)


def processors() -> int:
    """The number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@lru_cache
def _waiting(threads: int, process: int) -> SimpleQueue[Callable[[], None]]:
    """The queue of what so many threads of one process do: a forked child inherits the queue without its threads.

    Plain threads on a queue are woken four times as fast as those of an executor, whose every task is an object with a
    lock of its own; a step of a small flow hands out work some fifty times.
    """
    queue: SimpleQueue[Callable[[], None]] = SimpleQueue()

    def serve() -> None:
        while True:
            queue.get()()

    for number in range(threads):
        threading.Thread(target=serve, name=f"sphear_{number}", daemon=True).start()
    return queue


def ranges(count: int, parts: int) -> list[tuple[int, int]]:
    """The ranges (begin, end) of `parts` parts of 0 ... count - 1, as even as can be."""
    return [(count * part // parts, count * (part + 1) // parts) for part in range(parts)]


def on_threads(function: Callable[[S], T], items: Sequence[S], threads: int) -> list[T]:
    """function(item) of each item, in their order; an error of any is raised once nothing is at work any more.

    The thread that calls takes its part: others are woken to help, and one that comes late finds nothing left to do.
    """
    if threads == 1 or len(items) < 2:
        return [function(item) for item in items]
    most, own = len(items), 0
    results: list[Any] = [None] * most
    numbers, ended = count(), SimpleQueue[BaseException | None]()

    def take_part() -> None:
        while (number := next(numbers)) < most:
            error = None
            try:
                results[number] = function(items[number])
            except BaseException as raised:  # noqa: BLE001, the thread that calls raises it
                error = raised
            ended.put(error)

    helpers = min(threads, most) - 1
    for _ in range(helpers):
        _waiting(helpers, os.getpid()).put(take_part)
    try:
        while (number := next(numbers)) < most:
            own += 1
            results[number] = function(items[number])
    finally:  # after an error nothing more is begun; what others have begun they end
        left = sum(1 for _ in takewhile(lambda number: number < most, numbers))
        errors = [ended.get() for _ in range(most - own - left)]
    for error in errors:
        if error is not None:
            raise error
    return results


def _compiler_lock() -> Any:
    """Numba's lock, where Numba is in use; importing it here would cost those who need no compiled code."""
    module = sys.modules.get("numba.core.compiler_lock")
    return getattr(module, "global_compiler_lock", None)


_held: list[Any] = []
_without_openmp: list[int] = []  # processes forked from one whose threads were OpenMP's


def loop_threads() -> int:
    """The threads that compiled loops may use: one in a child forked after OpenMP was used, which would be ended."""
    import numba

    return 1 if os.getpid() in _without_openmp else int(numba.config.NUMBA_NUM_THREADS)


def _openmp_in_use() -> bool:
    layer = sys.modules.get("numba.np.ufunc.parallel")
    return layer is not None and getattr(layer, "_threading_layer", None) == "omp"


def _hold() -> None:
    if (lock := _compiler_lock()) is not None:
        lock.acquire()
        _held.append(lock)


def _let_go() -> None:
    if _held:
        _held.pop().release()


def _in_child() -> None:
    _let_go()
    if _without_openmp or _openmp_in_use():
        _without_openmp[:] = [os.getpid()]


if hasattr(os, "register_at_fork"):
    # a child forked while another thread compiles would inherit Numba's lock, held by a thread that it does not have
    os.register_at_fork(before=_hold, after_in_parent=_let_go, after_in_child=_in_child)
