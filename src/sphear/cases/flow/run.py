"""A run of a case: advanced from one output to the next until it ends or fails; kept, and gone on with."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from sphear.cases.flow.base import FlowCase, Settings
from sphear.cases.flow.own_walls import opened
from sphear.cases.flow.pace import Copies, Savings, Slices
from sphear.cases.flow.saved import About, check, read, write
from sphear.schemes.base import FlowFailure, flow_in_time
from sphear.schemes.named import named
from sphear.schemes.watch import LOST, Watch, unresolved
from sphear.versions import versions

Array = np.ndarray[Any, Any]

OUTPUTS = 200  # of a run to its planned end
ROUND_OFF = 1e-12  # of a time


class FlowRun:
    """A run of a case: where it stands, and what was found at each output.

    Args:
        case: what is computed.
        settings: how.

    Attributes:
        flow: the state.
        history: a row for each output: time in the unit of the case, steps and the metrics.
        end: "steady", "time", "steps", "failed: ..." or what else the case ends at; empty while it goes on.
        seconds: spent in the time loop, its compilation not counted.
        unresolved: sentences that say what the particles do not resolve.
        saved: time of the state in the file, in the unit of the case; None where nothing was saved.

    Raises:
        SphearError: the settings do not fit the case or each other.
    """

    def __init__(self, case: FlowCase, settings: Settings) -> None:
        settings = named(settings)
        self.case, self.settings = opened(case, settings), settings
        problem = self.case.problem(settings)
        self.unit = case.time_unit(settings)
        self.flow = flow_in_time(problem, settings, self.planned * self.unit)
        self.watch, self.unresolved = Watch(problem), unresolved(problem)
        self.history: list[dict[str, float]] = []
        self.end = ""
        self.seconds = 0.0
        self.saved: float | None = None
        self._warned = False

    def __repr__(self) -> str:
        """What is computed, how, and where it stands."""
        settings, viscosity = self.settings, self.flow.resolved()["viscosity"]
        where = f"{self.case.time_name} = {self.flow.time / self.unit:.4g}, step {self.flow.steps}"
        return (
            f"<FlowRun of {self.case.name}: {settings.scheme}, {viscosity}, Re = {settings.reynolds:g},"
            f" {self.flow.count} particles, {where}{f', end: {self.end}' if self.end else ''}>"
        )

    @property
    def planned(self) -> float:
        """When the run is expected to end, in the time unit of the case; infinite if nothing says."""
        horizon = self.case.horizon if self.settings.until is None else self.settings.until
        return np.inf if horizon is None else horizon

    def run(
        self,
        progress: Callable[[str], None] = lambda text: None,
        keep: Path | None = None,
        *,
        stopped: Callable[[], bool] = lambda: False,
        warn: Callable[[str], None] = lambda text: warnings.warn(text, stacklevel=3),
    ) -> FlowRun:
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
        steps = min(self.planned * self.unit / self.flow.time_step, self.settings.max_steps)
        every = int(np.clip(steps / OUTPUTS, 1, 1000))
        until = np.inf if self.settings.until is None else self.settings.until * self.unit
        slices, copies, savings = Slices(), Copies(), Savings(steps, self.flow.steps)
        safe = self._now()
        if self._recorded and not self.end:  # gone on with: it may have been interrupted at its last output
            self.end = self._verdict(self.history[-1], until)
        try:
            self.flow.advance(0)  # compiles
            while not self.end:
                if stopped():
                    safe = self._now()
                    raise KeyboardInterrupt
                if not self._due(every, until):
                    self._advance(slices, every, until)
                if output := self._failed or self._due(every, until):
                    self._observe(until)
                if self._failed:
                    break
                began, save = time.monotonic(), keep is not None and savings.due(self.flow.steps)
                if output or save or copies.due():
                    safe = self._now()
                    copies.taken(began)
                progress(self._standing(steps))
                if keep is not None and save:
                    self._try_to_save(keep, safe, warn)
                    savings.tried(began, self.flow.steps)
        except KeyboardInterrupt:
            state, rows = safe  # Ctrl-C comes as the compiled loop returns, before the clock knows its steps
            self.flow.restore(state)
            del self.history[rows:]
            self.end = ""
            if keep is not None:
                self._try_to_save(keep, safe, warn, always=True)
            raise
        if keep is not None:
            self._try_to_save(keep, safe, warn, always=True)
        return self

    def _now(self) -> tuple[dict[str, Array], int]:
        """The state, a copy, and how many rows of the history belong to it."""
        return self.flow.state(), len(self.history)

    @property
    def _failed(self) -> bool:
        return self.end.startswith("failed")

    @property
    def _recorded(self) -> bool:
        """Whether the last output is of now."""
        return bool(self.history) and self.history[-1]["steps"] == self.flow.steps

    def _due(self, every: int, until: float) -> bool:
        """Whether there is an output now."""
        steps = self.flow.steps
        last = steps >= self.settings.max_steps or self.flow.time >= until * (1 - ROUND_OFF)
        return steps > 0 and (last or steps % every == 0) and not self._recorded

    def _advance(self, slices: Slices, every: int, until: float) -> None:
        """Make the steps of a slice, to the next output at most; a failure is the end."""
        made = self.flow.steps
        # where a step ends at `until`, round-off must not ask for one more
        left = max(1.0, np.ceil((until - self.flow.time) / self.flow.time_step - 1e-6))
        wanted = int(min(every - made % every, left, self.settings.max_steps - made, slices.steps))
        began = time.perf_counter()
        try:
            self.flow.advance(wanted)
        except FlowFailure as failure:
            self.end = f"failed: {failure}"
        taken = time.perf_counter() - began
        self.seconds += taken
        slices.measured(wanted, taken)

    def _standing(self, steps: float) -> str:
        flow, last = self.flow, min(steps, self.settings.max_steps)
        left = (last - flow.steps) * self.seconds / max(1, flow.steps)
        ending = f", {left:.0f} s left" if np.isfinite(left) and left > 1 else ""
        share = f", {min(1.0, flow.steps / last):.0%}" if np.isfinite(self.planned) else ""
        return f"{self.case.time_name} = {flow.time / self.unit:.4g}, step {flow.steps}{share}{ending}"

    def _observe(self, until: float) -> None:
        with np.errstate(all="ignore"):  # also of a flow that broke down
            metrics = {**self.case.metrics(self.settings, self.flow), **self.flow.metrics()}
        self.history.append({"time": self.flow.time / self.unit, "steps": self.flow.steps, **metrics})
        self.end = self.end or self._implausible() or self._verdict(metrics, until)

    def _implausible(self) -> str:
        found = self.watch.found(self.flow)
        if found is None:
            return ""
        return f"failed: the flow failed at t = {self.flow.time:g}: {found}, as when particles do not resolve it"

    @property
    def warnings(self) -> list[str]:
        """Sentences that say what is not resolved, and of how much energy the discretisation took."""
        lost = -min((row.get("energy_residual", 0.0) for row in self.history), default=0.0)
        if not lost > LOST:
            return self.unresolved
        taken = f"the discretisation took {lost:.2g} of the energy that was there and turned over"
        return [*self.unresolved, f"{taken}: a finer resolution takes less"]

    def _verdict(self, metrics: dict[str, float], until: float) -> str:
        """How the run has ended, where it stands; empty if it goes on."""
        if said := self.case.ended(self.settings, self.flow, metrics):
            return said
        if self.flow.time >= until * (1 - ROUND_OFF):
            return "time"
        return "steps" if self.flow.steps >= self.settings.max_steps else ""

    def save(self, path: Path) -> None:
        """Write all that the run needs to go on to a file, an `.npz` of NumPy; the file before is kept beside it.

        Raises:
            OSError: it cannot be written.
        """
        self._save(path, self._now())

    def _save(self, path: Path, kept: tuple[dict[str, Array], int]) -> None:
        state, rows = kept
        about = About(
            case=self.case.name,
            settings=self.settings.model_dump(mode="json"),
            history=self.history[:rows],
            seconds=self.seconds,
            end="" if self._failed else self.end,
        )
        write(path, about, state)
        self.saved = float(state["clock"][0]) / self.unit

    def _try_to_save(
        self, path: Path, kept: tuple[dict[str, Array], int], warn: Callable[[str], None], always: bool = False
    ) -> None:
        """Save a state with its rows of the history; a run goes on without, and says so once, or always."""
        try:
            self._save(path, kept)
        except OSError as error:
            if always or not self._warned:
                there = "" if self.saved is None else f", which has that of {self.case.time_name} = {self.saved:.4g}"
                again = "" if always else ", the run goes on and tries again"
                warn(f"the state cannot be saved in {path}{there}: {error.strerror or error}{again}")
            self._warned = True

    def restore(self, path: Path) -> None:
        """Go on from a file that `save` wrote.

        Raises:
            SphearError: it cannot be read, or is of another run.
        """
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
        failed = self._failed
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
