"""Channels driven by hand: from one chosen time to the next, and beyond the steady state."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from sphear.cases.flow.poiseuille import POISEUILLE, reference
from sphear.schemes.flow import Flow
from sphear.schemes.settings import FlowSettings


def channel(settings: FlowSettings) -> Flow:
    """A channel at rest."""
    return Flow(POISEUILLE.problem(settings), settings)


def _settings(flow: Flow) -> FlowSettings:
    assert isinstance(flow.settings, FlowSettings)
    return flow.settings


def advance_to(flow: Flow, time: float) -> None:
    """Advance to the step nearest to a time t* (eq. 39); not back.

    Raises:
        FlowFailure: the flow broke down on the way.
    """
    unit = POISEUILLE.time_unit(_settings(flow))
    flow.advance(max(0, round((time * unit - flow.time) / flow.time_step)))


def reached(flow: Flow) -> float:
    """t* (eq. 39)."""
    return flow.time / POISEUILLE.time_unit(_settings(flow))


def deviation(flow: Flow) -> np.ndarray[Any, Any]:
    """(u - U) / U of each particle."""
    exact = reference(_settings(flow)).velocity(flow.positions[:, 1], flow.time)
    return np.asarray(flow.velocities[:, 0] / exact - 1.0)


def root_mean_square(values: ArrayLike) -> float:
    """Eq. (38), of the deviations of some particles or all; infinite where one is not a number."""
    found = float(np.sqrt(np.mean(np.square(values))))
    return found if np.isfinite(found) else np.inf


def points(flow: Flow) -> dict[str, list[float]]:
    """y and u / U0 of all particles, to four digits, and each point once."""
    scaled = flow.velocities[:, 0] / reference(_settings(flow)).centreline_velocity
    rounded = {(round(y, 4), significant(u, 4)) for y, u in zip(flow.positions[:, 1], scaled, strict=True)}
    return {"y": [y for y, _ in sorted(rounded)], "u": [u for _, u in sorted(rounded)]}


def significant(value: float, digits: int = 5) -> float:
    """A number as it is kept."""
    return float(f"{value:.{digits}g}")
