"""A sweep: what is stored is taken, the rest is computed, each result stored as it comes."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import closing
from typing import TYPE_CHECKING

from sphear.errors import SphearError
from sphear.sweeps.cluster import on_cluster
from sphear.sweeps.events import Finished, Lost, Started
from sphear.sweeps.pool import on_processes
from sphear.sweeps.progress import Progress, Tracker, no_progress
from sphear.sweeps.result import SweepResult, lost, of_record
from sphear.sweeps.worker import COMPUTE

if TYPE_CHECKING:
    from sphear.sweeps.plan import Run
    from sphear.sweeps.store import Store


def run_sweep(
    runs: Sequence[Run],
    store: Store,
    *,
    workers: int = 1,
    scheduler: str | None = None,
    progress: Progress = no_progress,
    compute: str = COMPUTE,
    longest_first: bool = True,
) -> list[SweepResult]:
    """Compute runs that are not stored yet and store each as it ends.

    A run that is lost (its worker was killed, or something unexpected happened) is not stored; the others go on, and
    the next call computes it again. Ctrl-C ends the workers and keeps what is stored.

    Args:
        runs: what to compute; one that comes up again is computed once.
        store: where the results are kept.
        workers: processes of this machine, each of one thread.
        scheduler: address of a Dask scheduler, whose workers are used instead.
        progress: is told where the sweep stands, whenever that changes.
        compute: import path, `module:name`, of the function that computes a run from its case and settings.
        longest_first: the long ones first, so that all workers end together; else the short ones.

    Returns:
        The results, in the order of the runs.

    Raises:
        SphearError: settings do not go together, workers or the scheduler cannot be used, or a file not be written.
        KeyboardInterrupt: Ctrl-C.
    """
    if workers < 1:
        raise SphearError(f"workers must be at least 1, not {workers}")
    known = {run.key: store.get(run) for run in runs}
    results = {key: result for key, result in known.items() if result is not None}
    todo = list({run.key: run for run in runs if run.key not in results}.values())
    todo.sort(key=lambda run: run.cost, reverse=longest_first)
    tracker = Tracker(list(results.values()), todo)
    progress(tracker.state())
    if todo:
        source = on_cluster(todo, scheduler, compute) if scheduler else on_processes(todo, workers, compute)
        with closing(source) as events:
            for event in events:
                if isinstance(event, Started):
                    tracker.started(event)
                else:
                    results[event.run.key] = result = _result(event)
                    if not result.lost:
                        store.put(event.run, result)
                    tracker.ended(event, result)
                progress(tracker.state())
    return [results.get(run.key) or lost(run, "it was never started") for run in runs]


def _result(event: Finished | Lost) -> SweepResult:
    if isinstance(event, Lost):
        return lost(event.run, event.reason)
    return of_record(event.record) or lost(event.run, "what came back is no result")
