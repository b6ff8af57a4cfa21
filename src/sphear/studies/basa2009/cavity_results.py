"""The kept results of the cavity's runs, shared by figures 8 to 10."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from sphear.studies.basa2009.cavity import CORRECTIONS, TERMS, runs
from sphear.studies.kept import swept
from sphear.studies.result import Progress

if TYPE_CHECKING:
    from sphear.sweeps import SweepResult

SWEPT = ("correction", "viscosity", "reynolds")
LEVELS = {"none": "no correction", "shepard": "level 0", "bonet_lok": "level 1"}
METRICS = ("kinetic_energy", "kinetic_energy_error", "u_min", "u_mean_deviation", "u_max_deviation",
           "v_mean_deviation", "v_max_deviation")  # fmt: skip

Row = dict[str, Any]


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
        row["energy"] = [[_short(step["time"]), _short(step["kinetic_energy"])] for step in result.history]
        row["profiles"] = {name: [_short(x) for x in values] for name, values in result.profiles.items()}
        found.append(row)
    derived = ("sound_speed", "time_step", "kinematic_viscosity", "until", "force", "threads")
    common = {key: value for key, value in results[0].settings.items() if key not in (*SWEPT, *derived)}
    return {"settings": common, "runs": found}


def _short(value: float | None) -> float | None:
    return None if value is None else float(f"{value:.5g}")


def select(rows: Sequence[Row], **wanted: Any) -> list[Row]:
    """The rows with these values."""
    return [row for row in rows if all(row[key] == value for key, value in wanted.items())]


def terms(rows: Sequence[Row]) -> list[str]:
    """The viscous terms that occur."""
    return [term for term in TERMS if select(rows, viscosity=term)]


def corrections(rows: Sequence[Row]) -> list[str]:
    """The corrections that occur."""
    return [correction for correction in CORRECTIONS if select(rows, correction=correction)]


def reynolds_numbers(rows: Sequence[Row]) -> list[float]:
    """The Reynolds numbers that occur."""
    return sorted({float(row["reynolds"]) for row in rows})


def failed(row: Row) -> bool:
    """True if the run broke down."""
    return str(row["end"]).startswith("failed")


def how(row: Row) -> str:
    """The end of a run in a few words."""
    return f"failed at t = {row['time']:.3g}" if failed(row) else f"t = {row['time']:.3g}"
