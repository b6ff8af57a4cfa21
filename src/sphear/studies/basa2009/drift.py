"""The runs behind figure 7: how particles of a channel drift out of their rows until it fails."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from sphear.cases.flow.base import Settings
from sphear.cases.flow.poiseuille import POISEUILLE, Poiseuille
from sphear.cases.flow.run import CaseRun
from sphear.schemes.base import Flow
from sphear.schemes.problem import Problem
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings
from sphear.simulation.observers import Call, StopWhen
from sphear.studies.basa2009.channel import BROKE_DOWN, advanced, reached
from sphear.studies.rows import significant

Array = np.ndarray[Any, Any]

FITTED = (1e-11, 1e-2)  # drifts, in spacings, between which growth is fitted: beyond rounding, and still small
INTERVAL = 0.5  # t* times Re between two outputs


class Disordered(Poiseuille):
    """A channel whose particles are moved at the start, each coordinate by as much at most.

    Args:
        disorder: in spacings.
    """

    def __init__(self, disorder: float) -> None:
        self.disorder = disorder

    def problem(self, settings: Settings) -> Problem:
        """The problem of the channel, its particles moved."""
        problem = super().problem(settings)
        moved = np.random.default_rng(0).uniform(-1, 1, problem.positions.shape) * self.disorder * problem.spacing
        return replace(problem, positions=problem.positions + moved)


def drifting(settings: WeaklyCompressibleSettings, disorder: float) -> dict[str, Any]:
    """Advance until the flow fails or has made all steps, the steady state notwithstanding."""
    case = Disordered(disorder)
    step = CaseRun(case, settings).flow.time_step
    every = max(1, round(INTERVAL / settings.reynolds * POISEUILLE.time_unit(settings) / step))
    observed, failing = Call(_observed, steps=every, at_start=True), StopWhen(_failure, steps=every)
    run = advanced(settings, observed, failing, case=case)
    (*_, start), *rows = observed.rows
    times, errors, energy, heights = (list(column) for column in zip(*rows, strict=True))
    apart = drifts(np.array(heights), start, run.flow.problem.spacing)
    row = apart.pop("row")
    judged = observed.rows[-1][0] == significant(reached(run))
    return {
        "end": run.end if judged else run.end.removeprefix(BROKE_DOWN),
        "failed": run.failed,
        "steps": run.flow.steps,
        "row_from_wall": row,
        **growth(np.array(times), np.array(apart["largest"])),
        "times": times,
        "rms_error": errors,
        "kinetic_energy": energy,
        **apart,
    }


def _observed(run: CaseRun) -> tuple[float, float, float, Array] | None:
    """t*, the RMS error, the kinetic energy and the heights; None of a flow that broke down."""
    if run.failed:
        return None
    found = POISEUILLE.metrics(run.settings, run.flow)
    numbers = (reached(run), found["rms_error"], found["kinetic_energy"])
    time, error, energy = map(significant, numbers)
    return time, error, energy, heights_by_row(run.flow)


def _failure(run: CaseRun) -> str:
    """The failure of the channel by the paper's rule, in words; empty where it has not failed, or broke down."""
    if run.failed:
        return ""
    said = POISEUILLE.ended(run.settings, run.flow, POISEUILLE.metrics(run.settings, run.flow)) or ""
    return said if said.startswith(BROKE_DOWN) else ""


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
        "largest": [significant(x) for x in between.max(axis=(1, 2))],
        "median": [significant(x) for x in np.median(between, axis=(1, 2))],
        "pair": [significant(x) for x in between[:, pair, row]],
        "together": [significant(x) for x in together],
    }


def growth(times: Array, drift: Array) -> dict[str, float | None]:
    """The rate of the exponential through a drift, in 1 / t*, and how much of its logarithm it explains (R^2)."""
    chosen = (drift > FITTED[0]) & (drift < FITTED[1])
    if chosen.sum() < 3:
        return {"growth": None, "explained": None}
    x, y = times[chosen], np.log(drift[chosen])
    rate, offset = np.polyfit(x, y, 1)
    return {
        "growth": significant(rate, 4),
        "explained": significant(1 - float(((y - rate * x - offset) ** 2).sum() / ((y - y.mean()) ** 2).sum()), 6),
    }
