"""Channels from rest, observed at chosen times, beyond the steady state and whatever their errors."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from sphear.cases.flow.base import Case, Settings
from sphear.cases.flow.poiseuille import POISEUILLE, reference
from sphear.cases.flow.run import CaseRun
from sphear.cases.flow.start import flow_settings
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings
from sphear.simulation.observers import Observer
from sphear.studies.rows import significant

BROKE_DOWN = "failed: "


def channel(**own: Any) -> WeaklyCompressibleSettings:
    """The settings of the paper's channel, some of one's own before them."""
    settings = flow_settings(POISEUILLE, own, "basa2009")
    assert isinstance(settings, WeaklyCompressibleSettings)
    return settings


def seconds(settings: Settings, times: Iterable[float]) -> list[float]:
    """Times t* (eq. 39) in those of the flow."""
    return [time * POISEUILLE.time_unit(settings) for time in times]


def advanced(settings: WeaklyCompressibleSettings, *observers: Observer, case: Case = POISEUILLE) -> CaseRun:
    """A channel that has been advanced to its time or until it broke down."""
    return CaseRun(case, settings, observers=observers, beyond=("steady", "failed")).run()


def reached(run: CaseRun) -> float:
    """t* (eq. 39)."""
    return run.flow.time / run.unit


def deviation(run: CaseRun) -> np.ndarray[Any, Any]:
    """(u - U) / U of each particle."""
    exact = reference(run.settings).velocity(run.flow.positions[:, 1], run.flow.time)
    return np.asarray(run.flow.velocities[:, 0] / exact - 1.0)


def root_mean_square(values: ArrayLike) -> float:
    """Eq. (38), of the deviations of some particles or all; infinite where one is not a number."""
    found = float(np.sqrt(np.mean(np.square(values))))
    return found if np.isfinite(found) else np.inf


def points(run: CaseRun) -> dict[str, Any]:
    """The time, and y and u / U0 of all particles, to four digits, each point once."""
    scaled = run.flow.velocities[:, 0] / reference(run.settings).centreline_velocity
    heights = run.flow.positions[:, 1]
    rounded = sorted({(round(y, 4), significant(u, 4)) for y, u in zip(heights, scaled, strict=True)})
    return {"time": significant(reached(run)), "y": [y for y, _ in rounded], "u": [u for _, u in rounded]}
