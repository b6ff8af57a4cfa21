"""The progress of a sweep, and the time that is left."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from sphear.sweeps.events import Event, Started
from sphear.sweeps.plan import Run
from sphear.sweeps.result import SweepResult


@dataclass(frozen=True)
class SweepProgress:
    """The standing of a sweep.

    Attributes:
        runs: all of them.
        done: with a result, failed ones and those stored before included.
        stored: with a result from before.
        running: with a worker.
        failed: flows that broke down.
        lost: without a result; run again next time.
        seconds_left: estimated from the runs that have ended; None before there are any.
    """

    runs: int
    done: int
    stored: int
    running: int
    failed: int
    lost: int
    seconds_left: float | None

    def __str__(self) -> str:
        parts = [f"{self.done} of {self.runs} runs done", f"{self.running} running"]
        parts += [f"{count} {what}" for what, count in (("failed", self.failed), ("lost", self.lost)) if count]
        if self.seconds_left is not None:
            parts.append(f"about {_duration(self.seconds_left)} left")
        return ", ".join(parts)


Progress = Callable[[SweepProgress], None]


@dataclass
class Tracker:
    """Counts what happens in a sweep, and times it.

    Attributes:
        stored: results from before.
        todo: what is to be computed.
    """

    stored: Iterable[SweepResult]
    todo: Iterable[Run]
    clock: Callable[[], float] = time.monotonic
    _ended: list[tuple[float, float]] = field(default_factory=list)  # cost and seconds of runs with a result
    _began: dict[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._results = list(self.stored)
        self._before = len(self._results)
        self._costs = {run.key: run.cost for run in self.todo}
        self._runs = self._before + len(self._costs)
        self._abreast = 1

    def started(self, event: Started) -> None:
        """A run is with a worker."""
        self._began[event.run.key] = self.clock()
        self._abreast = max(self._abreast, len(self._began))

    def ended(self, event: Event, result: SweepResult) -> None:
        """A run has a result, or is lost."""
        cost, began = self._costs.pop(event.run.key), self._began.pop(event.run.key)
        self._results.append(result)
        if not result.lost:
            self._ended.append((cost, self.clock() - began))

    def state(self) -> SweepProgress:
        """The standing of the sweep now."""
        lost = sum(result.lost for result in self._results)
        return SweepProgress(
            runs=self._runs,
            done=len(self._results) - lost,
            stored=self._before,
            running=len(self._began),
            failed=sum(result.failed for result in self._results),
            lost=lost,
            seconds_left=self._left(),
        )

    def _left(self) -> float | None:
        """The time of the other runs at the speed of those that have ended, shared among the workers."""
        if not self._ended:
            return None
        pace = sum(seconds for _, seconds in self._ended) / sum(cost for cost, _ in self._ended)
        passed = {key: self.clock() - began for key, began in self._began.items()}
        each = [max(0.0, pace * cost - passed.get(key, 0.0)) for key, cost in self._costs.items()]
        return max(sum(each) / self._abreast, max(each, default=0.0))


def _duration(seconds: float) -> str:
    for unit, size in (("h", 3600), ("min", 60)):
        if seconds >= 2 * size:
            return f"{seconds / size:.0f} {unit}"
    return f"{seconds:.0f} s"
