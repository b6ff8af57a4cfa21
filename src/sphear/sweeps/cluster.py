"""Runs on the workers of a Dask scheduler."""

from __future__ import annotations

import asyncio
import logging
import re
import time
from collections.abc import Callable, Generator, Sequence
from contextlib import suppress
from importlib import import_module
from typing import Any

from sphear.errors import SphearError
from sphear.extensions.loading import modules
from sphear.sweeps.events import Event, Finished, Lost, Started, unexpected
from sphear.sweeps.objects import packed
from sphear.sweeps.plan import Run
from sphear.sweeps.worker import call

CONNECT = 10.0  # seconds to find the scheduler
PATIENCE = 600.0  # seconds without any worker after which a sweep ends
ADDRESS = re.compile(r"inproc://\S+|([a-z]+://)?(\[[0-9a-fA-F:]+\]|[^\s:/\[\]]+):\d+")
LOOK = 2.0  # seconds after which workers that have come are noticed


def on_cluster(
    runs: Sequence[Run], address: str, compute: str, say: Callable[[str], None]
) -> Generator[Event, None, None]:
    """Compute runs, the first ones first, and tell what happens to each.

    No more runs are handed out than the workers have threads: one that is killed has no others waiting, which Dask
    would count as its victims too. Closed early, it takes back what it can; what runs, runs to its end unheard.

    Args:
        runs: what to compute.
        address: of the scheduler, such as tcp://host:8786.
        compute: import path of the function that computes a run.
        say: is told in a sentence that there are no workers and how long they are waited for.

    Raises:
        SphearError: Dask is not installed, or the scheduler does not answer or has no workers for too long.
    """
    distributed = _distributed()
    address = address.strip()
    if not ADDRESS.fullmatch(address):
        raise SphearError(f"the scheduler {address} does not answer: an address is written as tcp://host:8786")
    log = logging.getLogger("distributed.client")
    level = log.level
    log.setLevel(logging.CRITICAL)  # it would show tracebacks of what is said in a sentence below
    try:
        _ask(address)
        client = distributed.Client(address, timeout=CONNECT, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:  # the last where TLS lacks its files
        log.setLevel(level)
        why = " ".join(str(error).split()) or f"nothing came within {CONNECT:g} s"
        raise SphearError(f"the scheduler {address} does not answer: {why}") from error
    waiting, running = list(reversed(runs)), dict[Any, Run]()
    dumps = _dumps()
    alone = _Alone(address, say)
    try:
        while waiting or running:
            threads = sum(client.nthreads().values())
            alone.look(threads)
            for _ in range(min(threads - len(running), len(waiting))):
                run = waiting.pop()
                running[client.submit(call, compute, run.case, packed(run, dumps), pure=False, retries=0)] = run
                yield Started(run)
            if not running:
                time.sleep(LOOK if not threads else 0)
                continue
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


def _dumps() -> Callable[[Any], bytes]:
    """Pickling that sends classes of extension files along whole, because workers may have no such file."""
    cloudpickle = import_module("cloudpickle")
    for module in modules():
        cloudpickle.register_pickle_by_value(module)
    dumps: Callable[[Any], bytes] = cloudpickle.dumps
    return dumps


class _Alone:
    """Waits for workers where a scheduler has none: says so once, and not for ever."""

    def __init__(self, address: str, say: Callable[[str], None]) -> None:
        self.address, self.say = address, say
        self.since: float | None = None

    def look(self, threads: int) -> None:
        """Take note of how many threads the workers have.

        Raises:
            SphearError: there have been none for too long.
        """
        if threads:
            self.since = None
        elif self.since is None:
            self.since = time.monotonic()
            self.say(f"the scheduler {self.address} has no workers: they are waited for, {PATIENCE:g} s at most")
        elif time.monotonic() - self.since > PATIENCE:
            raise SphearError(
                f"the scheduler {self.address} has had no workers for {PATIENCE:g} s: start some with dask worker"
                f" {self.address}; what was computed is stored"
            )


def _ask(address: str) -> None:
    """Exchange greetings with a scheduler: its client would wait for ever for those of one that says nothing.

    Raises:
        OSError, ValueError, TypeError: it cannot be reached, says nothing in time, or is of no known kind.
    """
    if address.startswith("inproc://"):
        return
    comm = import_module("distributed.comm")
    security = _distributed().Security().get_connection_args("client")

    async def greeted() -> None:
        connection = await asyncio.wait_for(comm.connect(address, timeout=CONNECT, **security), CONNECT)
        connection.abort()

    asyncio.run(greeted())


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
