"""What all flows share: what a case is made of."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from sphear.schemes.flow import Flow
from sphear.schemes.problem import Problem
from sphear.schemes.settings import FlowSettings

Array = np.ndarray[Any, Any]


class Comparison(NamedTuple):
    """A profile beside its reference.

    along: the name of the coordinate.
    at, values: of the computed one.
    reference_at, reference: of the other, empty where there is none.
    """

    along: str
    at: Array
    values: Array
    reference_at: Array
    reference: Array


@dataclass(frozen=True)
class FlowCase:
    """A flow with a reference solution.

    Attributes:
        name: on the command line.
        defaults: settings that differ from the general ones.
        problem: what is to be computed, from the settings.
        comparisons: profiles beside the reference, by name.
        time_unit: what `until` and the printed times are multiples of, from the settings.
        time_name: how that time is called.
        metrics: errors and the like at one moment, by name.
        ended: why a run is over at one moment, from its metrics: "steady", "failed: ..." or None.
        summary: what is found at the end, beside the metrics.
        profiles: numbers along lines, at the end, that are kept with the results of a sweep.
        headline: the metric that is drawn against time.
        horizon: when a run without `until` is expected to end, in the time unit; None if it has no end of its own.
    """

    name: str
    defaults: dict[str, Any]
    problem: Callable[[FlowSettings], Problem]
    comparisons: Callable[[FlowSettings, Flow], dict[str, Comparison]]
    time_unit: Callable[[FlowSettings], float]
    time_name: str
    metrics: Callable[[FlowSettings, Flow], dict[str, float]]
    ended: Callable[[FlowSettings, Flow, dict[str, float]], str | None]
    summary: Callable[[FlowSettings, Flow], dict[str, float]] = lambda settings, flow: {}
    profiles: Callable[[FlowSettings, Flow], dict[str, list[float]]] = lambda settings, flow: {}
    headline: str = "rms_error"
    horizon: float | None = None

    def settings(self, **changes: Any) -> FlowSettings:
        """The settings of this case with some changed."""
        return FlowSettings.model_validate({**self.defaults, **changes})
