"""Code compiled by processes beside this one, so that it is in the cache when this one gets there.

Numba compiles on one thread. What a flow needs is compiled within its first step, in the order of that step; processes
that are forked when the first of it turns out to be missing do other parts of the work meanwhile, and this process
loads what they have compiled. Nothing is handed back but files of the cache, so nothing depends on them: where a
process dies, cannot be made or compiles what is not needed, this one compiles it by itself.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress

from sphear.engine.cache.folder import cache_directory
from sphear.engine.interrupts import SIGNALS
from sphear.engine.notices import notices
from sphear.engine.threads import processors

Job = Callable[[], object]

MOST_PROCESSES = 7  # beside this one: each takes some 100 MB, and a flow has some 20 functions
MOST_JOBS = 256  # numbered by a byte each


class _Processes:
    """The processes that do jobs, made when something is compiled.

    Args:
        jobs: the one that is wanted last, first.
    """

    def __init__(self, jobs: Sequence[Job]) -> None:
        self._jobs = jobs[:MOST_JOBS]
        self._processes: list[int] = []
        self._of = os.getpid()

    def start(self) -> None:
        """Make them, in the process that they are beside; one of them ends when that has ended."""
        if os.getpid() != self._of:
            if os.getppid() != self._of:
                os._exit(1)
        elif self._jobs:
            jobs, self._jobs = self._jobs, ()
            with suppress(OSError):  # of too many processes or files
                self._fork(jobs)

    def _fork(self, jobs: Sequence[Job]) -> None:
        queue, end = os.pipe()  # whoever reads a byte has that job
        try:
            os.write(end, bytes(range(len(jobs))))
        finally:
            os.close(end)
        try:
            for _ in range(min(processors() - 1, MOST_PROCESSES, len(jobs))):
                with warnings.catch_warnings():  # of threads of libraries, which hold nothing that compiling needs
                    warnings.simplefilter("ignore", DeprecationWarning)
                    process = os.fork()
                if not process:
                    _work(jobs, queue)
                self._processes.append(process)
        finally:
            os.close(queue)

    def stop(self) -> None:
        """End them, finished or not."""
        for process in self._processes:
            with suppress(OSError):
                os.kill(process, signal.SIGTERM)
        for process in self._processes:
            with suppress(OSError):
                os.waitpid(process, 0)
        self._processes.clear()


def _work(jobs: Sequence[Job], queue: int) -> None:
    """Do jobs until none is left, in a process that was forked for it, and end that."""
    try:
        for number in SIGNALS:
            signal.signal(number, signal.SIG_DFL)  # to end at once; files of the cache are whole or not there
        nowhere = os.open(os.devnull, os.O_RDWR)
        for stream in range(3):  # so that nobody who reads what the program says waits for this one
            os.dup2(nowhere, stream)
        notices.listen(on_warning=lambda sentence: None)
        while number := os.read(queue, 1):
            with suppress(Exception):  # the process that needs it meets the same error
                jobs[number[0]]()
    finally:
        os._exit(0)


_current: list[_Processes] = []


def _may_fork() -> bool:
    """True where forking is safe and of use: no other thread of Python could hold a lock, and code is kept."""
    return (
        sys.platform == "linux"
        and threading.active_count() == 1
        and multiprocessing.parent_process() is None  # whose processes have the processors already
        and processors() > 1
        and cache_directory() is not None
    )


@contextmanager
def compiled_beside(jobs: Sequence[Job]) -> Iterator[None]:
    """Have other processes do jobs from the first compilation within the block on, for the code that they compile.

    They are ended with the block. Where code is not kept, there is one processor, processes cannot be forked safely or
    the block is within another, nothing is done beside it. If nothing is compiled no process is made.

    Args:
        jobs: what they take one after the other, the one whose code the block needs last, first.
    """
    if _current or not jobs or not _may_fork():
        yield
        return
    processes = _Processes(jobs)
    _current.append(processes)
    try:
        yield
    finally:
        _current.clear()
        processes.stop()


def compiling_begins() -> None:
    """Make the processes of the block, if there is one and they are not there yet."""
    for processes in _current:
        processes.start()
