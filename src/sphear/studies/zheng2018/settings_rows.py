"""Rows to keep of the search for the paper's own settings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.progress import no_progress
from sphear.studies.kept import store, swept
from sphear.studies.result import Progress
from sphear.studies.rows import Row, significant
from sphear.studies.zheng2018.cavities import PAPER
from sphear.studies.zheng2018.cavity_rows import scores
from sphear.studies.zheng2018.settings_combinations import BY_NAME
from sphear.studies.zheng2018.settings_runs import CASE, COMPUTE, SCREENED, Tried, tried

if TYPE_CHECKING:
    from sphear.sweeps import Run, SweepResult

SCORES = ("deviation", "u_min", "u_min_error", "paper_err", "kinetic_energy_error")
CURVE = 40  # moments of the disorder that are kept
GROWS = (0.8, 2.4)  # spacings that the lid moves, over which the growth of the disorder is measured
SLACK = 1e-6  # of a time


class Search:
    """Runs, and what is kept of them.

    Args:
        tried: the runs, in the order in which they are computed.
    """

    def __init__(self, tried: Iterable[Tried]) -> None:
        self.runs: dict[Tried, Run] = {each: each.run() for each in tried}

    def compute(self, workers: int, progress: Progress = no_progress) -> dict[Tried, SweepResult]:
        """Compute what is not kept: short runs of all readings first.

        Raises:
            SphearError: a run was lost.
        """
        for group in dict.fromkeys((each.resolution, each.until) for each in self.runs):
            together = [run for each, run in self.runs.items() if each[1:] == group]
            swept(together, PAPER, workers, progress, compute=COMPUTE, longest_first=False)
        return self.kept()

    def kept(self) -> dict[Tried, SweepResult]:
        """The results so far."""
        found = {each: store(PAPER).get(run) for each, run in self.runs.items()}
        return {each: result for each, result in found.items() if result is not None and "time" in result.metrics}


def identity(row: Mapping[str, Any]) -> tuple[Any, ...]:
    """The settings that tell a run from others."""
    return row["reading"], row["resolution"], row["until"]


def merged(old: dict[str, Any] | None, results: Mapping[Tried, SweepResult]) -> dict[str, Any]:
    """Kept numbers with new ones, in the order in which runs are listed; of readings that have changed, none."""
    rows = {identity(row): row for row in (old["runs"] if old else ()) if _current(row)}
    rows |= {tuple(each): row_of(each, result) for each, result in results.items()}
    return {"screened": SCREENED, "runs": [rows[each] for each in map(tuple, tried()) if each in rows]}


def _current(row: Row) -> bool:
    return row["reading"] in BY_NAME and row["changes"] == BY_NAME[row["reading"]].changes


def data_of(results: Mapping[Tried, SweepResult]) -> dict[str, Any]:
    """The data of these runs alone."""
    return {"screened": SCREENED, "runs": [row_of(each, result) for each, result in results.items()]}


def row_of(each: Tried, result: SweepResult) -> Row:
    """The row to keep of a run."""
    last, history = result.metrics, result.history
    row: Row = {
        **each._asdict(), "changes": BY_NAME[each.reading].changes, "end": result.end,
        "time": significant(last["time"]), "reynolds": 1000.0, "seconds": significant(result.performance["seconds"], 3),
    }  # fmt: skip
    row |= {name: significant(last.get(name)) for name in ("density_deviation", "smallest_distance", "kinetic_energy")}
    # at the failure itself numbers say nothing
    alive = [step for step in history if step.get("disorder") is not None][: -1 if result.failed else None]
    moments = sorted({round(k * (len(alive) - 1) / (CURVE - 1)) for k in range(CURVE)}) if alive else []
    row["curve"] = {
        name: [significant(alive[k][key], 4) for k in moments]
        for name, key in (("time", "time"), ("disorder", "disorder"), ("distance", "smallest_distance"))
    }
    row |= growth_of(alive, each.resolution)
    row["profiles"] = {name: [significant(x) for x in values] for name, values in result.profiles.items()}
    row["kinetic_energy_error"] = significant(last.get("kinetic_energy_error"))
    row |= {name: value for name, value in scores(CASE, row).items() if name in SCORES}
    return {name: value for name, value in row.items() if name != "profiles" or each.until > SCREENED}


def growth_of(history: list[Row], resolution: int) -> Row:
    """The rate at which the disorder grows over `GROWS`, and the median of the least pressure then; None if too few.

    The rate is the slope of the logarithm.
    """
    start, end = (x / resolution for x in GROWS)
    within = [step for step in history if start - SLACK <= step["time"] <= end + SLACK and step["disorder"] > 0]
    if len(within) < 2:
        return {"growth": None, "least_pressure": None}
    times, values = ([step[name] for step in within] for name in ("time", "disorder"))
    return {
        "growth": significant(float(np.polyfit(times, np.log(values), 1)[0]), 3),
        "least_pressure": significant(float(np.median([step["least_pressure"] for step in within])), 3),
    }
