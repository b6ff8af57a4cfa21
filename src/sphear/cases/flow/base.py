"""What all flows share: a run that is advanced from one output to the next until it ends or fails."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from sphear.boundaries import WALL_VELOCITIES
from sphear.corrections import CORRECTIONS
from sphear.kernels import KERNELS
from sphear.schemes.settings import FlowSettings
from sphear.schemes.flow import Flow, FlowFailure
from sphear.schemes.problem import Problem
from sphear.viscosity import VISCOSITY

Array = np.ndarray[Any, Any]

OUTPUTS = 200  # of a run to its planned end


@dataclass(frozen=True)
class FlowCase:
    """A flow with a reference solution.

    Attributes:
        name: on the command line.
        defaults: settings that differ from the general ones.
        problem: what is to be computed, from the settings.
        exact: the reference velocity (N, d) at positions (N, d) and a time.
        time_unit: what `until` and the printed times are multiples of, from the settings.
        time_name: how that time is called.
        metrics: errors and the like at one moment, by name.
        ended: why a run is over at one moment, from its metrics: "steady", "failed: ..." or None.
    """

    name: str
    defaults: dict[str, Any]
    problem: Callable[[FlowSettings], Problem]
    exact: Callable[[FlowSettings, Array, float], Array]
    time_unit: Callable[[FlowSettings], float]
    time_name: str
    metrics: Callable[[FlowSettings, Flow], dict[str, float]]
    ended: Callable[[FlowSettings, Flow, dict[str, float]], str | None]

    def settings(self, **changes: Any) -> FlowSettings:
        """The settings of this case with some changed."""
        return FlowSettings.model_validate({**self.defaults, **changes})


@dataclass
class FlowRun:
    """A run of a case: where it stands, and what was found at each output.

    Attributes:
        flow: the state.
        history: a row for each output: time in the unit of the case, steps and the metrics.
        end: "steady", "time", "steps" or "failed: ..."; empty while it goes on.
        seconds: spent in the time loop, its compilation not counted.
    """

    case: FlowCase
    settings: FlowSettings
    history: list[dict[str, float]] = field(default_factory=list)
    end: str = ""
    seconds: float = 0.0

    def __post_init__(self) -> None:
        self.flow = Flow(self.case.problem(self.settings), self.settings)
        self.unit = self.case.time_unit(self.settings)

    def run(self, progress: Callable[[str], None] = lambda text: None) -> FlowRun:
        """Advance until the end; a failure is an end too, and keeps all that was found."""
        self.flow.advance(0)  # compiles
        planned = np.inf if self.settings.until is None else self.settings.until * self.unit
        horizon = min(planned / self.flow.time_step, self.settings.max_steps)
        every = int(np.clip(horizon / OUTPUTS, 1, 1000))
        while not self.end:
            left = min(
                self.settings.max_steps - self.flow.steps, np.ceil((planned - self.flow.time) / self.flow.time_step)
            )
            began = time.perf_counter()
            try:
                self.flow.advance(int(min(every, max(1, left))))
            except FlowFailure as failure:
                self.end = f"failed: {failure}"
            self.seconds += time.perf_counter() - began
            self._observe(planned)
            progress(f"{self.case.time_name} = {self.history[-1]['time']:.4g}, step {self.flow.steps}")
        return self

    def _observe(self, planned: float) -> None:
        metrics = self.case.metrics(self.settings, self.flow)
        self.history.append({"time": self.flow.time / self.unit, "steps": self.flow.steps, **metrics})
        if self.end:
            return
        self.end = self.case.ended(self.settings, self.flow, metrics) or ""
        if not self.end and self.flow.time >= planned * (1 - 1e-12):
            self.end = "time"
        elif not self.end and self.flow.steps >= self.settings.max_steps:
            self.end = "steps"

    def as_dict(self) -> dict[str, Any]:
        """Case, resolved settings, metrics and performance, as `--json` prints them."""
        flow, settings = self.flow, self.settings
        resolved = {
            "viscosity": VISCOSITY.name(settings.viscosity),
            "correction": CORRECTIONS.name(settings.correction),
            "kernel": KERNELS.name(settings.kernel),
            "wall_velocity": WALL_VELOCITIES.name(settings.wall_velocity),
            "h_over_dx": flow.kernel.h / flow.problem.spacing,
            "sound_speed": flow.sound_speed,
            "time_step": flow.time_step,
            "kinematic_viscosity": flow.problem.kinematic_viscosity,
        }
        last = self.history[-1]
        failed = self.end.startswith("failed")
        return {
            "case": self.case.name,
            "settings": {**settings.model_dump(mode="json"), **resolved},
            "metrics": {**last, "end": self.end, "failure_time": last["time"] if failed else None},
            "performance": {
                "particles": len(flow.positions),
                "steps": flow.steps,
                "seconds": self.seconds,
                "particle_steps_per_second": len(flow.positions) * flow.steps / max(self.seconds, 1e-9),
            },
        }
