"""Runs on the workers of a Dask scheduler."""

from __future__ import annotations

import logging
import re
from collections.abc import Generator, Sequence
from contextlib import suppress
from importlib import import_module
from typing import Any

from sphear.errors import SphearError
from sphear.sweeps.events import Event, Finished, Lost, Started, unexpected
from sphear.sweeps.plan import Run
from sphear.sweeps.worker import call

CONNECT = 10.0  # seconds to find the scheduler
ADDRESS = re.compile(r"inproc://\S+|([a-z]+://)?(\[[0-9a-fA-F:]+\]|[^\s:/\[\]]+):\d+")
LOOK = 2.0  # seconds after which workers that have come are noticed


def on_cluster(runs: Sequence[Run], address: str, compute: str) -> Generator[Event, None, None]:
    """Compute runs, the first ones first, and tell what happens to each.

    No more runs are handed out than the workers have threads: one that is killed has no others waiting, which Dask
    would count as its victims too. Closed early, it takes back what it can; what runs, runs to its end unheard.

    Args:
        runs: what to compute.
        address: of the scheduler, such as tcp://host:8786.
        compute: import path of the function that computes a run.

    Raises:
        SphearError: Dask is not installed, or the scheduler does not answer.
    """
    distributed = _distributed()
    address = address.strip()
    if not ADDRESS.fullmatch(address):
        raise SphearError(f"the scheduler {address} does not answer: an address is written as tcp://host:8786")
    log = logging.getLogger("distributed.client")
    level = log.level
    log.setLevel(logging.CRITICAL)  # it would show tracebacks of what is said in a sentence below
    try:
        client = distributed.Client(address, timeout=CONNECT, set_as_default=False)
    except (OSError, ValueError) as error:
        log.setLevel(level)
        raise SphearError(f"the scheduler {address} does not answer: {error}") from error
    waiting, running = list(reversed(runs)), dict[Any, Run]()
    try:
        while waiting or running:
            free = max(1, sum(client.nthreads().values())) - len(running)
            for _ in range(min(free, len(waiting))):
                run = waiting.pop()
                running[client.submit(call, compute, run.case, run.sent, pure=False, retries=0)] = run
                yield Started(run)
            with suppress(distributed.TimeoutError, distributed.CancelledError), client.as_current():
                distributed.wait(list(running), timeout=LOOK, return_when="FIRST_COMPLETED")
            for future in [future for future in running if future.done()]:
                yield _outcome(running.pop(future), future)
    except OSError as error:
        raise SphearError(f"the scheduler {address} answers no more; what was computed is stored") from error
    finally:
        with suppress(OSError, distributed.TimeoutError):
            client.cancel(list(running))
        client.close()
        log.setLevel(level)


def _distributed() -> Any:
    try:
        return import_module("distributed")
    except ImportError as error:
        raise SphearError("a scheduler needs the extra 'cluster': pip install 'sphear[cluster]'") from error


def _outcome(run: Run, future: Any) -> Event:
    if future.status == "finished":
        return Finished(run, future.result())
    if future.status != "error":
        return Lost(run, "the scheduler gave it up")
    error = future.exception()
    killed = isinstance(error, _distributed().KilledWorker)
    return Lost(run, "its worker was killed") if killed else unexpected(run, error)
