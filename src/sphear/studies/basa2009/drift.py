"""The runs behind figure 7: how particles of a channel drift out of their rows until it fails."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from sphear.cases.flow.poiseuille import POISEUILLE
from sphear.schemes.base import FlowFailure
from sphear.schemes.flow import Flow
from sphear.schemes.settings import FlowSettings
from sphear.studies.basa2009.channel import reached
from sphear.studies.basa2009.channel import significant as kept

Array = np.ndarray[Any, Any]

FITTED = (1e-11, 1e-2)  # drifts, in spacings, between which growth is fitted: beyond rounding, and still small
INTERVAL = 0.5  # t* times Re between two outputs


def drifting(settings: FlowSettings, disorder: float) -> dict[str, Any]:
    """Advance until the flow fails or has made all steps, the steady state notwithstanding."""
    problem = POISEUILLE.problem(settings)
    moved = np.random.default_rng(0).uniform(-1, 1, problem.positions.shape) * disorder * problem.spacing
    flow = Flow(replace(problem, positions=problem.positions + moved), settings)
    every = max(1, round(INTERVAL / settings.reynolds * POISEUILLE.time_unit(settings) / flow.time_step))
    start, end = heights_by_row(flow), ""
    times, errors, energy, heights = [], [], [], []
    while not end:
        try:
            flow.advance(min(every, settings.max_steps - flow.steps))
        except FlowFailure as failure:
            end = str(failure)
            break
        found = POISEUILLE.metrics(settings, flow)
        times.append(kept(reached(flow)))
        errors.append(kept(found["rms_error"]))
        energy.append(kept(found["kinetic_energy"]))
        heights.append(heights_by_row(flow))
        judged = POISEUILLE.ended(settings, flow, found) or ""
        end = judged if judged.startswith("failed") else "steps" if flow.steps >= settings.max_steps else ""
    apart = drifts(np.array(heights), start, problem.spacing)
    row = apart.pop("row")
    return {
        "end": end,
        "failed": end != "steps",
        "steps": flow.steps,
        "row_from_wall": row,
        **growth(np.array(times), np.array(apart["largest"])),
        "times": times,
        "rms_error": errors,
        "kinetic_energy": energy,
        **apart,
    }


def heights_by_row(flow: Flow) -> Array:
    """(n, n): y of each particle, the columns being the rows along the channel at the start."""
    n = round(math.sqrt(flow.count))
    return flow.positions[:, 1].reshape(n, n).copy()


def drifts(heights: Array, start: Array, spacing: float) -> dict[str, Any]:
    """Differences of y of neighbours in a row over time, in spacings: the largest, the median and those of one pair.

    The pair is the one whose drift at the end is the median of the row that drifts most. `together` is the largest
    displacement of a row as a whole.
    """
    between = np.abs(np.roll(heights, -1, axis=1) - heights) / spacing
    row = int(between[-1].max(axis=0).argmax())
    pair = int(np.argsort(between[-1, :, row])[heights.shape[1] // 2])
    together = np.abs(heights.mean(axis=1) - start.mean(axis=0)).max(axis=1) / spacing
    return {
        "row": min(row, heights.shape[2] - 1 - row),
        "largest": [kept(x) for x in between.max(axis=(1, 2))],
        "median": [kept(x) for x in np.median(between, axis=(1, 2))],
        "pair": [kept(x) for x in between[:, pair, row]],
        "together": [kept(x) for x in together],
    }


def growth(times: Array, drift: Array) -> dict[str, float | None]:
    """The rate of the exponential through a drift, in 1 / t*, and how much of its logarithm it explains (R^2)."""
    chosen = (drift > FITTED[0]) & (drift < FITTED[1])
    if chosen.sum() < 3:
        return {"growth": None, "explained": None}
    x, y = times[chosen], np.log(drift[chosen])
    rate, offset = np.polyfit(x, y, 1)
    return {
        "growth": kept(rate, 4),
        "explained": kept(1 - float(((y - rate * x - offset) ** 2).sum() / ((y - y.mean()) ** 2).sum()), 6),
    }
