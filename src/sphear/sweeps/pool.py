"""Runs on processes of this machine: one that is killed takes its own run with it and no other."""

from __future__ import annotations

import multiprocessing
import os
import queue
import signal
from collections.abc import Generator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing.process import BaseProcess
from threading import Event as Flag
from threading import Thread

from sphear.errors import SphearError
from sphear.extensions.loading import loaded
from sphear.sweeps.events import Event, Finished, Lost, Started, unexpected
from sphear.sweeps.objects import check_sendable, packed
from sphear.sweeps.plan import Run
from sphear.sweeps.worker import call, prepare

ATTEMPTS = 3  # to start a worker


def on_processes(runs: Sequence[Run], workers: int, compute: str) -> Generator[Event, None, None]:
    """Compute runs, the first ones first, and tell what happens to each; closed early, it ends its processes at once.

    Args:
        runs: what to compute.
        workers: how many processes.
        compute: import path of the function that computes a run.

    Raises:
        SphearError: no process can be started, or a setting cannot be sent to one.
    """
    check_sendable(runs)
    _start_resource_tracker()
    todo: queue.SimpleQueue[Run] = queue.SimpleQueue()
    for run in runs:
        todo.put(run)
    told: queue.SimpleQueue[Event | SphearError | None] = queue.SimpleQueue()
    feeders = [_Feeder(todo, told, compute) for _ in range(min(workers, len(runs)))]
    try:
        for feeder in feeders:
            feeder.start()
        busy = len(feeders)
        while busy:
            try:
                event = told.get(timeout=1.0)  # where Ctrl-C does not wake a thread that waits, it is seen after this
            except queue.Empty:
                continue
            if isinstance(event, SphearError):
                raise event
            if event is None:
                busy -= 1
            else:
                yield event
    finally:
        for feeder in feeders:
            feeder.stop()
        for feeder in feeders:
            feeder.join()


def _start_resource_tracker() -> None:
    """Have the helper of multiprocessing running, because its start unblocks the signals of the thread that does it."""
    if os.name == "posix":
        from multiprocessing import resource_tracker

        resource_tracker.ensure_running()


class _Feeder(Thread):
    """A thread that gives runs to a worker of its own, one after another, and replaces it when it dies."""

    def __init__(
        self, todo: queue.SimpleQueue[Run], told: queue.SimpleQueue[Event | SphearError | None], compute: str
    ) -> None:
        super().__init__(name="sphear-sweep", daemon=True)
        self.todo, self.told, self.compute = todo, told, compute
        self.stopped = Flag()
        self.executor: ProcessPoolExecutor | None = None
        self.process: BaseProcess | None = None

    def run(self) -> None:
        if hasattr(signal, "pthread_sigmask"):
            # processes inherit this: Ctrl-C cannot meet a worker that is not set up yet
            signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            self._feed()
        except SphearError as error:
            self.told.put(error)
        finally:
            self._close()
            self.told.put(None)

    def _feed(self) -> None:
        while not self.stopped.is_set():
            try:
                run = self.todo.get_nowait()
            except queue.Empty:
                return
            if self.process is None or not self.process.is_alive():
                self._open()
            if self.stopped.is_set():
                return
            self.told.put(Started(run))
            self.told.put(self._computed(run))

    def _computed(self, run: Run) -> Event:
        assert self.executor is not None
        try:
            future = self.executor.submit(call, self.compute, run.case, packed(run))
            error = future.exception()
        except BrokenProcessPool as broken:
            error = broken
        if error is None:
            return Finished(run, future.result())
        if isinstance(error, BrokenProcessPool):
            return Lost(run, self._death())
        return unexpected(run, error)

    def _open(self) -> None:
        """Start a worker, and know its process."""
        for attempt in range(1, ATTEMPTS + 1):
            self._close()
            spawn = multiprocessing.get_context("spawn")
            self.executor = ProcessPoolExecutor(1, spawn, initializer=prepare, initargs=(loaded(),))
            try:
                number = self.executor.submit(os.getpid).result()
            except (BrokenProcessPool, OSError) as error:
                if self.stopped.is_set():
                    return
                if attempt == ATTEMPTS:
                    raise SphearError(
                        f"worker processes do not start ({error}); a script that starts a sweep must do so under"
                        ' if __name__ == "__main__"'
                    ) from error
            else:
                self.process = next(child for child in multiprocessing.active_children() if child.pid == number)
                return

    def _death(self) -> str:
        """The reason why a worker is no more."""
        process = self.process
        self._close()
        code = None if process is None else process.exitcode
        if code is None or code >= 0:
            return "its worker ended" + ("" if code is None else f" with status {code}")
        return f"its worker was killed by {signal.Signals(-code).name}"

    def _close(self) -> None:
        if self.executor is not None:
            self.executor.shutdown()
        self.executor = self.process = None

    def stop(self) -> None:
        """End the worker at once, and start no other; a worker that is just starting is given no run."""
        self.stopped.set()
        process = self.process
        if process is not None:
            process.kill()
