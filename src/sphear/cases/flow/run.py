"""A run of a case: its own history and comparisons are what it is watched for."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.cases.flow.base import Case, Settings
from sphear.cases.flow.history import CaseHistory, nothing
from sphear.cases.flow.own_walls import opened
from sphear.names import unknown
from sphear.progress import no_progress
from sphear.schemes.base import flow_of
from sphear.schemes.registered_names import named
from sphear.schemes.watch import Watch
from sphear.simulation.observers import Observer
from sphear.simulation.observers.base import check_observer
from sphear.simulation.run import ROUND_OFF, Kept, Run, aloud
from sphear.simulation.saved import About, check, read, write
from sphear.versions import versions

if TYPE_CHECKING:
    Array = np.ndarray[Any, Any]

FAILED = "failed"  # how ends begin that are failures
OUTPUTS = 200  # of a run to its planned end
SELDOM = 1000  # steps between two outputs, at most


class CaseRun(Run):
    """A run of a case: where it stands, and what was found at each output.

    Args:
        case: what is computed.
        settings: of the case and the scheme.
        observers: which look at the run, at intervals or times of the flow, `unit` times those that are printed.
        beyond: ends of the case that the run goes on beyond: "steady", "failed", which is too large an error or what no
            fluid does, or another. A flow that breaks down ends, and so does one at its time or its most steps.
        measured: gives numbers by name beside those of the case, for each row of the history.

    Attributes:
        flow: the state.
        history: a row for each output: time in the unit of the case, steps and the metrics.
        end: "steady", "time", "steps", "failed: ..." or what else the case ends at; empty while it goes on.
        seconds: spent in the time loop, its compilation not counted.
        unresolved: sentences that say what the particles do not resolve.
        saved: time of the state in the file, in the unit of the case; None where nothing was saved.

    Raises:
        SphearError: the settings do not fit the case or each other, or there is no such end.

    Examples:
        >>> import sphear
        >>> run = sphear.flow("cavity", scheme="incompressible", resolution=10, until=0.05)
        >>> isinstance(run, sphear.CaseRun), run.end
        (True, '')
        >>> run = run.run()
        >>> run.end, run.flow.steps, run.flow.velocities.shape
        ('time', 1, (100, 2))
    """

    def __init__(
        self,
        case: Case,
        settings: Settings,
        *,
        observers: Sequence[Observer] = (),
        beyond: Collection[str] = (),
        measured: Callable[[CaseRun], Mapping[str, float]] = nothing,
    ) -> None:
        for observer in observers:
            check_observer(observer)
        for end in beyond:
            if end not in (ends := ("steady", FAILED, *case.ends)):
                raise unknown(f"end of {case.name} to go on beyond", end, ends)
        settings = named(settings)
        self.beyond, self.measured = frozenset(beyond), measured
        self.case, self.settings = opened(case, settings), settings
        problem = self.case.problem(settings)
        unit = case.time_unit(settings)
        flow = flow_of(problem, settings, self.planned * unit)
        super().__init__(flow, Watch(problem), (CaseHistory(), *observers), unit, case.time_name)

    def __repr__(self) -> str:
        """The case, its settings in short, and the time reached."""
        settings, viscosity = self.settings, self.flow.resolved()["viscosity"]
        where = f"{self.case.time_name} = {self.flow.time / self.unit:.4g}, step {self.flow.steps}"
        return (
            f"<CaseRun of {self.case.name}: {settings.scheme}, {viscosity}, Re = {settings.reynolds:g},"
            f" {self.flow.count} particles, {where}{f', end: {self.end}' if self.end else ''}>"
        )

    @property
    def history(self) -> list[dict[str, float]]:
        """Rows of numbers by name, one for each output: time in the unit of the case, steps and the metrics."""
        return self.observers[0].rows

    @history.setter
    def history(self, rows: list[dict[str, float]]) -> None:
        self.observers[0].rows = rows

    @property
    def planned(self) -> float:
        """The time at which the run is expected to end, in the unit of the case; infinite if nothing says."""
        horizon = self.case.horizon if self.settings.until is None else self.settings.until
        return np.inf if horizon is None else horizon

    @property
    def until(self) -> float:
        """The time of the flow at which the run ends; infinite where only the case says."""
        return np.inf if self.settings.until is None else self.settings.until * self.unit

    def run(
        self,
        progress: Callable[[str], None] = no_progress,
        keep: str | Path | None = None,
        *,
        stopped: Callable[[], bool] = lambda: False,
        warn: Callable[[str], None] = aloud,
    ) -> CaseRun:
        """Advance until the end; a failure is an end too, and keeps all that was found.

        Outputs are a number of steps apart that follows from the planned end, counted from the start, and one is at
        the end. Between them the run stops each half second, to listen; what it finds does not depend on that.

        Args:
            progress: told where the run stands, twice a second.
            keep: a file that the state is saved to every 10 seconds, when the run is interrupted and when it ends;
                that of a run that failed is the last before it.
            stopped: asked twice a second; true interrupts the run.
            warn: told if the state cannot be saved, in one sentence; the run goes on.

        Raises:
            KeyboardInterrupt: Ctrl-C, after which the flow is that of the last copy, at most half a second back or a
                hundred times as long as a copy takes, or `stopped`; the flow can go on.
        """
        self._begin()
        steps = min(self.planned * self.unit / self.flow.time_step, self.settings.max_steps)
        self.observers[0].steps = int(np.clip(steps / OUTPUTS, 1, SELDOM))
        if self._recorded and not self.end:  # gone on with: it may have been interrupted at its last output
            self._looked[0] = self.flow.steps
            self.end = self.verdict(self.history[-1])
        file = None if keep is None else Path(keep)
        self._to_end(self.until, self.settings.max_steps, progress, file, stopped, warn)
        return self

    @property
    def _recorded(self) -> bool:
        """True if the last output is of now."""
        return bool(self.history) and self.history[-1]["steps"] == self.flow.steps

    def verdict(self, metrics: dict[str, float]) -> str:
        """The end of the run at the time reached; empty if it goes on."""
        said = self.case.ended(self.settings, self.flow, metrics)
        if said and said.partition(":")[0] not in self.beyond:
            return said
        if self.flow.time >= self.until * (1 - ROUND_OFF):
            return "time"
        return "steps" if self.flow.steps >= self.settings.max_steps else ""

    def implausible(self) -> str:
        """The end of a flow that does what no fluid does, if the run does not go on beyond that; else nothing."""
        return "" if FAILED in self.beyond else super().implausible()

    def _save(self, path: Path, kept: Kept) -> None:
        state, rows, _ = kept
        about = About(
            case=self.case.name,
            settings=self.settings.model_dump(mode="json"),
            history=self.history[: rows[0]],
            seconds=self.seconds,
            end="" if self.failed else self.end,
        )
        write(path, about, state)
        self.saved = float(state["clock"][0]) / self.unit

    def restore(self, path: str | Path) -> None:
        """Go on from a file that `save` wrote.

        Raises:
            SphearError: it cannot be read, or is of another run.
        """
        path = Path(path)
        about, state = read(path)
        reached = float(state["clock"][0]) / self.unit
        step = 1.001 * self.flow.time_step / self.unit  # a run ends within one of its time
        now = self.settings.model_dump(mode="json")
        check(path, about, self.case.name, now, {"until": reached - step, "max_steps": int(state["clock"][1])})
        self.flow.restore(state)
        self.history, self.seconds, self.end, self.saved = about.history, about.seconds, "", reached

    def as_dict(self) -> dict[str, Any]:
        """Case, resolved settings, metrics and performance, as `--json` prints them."""
        flow, settings = self.flow, self.settings
        last = self.history[-1]
        failed = self.failed
        summary = {} if failed else self.case.summary(settings, flow)
        profiles = {} if failed else self.case.profiles(settings, flow)
        return {
            "case": self.case.name,
            "settings": {**settings.model_dump(mode="json"), **flow.resolved()},
            "metrics": {**last, **summary, "end": self.end, "failure_time": last["time"] if failed else None},
            **({"profiles": profiles} if profiles else {}),
            "warnings": self.warnings,
            "versions": versions(),
            "performance": {
                "particles": len(flow.positions),
                "steps": flow.steps,
                "seconds": self.seconds,
                "particle_steps_per_second": len(flow.positions) * flow.steps / max(self.seconds, 1e-9),
            },
        }
