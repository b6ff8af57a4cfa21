"""The kept runs of the channels of figure 5, and the numbers that are read off them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from sphear.cases.flow import FLOWS
from sphear.cases.flow.poiseuille import HALF_WIDTH, threshold
from sphear.studies.basa2009.robustness import ERROR_REYNOLDS
from sphear.studies.kept import in_common
from sphear.studies.rows import Row, significant

if TYPE_CHECKING:
    from sphear.sweeps import SweepResult

SWEPT = ("equation_of_state", "correction", "viscosity", "reynolds")


def entries(results: Sequence[SweepResult]) -> dict[str, Any]:
    """Entries to keep: the end of each run, and the errors over time of those whose error is drawn."""
    found = []
    for result in results:
        row: Row = {key: result.settings[key] for key in SWEPT}
        row |= {"end": result.end, "time": _end(result), "steps": result.metrics["steps"]}
        row["rms_error"] = result.metrics["rms_error"]
        if row["reynolds"] == ERROR_REYNOLDS:
            row["history"] = [[significant(step[name], 4) for name in ("time", "rms_error")] for step in result.history]
        found.append(row)
    return {"settings": in_common(results, SWEPT), "runs": found}


def _end(result: SweepResult) -> float:
    """t* at which a run ended; of one that failed, of the first of its kept outputs beyond the threshold."""
    settings = FLOWS["poiseuille"].settings(reynolds=result.settings["reynolds"])
    unit, spacing = FLOWS["poiseuille"].time_unit(settings), 2 * HALF_WIDTH / result.settings["resolution"]
    if result.failed:
        for row in result.history:
            if row["rms_error"] is None or row["rms_error"] >= threshold(row["time"] * unit, spacing):
                return significant(float(row["time"]), 4)
    return significant(float(result.metrics["time"]), 4)


def outcome(row: Row) -> str:
    """The end of a run: "steady", "failed" or "steps"."""
    return str(row["end"]).partition(":")[0]


def highest_steady(rows: Sequence[Row]) -> float:
    """The Reynolds number up to which every run reaches the steady state; 0 if the first fails."""
    highest = 0.0
    for row in sorted(rows, key=lambda row: float(row["reynolds"])):
        if outcome(row) != "steady":
            break
        highest = row["reynolds"]
    return highest


def error_at(row: Row, time: float) -> float:
    """The RMS error at a t* of a run whose history is kept; infinite after it has failed."""
    known = [(t, e) for t, e in row.get("history", []) if e is not None]
    if not known or (outcome(row) == "failed" and row["time"] < time):
        return math.inf
    return float(min(known, key=lambda pair: abs(pair[0] - time))[1])


def percent(error: float) -> str:
    """An error in percent; infinite ones are those of runs that failed."""
    return f"{error:.2%}" if math.isfinite(error) else "failed"
