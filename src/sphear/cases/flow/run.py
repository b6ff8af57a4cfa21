"""A run of a case: advanced from one output to the next until it ends or fails; kept, and gone on with."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from sphear.cases.flow.base import FlowCase, Settings
from sphear.cases.flow.own_walls import opened
from sphear.cases.flow.saved import About, read, write
from sphear.errors import SphearError
from sphear.schemes.base import FlowFailure, flow_in_time
from sphear.schemes.named import named

OUTPUTS = 200  # of a run to its planned end
SAVED_EVERY = 60.0  # seconds


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

    Raises:
        SphearError: the settings do not fit the case or each other.
    """

    def __init__(self, case: FlowCase, settings: Settings) -> None:
        settings = named(settings)
        self.case, self.settings = opened(case, settings), settings
        self.flow = flow_in_time(self.case.problem(settings), settings)
        self.unit = case.time_unit(settings)
        self.history: list[dict[str, float]] = []
        self.end = ""
        self.seconds = 0.0

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

    def run(self, progress: Callable[[str], None] = lambda text: None, keep: Path | None = None) -> FlowRun:
        """Advance until the end; a failure is an end too, and keeps all that was found.

        Args:
            progress: told where the run stands, at each output.
            keep: a file that the state is saved to now and then, and when the run is interrupted.
        """
        steps = min(self.planned * self.unit / self.flow.time_step, self.settings.max_steps)
        every = int(np.clip(steps / OUTPUTS, 1, 1000))
        until = np.inf if self.settings.until is None else self.settings.until * self.unit
        saved = time.monotonic()
        output = self.flow.state(), len(self.history)
        if self.history and not self.end:  # gone on with: it may have been interrupted at its last output
            self.end = self._verdict(self.history[-1], until)
        try:
            self.flow.advance(0)  # compiles
            while not self.end:
                left = min(
                    self.settings.max_steps - self.flow.steps, np.ceil((until - self.flow.time) / self.flow.time_step)
                )
                began = time.perf_counter()
                try:
                    self.flow.advance(int(min(every, max(1, left))))
                except FlowFailure as failure:
                    self.end = f"failed: {failure}"
                self.seconds += time.perf_counter() - began
                self._observe(until)
                output = self.flow.state(), len(self.history)
                progress(self._standing(steps))
                if keep is not None and time.monotonic() - saved > SAVED_EVERY:
                    self.save(keep)
                    saved = time.monotonic()
        except KeyboardInterrupt:
            state, rows = output  # Ctrl-C comes as the compiled loop returns, before the clock knows its steps
            self.flow.restore(state)
            del self.history[rows:]
            if keep is not None:
                self.save(keep)
            raise
        return self

    def _standing(self, steps: float) -> str:
        left = (min(steps, self.settings.max_steps) - self.flow.steps) * self.seconds / max(1, self.flow.steps)
        ending = f", {left:.0f} s left" if np.isfinite(left) and left > 1 else ""
        return f"{self.case.time_name} = {self.history[-1]['time']:.4g}, step {self.flow.steps}{ending}"

    def _observe(self, until: float) -> None:
        with np.errstate(all="ignore"):  # also of a flow that broke down
            metrics = {**self.case.metrics(self.settings, self.flow), **self.flow.metrics()}
        self.history.append({"time": self.flow.time / self.unit, "steps": self.flow.steps, **metrics})
        self.end = self.end or self._verdict(metrics, until)

    def _verdict(self, metrics: dict[str, float], until: float) -> str:
        """How the run has ended, where it stands; empty if it goes on."""
        if said := self.case.ended(self.settings, self.flow, metrics):
            return said
        if self.flow.time >= until * (1 - 1e-12):
            return "time"
        return "steps" if self.flow.steps >= self.settings.max_steps else ""

    def save(self, path: Path) -> None:
        """Write all that the run needs to go on to a file, an `.npz` of NumPy."""
        about = About(
            case=self.case.name,
            settings=self.settings.model_dump(mode="json"),
            history=self.history,
            seconds=self.seconds,
        )
        write(path, about, self.flow.state())

    def restore(self, path: Path) -> None:
        """Go on from a file that `save` wrote.

        Raises:
            SphearError: it cannot be read, or is of another run.
        """
        about, state = read(path)
        was, (time, steps) = about.settings, about.reached
        now = self.settings.model_dump(mode="json")
        changed = [
            key
            for key, value in now.items()
            if was.get(key) != value and key not in ("until", "max_steps", "threads", "force")
        ]
        if about.case != self.case.name:
            raise SphearError(f"the saved run in {path} is of {about.case}, not of {self.case.name}")
        if changed:
            raise SphearError(
                f"the saved run in {path} has {changed[0]} = {was.get(changed[0])}, not {now[changed[0]]}"
            )
        settings, step = self.settings, 1.001 * self.flow.time_step / self.unit  # a run ends within one of its time
        for name, last, reached in (("until", settings.until, time - step), ("max_steps", settings.max_steps, steps)):
            if last is not None and reached > last:
                raise SphearError(f"the saved run in {path} is already at {reached:g}, beyond {name} = {last:g}")
        self.flow.restore(state)
        self.history, self.seconds = about.history, about.seconds

    def as_dict(self) -> dict[str, Any]:
        """Case, resolved settings, metrics and performance, as `--json` prints them."""
        flow, settings = self.flow, self.settings
        last = self.history[-1]
        failed = self.end.startswith("failed")
        summary = {} if failed else self.case.summary(settings, flow)
        profiles = {} if failed else self.case.profiles(settings, flow)
        return {
            "case": self.case.name,
            "settings": {**settings.model_dump(mode="json"), **flow.resolved()},
            "metrics": {**last, **summary, "end": self.end, "failure_time": last["time"] if failed else None},
            **({"profiles": profiles} if profiles else {}),
            "performance": {
                "particles": len(flow.positions),
                "steps": flow.steps,
                "seconds": self.seconds,
                "particle_steps_per_second": len(flow.positions) * flow.steps / max(self.seconds, 1e-9),
            },
        }
