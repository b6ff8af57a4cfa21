"""What all flows share: what a case is made of."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from sphear.errors import SphearError, shortened
from sphear.schemes.base import FlowInTime, Settings, settings_type
from sphear.schemes.presets import BY_SCHEME, preset_settings
from sphear.schemes.problem import Problem
from sphear.schemes.settings import FlowSettings

__all__ = ["Comparison", "FlowCase", "FlowInTime", "Settings", "kinetic_energy"]

Array = np.ndarray[Any, Any]


def kinetic_energy(flow: FlowInTime) -> float:
    """That of a plane flow, of a unit of depth."""
    problem = flow.problem
    return float(0.5 * (flow.velocities**2).sum() * problem.spacing**2 * problem.density)


class Comparison(NamedTuple):
    """A profile beside its reference.

    along: the name of the coordinate.
    at, values: of the computed one.
    reference_at, reference: of the other, empty where there is none.
    reference_time: of the other, inf of a steady flow; None where it is that of the computed one.
    table: whether nothing is known of the other between its places.
    """

    along: str
    at: Array
    values: Array
    reference_at: Array
    reference: Array
    reference_time: float | None = None
    table: bool = False


@dataclass(frozen=True)
class FlowCase:
    """A flow with a reference solution.

    Attributes:
        name: on the command line.
        defaults: settings that differ from the general ones, for each scheme that computes it; the first is taken if
            nothing is said.
        problem: what is to be computed, from the settings.
        comparisons: profiles beside the reference, by name.
        time_unit: what `until` and the printed times are multiples of, from the settings.
        time_name: how that time is called.
        metrics: errors and the like at one moment, by name.
        ended: why a run is over at one moment, from its metrics: "steady", "failed: ...", what else ends it, or None.
        ends: what `ended` may say beside "steady" and "failed: ...".
        summary: what is found at the end, beside the metrics; `reference_missing` is a sentence on what could not be
            compared.
        profiles: numbers along lines, at the end, that are kept with the results of a sweep.
        headline: the metric that is drawn against time.
        known: that metric where others have it, times and values; None where nobody has.
        kinds: settings with more than the general ones, by scheme, where the case has any of its own.
        presets: what a paper has otherwise for this case, by the name of the preset.
        horizon: when a run without `until` is expected to end, in the time unit; None if it has no end of its own.
    """

    name: str
    defaults: dict[str, dict[str, Any]]
    problem: Callable[[Settings], Problem]
    comparisons: Callable[[Settings, FlowInTime], dict[str, Comparison]]
    time_unit: Callable[[Settings], float]
    time_name: str
    metrics: Callable[[Settings, FlowInTime], dict[str, float]]
    ended: Callable[[Settings, FlowInTime, dict[str, float]], str | None]
    ends: tuple[str, ...] = ()
    summary: Callable[[Settings, FlowInTime], dict[str, Any]] = lambda settings, flow: {}
    profiles: Callable[[Settings, FlowInTime], dict[str, list[float]]] = lambda settings, flow: {}
    headline: str = "rms_error"
    known: Callable[[Settings], tuple[Array, Array] | None] = lambda settings: None
    horizon: float | None = None
    kinds: Mapping[str, type[Settings]] = field(default_factory=dict)
    presets: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)

    def settings(self, **changes: Any) -> Settings:
        """The settings of this case with some changed.

        Raises:
            SphearError: a setting is wrong, or the case has no such scheme.
        """
        scheme = str(changes.get("scheme", next(iter(self.defaults))))
        return self.kind(scheme)(**{**self.defaults[scheme], **changes})

    def kind(self, scheme: str) -> type[Settings]:
        """The settings that the case has for a scheme.

        Raises:
            SphearError: it has none.
        """
        general = settings_type(scheme)
        if scheme not in self.defaults:
            raise SphearError(
                f"{self.name} is computed by the scheme {' or '.join(self.defaults)}, not {shortened(scheme)}"
            )
        return self.kinds.get(scheme, general)

    def preset(self, name: str, scheme: str) -> dict[str, Any]:
        """The settings of a preset for this case.

        Raises:
            SphearError: there is none of that name for the scheme.
        """
        found = preset_settings(name, scheme)
        found.update(self.presets.get(BY_SCHEME[scheme].name(name), {}))
        return found

    def explicit(self, **changes: Any) -> FlowSettings:
        """The settings of this case for the explicit scheme, with some changed."""
        return FlowSettings(**{**self.defaults["explicit"], **changes})
