"""The base of all cases: the parts that a case is made of."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

import numpy as np

from sphear.errors import SphearError, shortened
from sphear.schemes.base import Flow, Settings, settings_type
from sphear.schemes.presets import BY_SCHEME, preset_settings
from sphear.schemes.problem import Problem
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings

__all__ = ["Case", "Comparison", "Flow", "Settings"]

Array = np.ndarray[Any, Any]


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


class Case(ABC):
    """A flow with a reference solution.

    Attributes:
        name: on the command line.
        defaults: settings that differ from the general ones, for each scheme that computes it; the first is taken if
            nothing is said.
        time_name: name of the time that `until` and the printed times are in.
        headline: the metric that is drawn against time.
        ends: what `ended` may say beside "steady" and "failed: ...".
        horizon: when a run without `until` is expected to end, in the time unit; None if it has no end of its own.
        kinds: settings with more than the general ones, by scheme, where the case has any of its own.
        presets: settings that a preset has for this case, by its name.
    """

    name: ClassVar[str]
    defaults: ClassVar[Mapping[str, Mapping[str, Any]]]
    time_name: ClassVar[str]
    headline: ClassVar[str] = "rms_error"
    ends: ClassVar[tuple[str, ...]] = ()
    horizon: ClassVar[float | None] = None
    kinds: ClassVar[Mapping[str, type[Settings]]] = {}
    presets: ClassVar[Mapping[str, Mapping[str, Any]]] = {}

    @abstractmethod
    def problem(self, settings: Settings) -> Problem:
        """The flow that is computed."""

    @abstractmethod
    def time_unit(self, settings: Settings) -> float:
        """The time that `until` and the printed times are multiples of."""

    @abstractmethod
    def metrics(self, settings: Settings, flow: Flow) -> dict[str, float]:
        """Errors and the like at one moment, by name."""

    def ended(self, settings: Settings, flow: Flow, metrics: dict[str, float]) -> str | None:
        """The reason for which a run is over at one moment, from its metrics: "steady", "failed: ...", or None."""
        return None

    def summary(self, settings: Settings, flow: Flow) -> dict[str, Any]:
        """Findings at the end, beside the metrics; `reference_missing` says in a sentence what is not compared."""
        return {}

    def comparisons(self, settings: Settings, flow: Flow) -> dict[str, Comparison]:
        """Profiles beside the reference, by name."""
        return {}

    def profiles(self, settings: Settings, flow: Flow) -> dict[str, list[float]]:
        """Numbers along lines, at the end, that are kept with the results of a sweep."""
        return {}

    def reference_history(self, settings: Settings) -> tuple[Array, Array] | None:
        """The headline where others have it, times and values; None where nobody has."""
        return None

    def settings(self, **changes: Any) -> Settings:
        """The settings of this case with some changed.

        Raises:
            SphearError: a setting is wrong, or the case has no such scheme.
        """
        scheme = str(changes.get("scheme", next(iter(self.defaults))))
        kind = self.kind(scheme)
        return kind(**{**self.defaults[scheme], **kind.flattened(changes)})

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
        settings = preset_settings(name, scheme)
        settings.update(self.presets.get(BY_SCHEME[scheme].name(name), {}))
        return settings

    def explicit(self, **changes: Any) -> WeaklyCompressibleSettings:
        """The settings of this case for the explicit scheme, with some changed."""
        return WeaklyCompressibleSettings(**{**self.defaults["explicit"], **changes})
