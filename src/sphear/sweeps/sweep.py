"""A sweep: what is stored is taken, the rest is computed, each result stored as it comes."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Sequence
from contextlib import closing
from typing import TYPE_CHECKING, Any

from sphear.errors import SphearError, quoted
from sphear.progress import no_progress
from sphear.sweeps.cluster import on_cluster
from sphear.sweeps.events import Finished, Lost, Started
from sphear.sweeps.pool import on_processes
from sphear.sweeps.progress import Progress, Tracker
from sphear.sweeps.result import SweepResult, lost, of_record
from sphear.sweeps.worker import COMPUTE

if TYPE_CHECKING:
    from sphear.sweeps.plan import Run
    from sphear.sweeps.store import Store

ATTEMPTS = 2  # at a run that ends with an exception


class SweepWarning(UserWarning):
    """An event beside the runs of a sweep, in a sentence."""


def warn(sentence: str) -> None:
    """Say it as a warning of Python."""
    warnings.warn(sentence, SweepWarning, stacklevel=2)


def run_sweep(
    runs: Sequence[Run],
    store: Store,
    *,
    workers: int = 1,
    scheduler: str | None = None,
    progress: Progress = no_progress,
    compute: str = COMPUTE,
    longest_first: bool = True,
    say: Callable[[str], None] = warn,
) -> list[SweepResult]:
    """Compute runs that are not stored yet and store each as it ends.

    A run that is lost (its worker was killed, or something unexpected happened) has no result; the others go on. The
    next call computes it again, but for one that has ended with an exception twice. A file that is not the whole result
    of its run is computed again. Ctrl-C ends the workers and keeps what is stored.
    Workers begin by importing the script that calls: there the call stands below `if __name__ == "__main__":`.

    Args:
        runs: what to compute; one that comes up again is computed once.
        store: where the results are kept.
        workers: processes of this machine, each of one thread.
        scheduler: address of a Dask scheduler, whose workers are used instead.
        progress: is told where the sweep stands, whenever that changes.
        compute: import path, `module:name`, of the function that computes a run from its case and settings.
        longest_first: the long ones first, so that all workers end together; else the short ones.
        say: is told in a sentence what is not believed or not tried again, and what is waited for.

    Returns:
        The results, in the order of the runs.

    Raises:
        SphearError: settings do not go together, workers or the scheduler cannot be used, or a file not be written.
        KeyboardInterrupt: Ctrl-C.

    Examples:
        >>> import sphear
        >>> fixed = {"scheme": "incompressible", "resolution": 10, "until": 0.05}
        >>> runs = sphear.plan("cavity", {"viscosity": ["fatehi_manzari"]}, fixed)
        >>> results = sphear.run_sweep(runs, sphear.Store("results"))
        >>> [result.end for result in results]
        ['time']
    """
    _check(runs, store, workers, scheduler)
    results, attempts = _stored(runs, store, say)
    todo = list({run.key: run for run in runs if run.key not in results}.values())
    todo.sort(key=lambda run: run.cost, reverse=longest_first)
    tracker = Tracker(list(results.values()), todo)
    progress(tracker.state())
    if todo:
        source = on_cluster(todo, scheduler, compute, say) if scheduler else on_processes(todo, workers, compute)
        with closing(source) as events:
            for event in events:
                if isinstance(event, Started):
                    tracker.started(event)
                else:
                    results[event.run.key] = result = _result(event, attempts.get(event.run.key, 0))
                    if not result.lost or result.attempts:
                        store.put(event.run, result)
                    tracker.ended(event, result)
                progress(tracker.state())
    return [results.get(run.key) or lost(run, "it was never started") for run in runs]


def _check(runs: Any, store: Any, workers: Any, scheduler: Any) -> None:
    """Refuse what a program gave in place of runs, a store, a number of workers or an address."""
    from sphear.sweeps.plan import Run
    from sphear.sweeps.store import Store

    if not isinstance(runs, Iterable) or not all(isinstance(run, Run) for run in runs):
        raise SphearError(f"a sweep computes a list of runs, as plan(...) gives it, not {quoted(runs)}")
    if not isinstance(store, Store):
        raise SphearError(f"the results of a sweep are kept in a Store(folder), not in {quoted(store)}")
    if not isinstance(workers, int) or isinstance(workers, bool):
        raise SphearError(f"workers must be a whole number, at least 1, not {quoted(workers)}")
    if workers < 1:
        raise SphearError(f"workers must be at least 1, not {quoted(workers)}")
    if scheduler is not None and not isinstance(scheduler, str):
        raise SphearError(f"the address of a scheduler is text, such as tcp://host:8786, not {quoted(scheduler)}")


def _stored(
    runs: Sequence[Run], store: Store, say: Callable[[str], None]
) -> tuple[dict[str, SweepResult], dict[str, int]]:
    """The results that are taken as they are stored, and how often others have ended with an exception, by key."""
    results: dict[str, SweepResult] = {}
    attempts: dict[str, int] = {}
    wrong, again, given_up = [], [], []
    for run in {run.key: run for run in runs}.values():
        result, fault = store.read(run)
        if fault is not None:
            wrong.append(f"{store.path(run)}: {fault}")
        elif result is None:
            continue
        elif not result.lost or result.attempts >= ATTEMPTS:
            results[run.key] = result
            if result.lost:
                given_up.append(f"{store.path(run)}: {result.end.removeprefix('lost: ')}")
        else:
            attempts[run.key] = max(1, result.attempts)
            again.append(f"{store.path(run)}: {result.end.removeprefix('lost: ')}")
    for found, one, many in (
        (wrong, "1 stored result is not its run's and is", "{} stored results are not their runs' and are"),
        (again, "1 run that ended with an exception is", "{} runs that ended with an exception are"),
    ):
        if found:
            say(f"{one if len(found) == 1 else many.format(len(found))} computed again ({found[0]})")
    if given_up:
        which = "1 run has" if len(given_up) == 1 else f"{len(given_up)} runs have"
        say(f"{which} ended with an exception {ATTEMPTS} times; remove the file for another attempt ({given_up[0]})")
    return results, attempts


def _result(event: Finished | Lost, attempts: int) -> SweepResult:
    if isinstance(event, Lost):
        return lost(event.run, event.reason, attempts + 1 if event.of_itself else attempts)
    return of_record(event.record) or lost(event.run, "what came back is no result")
