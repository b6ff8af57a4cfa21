"""A flow that is advanced in time, watched, and kept: to its end or to its failure."""

from __future__ import annotations

import math
import time
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from sphear.progress import no_progress
from sphear.schemes.base import Flow, FlowFailure
from sphear.schemes.watch import LOST, Watch, unresolved
from sphear.simulation.observers import Observer
from sphear.simulation.pace import Copies, Savings, Slices

Array = np.ndarray[Any, Any]
Kept = tuple[dict[str, Array], list[int], list[int]]  # a state, rows of each observer, and when each looked last

ROUND_OFF = 1e-12  # of a time
NEVER = -1


def aloud(text: str) -> None:
    """Warn."""
    warnings.warn(text, stacklevel=4)


class Run:
    """A flow in time with its observers.

    Args:
        flow: the state.
        watch: of what no fluid does; it began with the flow's particles at the start.
        observers: which look at the run, in this order.
        unit: of the time that is printed.
        time_name: how that is called.

    Attributes:
        end: "time", "steps", "failed: ..." or what else ended the run; empty while it goes on.
        seconds: spent in the time loop, its compilation not counted.
        unresolved: sentences that say what the particles do not resolve.
        saved: time of the state in the file; None where nothing was saved.
    """

    def __init__(
        self, flow: Flow, watch: Watch, observers: Sequence[Observer], unit: float = 1.0, time_name: str = "t"
    ) -> None:
        self.flow, self.watch, self.unit, self.time_name = flow, watch, unit, time_name
        self.unresolved = unresolved(flow.problem)
        self.observers = list(observers)
        self._judge: Observer | None = None  # looks before the others
        self.end = ""
        self.seconds = 0.0
        self.saved: float | None = None
        self._looked = [NEVER] * (len(self.observers) + 1)
        self._steps = math.inf  # to the planned end
        self._warned = self._begun = False

    def _begin(self) -> None:
        """Tell the observers of the start, and let those look that look there."""
        if self._begun:
            return
        self._begun = True
        for observer in self.observers:
            observer.start(self)
            if observer.at_start if observer.at_end else observer.due(self):
                observer.watch(self)

    def _to_end(
        self,
        until: float,
        max_steps: int,
        progress: Callable[[str], None] = no_progress,
        keep: Path | None = None,
        stopped: Callable[[], bool] = lambda: False,
        warn: Callable[[str], None] = aloud,
    ) -> None:
        """Advance to a time; a failure is an end too, and keeps all that was found.

        Between looks of the observers the run stops each half second, to listen; what it finds does not depend on that.

        Args:
            until: the time of the flow.
            max_steps: of the flow, from its start.
            progress: told where the run stands, twice a second.
            keep: a file that the state is saved to every 10 seconds, when the run is interrupted and when it ends;
                that of a run that failed is the last before it.
            stopped: asked twice a second; true interrupts the run.
            warn: told if the state cannot be saved, in one sentence; the run goes on.

        Raises:
            KeyboardInterrupt: Ctrl-C, after which the flow is that of the last copy, at most half a second back or a
                hundred times as long as a copy takes, or `stopped`; the flow can go on.
        """
        self._steps = min((until - self.flow.time) / self.flow.time_step + self.flow.steps, max_steps)
        slices, copies, savings = Slices(), Copies(), Savings(self._steps, self.flow.steps)
        safe = self._now()
        try:
            self.flow.advance(0)  # compiles
            while not self.end:
                if stopped():
                    safe = self._now()
                    raise KeyboardInterrupt
                self._advance(slices, until, max_steps)
                last = self.failed or self.flow.time >= until * (1 - ROUND_OFF) or self.flow.steps >= max_steps
                looked = self._look(last, again=self.failed)  # a step that broke down is none, and yet the end
                if self.failed:
                    break
                if last and not self.end:
                    self.end = "time" if self.flow.time >= until * (1 - ROUND_OFF) else "steps"
                began, save = time.monotonic(), keep is not None and savings.due(self.flow.steps)
                if looked or save or copies.due():
                    safe = self._now()
                    copies.taken(began)
                progress(self.standing())
                if keep is not None and save:
                    self._try_to_save(keep, safe, warn)
                    savings.tried(began, self.flow.steps)
            self._look(last=True)
            for observer in self.observers:
                observer.finish(self)
        except KeyboardInterrupt:  # Ctrl-C comes as the compiled loop returns, before the clock knows its steps
            self._go_back(safe)
            if keep is not None:
                self._try_to_save(keep, safe, warn, always=True)
            raise
        if keep is not None:
            self._try_to_save(keep, safe, warn, always=True)

    @property
    def _watching(self) -> list[Observer]:
        """The observers after the one that judges, if any does."""
        return self.observers if self._judge is None else [self._judge, *self.observers]

    def _now(self) -> Kept:
        """The state, a copy, and how far the observers are."""
        return self.flow.state(), [len(observer.rows) for observer in self._watching], list(self._looked)

    def _go_back(self, kept: Kept) -> None:
        """Return to where the run stood."""
        state, rows, self._looked = kept
        self.flow.restore(state)
        for observer, count in zip(self._watching, rows, strict=True):
            del observer.rows[count:]
        self.end = ""

    @property
    def failed(self) -> bool:
        """True if the run broke down."""
        return self.end.startswith("failed")

    def _look(self, last: bool, again: bool = False) -> bool:
        """Let all look for whom it is time, at the end all that look there and have not yet; whether anyone did.

        Args:
            last: at the end.
            again: of a flow that broke down, all that look at the end, also those that looked at this step.
        """
        anyone = False
        for number, observer in enumerate(self._watching):
            unseen = self._looked[number] != self.flow.steps
            usual = unseen and ((last and observer.at_end) or observer.due(self))
            if again or usual:
                self._looked[number] = self.flow.steps
            if observer.at_end if again else usual:  # what broke down is no flow at a time that was chosen
                observer.watch(self)
                anyone = True
        return anyone

    def _advance(self, slices: Slices, until: float, max_steps: int) -> None:
        """Make the steps of a slice, to the next look at most; a failure is the end."""
        # where a step ends at `until`, round-off must not ask for one more
        left = max(1.0, np.ceil((until - self.flow.time) / self.flow.time_step - 1e-6))
        looks = (observer.until_next(self) for observer in self._watching)
        wanted = int(min(left, max_steps - self.flow.steps, slices.steps, *looks))
        began = time.perf_counter()
        try:
            self.flow.advance(wanted)
        except FlowFailure as failure:
            self.end = f"failed: {failure}"
        taken = time.perf_counter() - began
        self.seconds += taken
        slices.measured(wanted, taken)

    def standing(self) -> str:
        """The time and steps reached, the share that is done and the seconds that are left, in words."""
        flow, whole = self.flow, math.isfinite(self._steps)
        left = (self._steps - flow.steps) * self.seconds / max(1, flow.steps) if whole else 0.0
        ending = f", {left:.0f} s left" if left > 1 else ""
        share = f", {min(1.0, flow.steps / self._steps):.0%}" if whole else ""
        return f"{self.time_name} = {flow.time / self.unit:.4g}, step {flow.steps}{share}{ending}"

    def implausible(self) -> str:
        """The end of a flow that does what no fluid does, else nothing."""
        fault = self.watch.fault(self.flow)
        if fault is None:
            return ""
        return f"failed: the flow failed at t = {self.flow.time:g}: {fault}, as when particles do not resolve it"

    @property
    def warnings(self) -> list[str]:
        """Sentences that say what is not resolved, and of how much energy the discretisation took."""
        lost = -self._least_residual()
        if not lost > LOST:
            return self.unresolved
        taken = f"the discretisation took {lost:.2g} of the energy that was there and turned over"
        return [*self.unresolved, f"{taken}: a finer resolution takes less"]

    def _least_residual(self) -> float:
        """The least residual of the energy budget that anyone saw."""
        rows = (row for observer in self.observers for row in observer.rows if isinstance(row, dict))
        return min((row.get("energy_residual", 0.0) for row in rows), default=0.0)

    def save(self, path: str | Path) -> None:
        """Write all that the run needs to go on to a file, an `.npz` of NumPy; the file before is kept beside it.

        Raises:
            OSError: it cannot be written.
        """
        self._save(Path(path), self._now())

    def _save(self, path: Path, kept: Kept) -> None:
        raise NotImplementedError

    def _try_to_save(self, path: Path, kept: Kept, warn: Callable[[str], None], always: bool = False) -> None:
        """Save a state with its rows of the history; a run goes on without, and says so once, or always."""
        try:
            self._save(path, kept)
        except OSError as error:
            if always or not self._warned:
                there = "" if self.saved is None else f", which has that of {self.time_name} = {self.saved:.4g}"
                again = "" if always else ", the run goes on and tries again"
                warn(f"the state cannot be saved in {path}{there}: {error.strerror or error}{again}")
            self._warned = True
