"""The kept results of the cavity's runs, shared by figures 8 to 10."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from sphear.studies.basa2009.cavity import TERMS, runs
from sphear.studies.basa2009.models import CORRECTIONS
from sphear.studies.kept import in_common, swept
from sphear.studies.result import Progress
from sphear.studies.rows import Row, select, significant

if TYPE_CHECKING:
    from sphear.sweeps import SweepResult

SWEPT = ("correction", "viscosity", "reynolds")
METRICS = ("kinetic_energy", "kinetic_energy_error", "u_min", "u_mean_deviation", "u_max_deviation",
           "v_mean_deviation", "v_max_deviation")  # fmt: skip


def compute(*, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
    """Every run, in what is shown of it."""
    return entries(swept(runs(quick), "basa2009", workers, progress))


def entries(results: Sequence[SweepResult]) -> dict[str, Any]:
    """Entries to keep: the end of each run, its energy over time and its profiles at the end."""
    found = []
    for result in results:
        row: Row = {key: result.settings[key] for key in SWEPT}
        row |= {"end": result.end, "time": result.metrics["time"], "steps": result.metrics["steps"]}
        row |= {name: result.metrics[name] for name in METRICS if name in result.metrics}
        row["energy"] = [[significant(step["time"]), significant(step["kinetic_energy"])] for step in result.history]
        row["profiles"] = {name: [significant(x) for x in values] for name, values in result.profiles.items()}
        found.append(row)
    return {"settings": in_common(results, SWEPT), "runs": found}


def terms(rows: Sequence[Row]) -> list[str]:
    """The viscous terms that occur."""
    return [term for term in TERMS if select(rows, viscosity=term)]


def corrections(rows: Sequence[Row]) -> list[str]:
    """The corrections that occur."""
    return [correction for correction in CORRECTIONS if select(rows, correction=correction)]


def reynolds_numbers(rows: Sequence[Row]) -> list[float]:
    """The Reynolds numbers that occur."""
    return sorted({float(row["reynolds"]) for row in rows})
