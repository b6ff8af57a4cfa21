"""Figure 7: kinetic energy, and drift of particles out of their rows, in a channel long after it is steady."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.cases.flow.poiseuille import HALF_WIDTH, POISEUILLE, reference
from sphear.results.table import Column, Table
from sphear.studies.basa2009.channel import channel
from sphear.studies.basa2009.drift import drifting
from sphear.studies.result import Agreement, Progress, StudyResult

if TYPE_CHECKING:
    from matplotlib.figure import Figure

CLAIM = (
    "with model C at Re = 0.5 the kinetic energy stays constant while neighbours in a row drift apart exponentially"
    " until the flow fails; it fails at Re as low as 1 too, so that this is not the physical instability"
)
REYNOLDS = 0.5
OTHERS = (1.0, 5.0)
DISORDER = 1e-6  # spacings that particles are moved by at the start of one more run


def compute(*, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
    """The runs, one after the other: each takes less than a minute."""
    resolution = 10 if quick else 20
    plan = [(5.0, 0.0)] if quick else [(REYNOLDS, 0.0), *((other, 0.0) for other in OTHERS), (REYNOLDS, DISORDER)]
    runs = []
    for reynolds, disorder in plan:
        progress(f"Re = {reynolds:g}{f', disordered by {disorder:g} dx' if disorder else ''}")
        settings = channel(viscosity="violeau", reynolds=reynolds, resolution=resolution)
        runs.append({"reynolds": reynolds, "disorder": disorder, **drifting(settings, disorder)})
    return {"viscosity": "violeau", "correction": "none", "resolution": resolution, "runs": runs}


def widths(reynolds: float) -> float:
    """One t* in units of the paper's figure, channel width over centreline velocity."""
    settings = POISEUILLE.settings(reynolds=reynolds)
    return POISEUILLE.time_unit(settings) * reference(settings).centreline_velocity / (2 * HALF_WIDTH)


def present(data: dict[str, Any]) -> StudyResult:
    """The time at which each run fails, in both units, and the growth rate of its drift."""
    steady = POISEUILLE.horizon or np.inf
    rows = []
    for run in data["runs"]:
        unit = widths(run["reynolds"])
        row = {key: value for key, value in run.items() if not isinstance(value, list)}
        row |= {"time": run["times"][-1], "time_in_widths": run["times"][-1] * unit, "error": run["rms_error"][-1]}
        row["growth_in_widths"] = None if run["growth"] is None else run["growth"] / unit
        calm = np.array(run["times"]) < 0.9 * row["time"]
        row["together"] = float(np.array(run["together"])[calm].max())
        row["drift"] = run["largest"][-1]
        late = np.array(run["kinetic_energy"])[calm & (np.array(run["times"]) > steady)]
        row["energy_from"], row["energy_to"] = (float(late.min()), float(late.max())) if len(late) else (None, None)
        rows.append(row)
    finding = "; ".join(_sentence(row) for row in rows)
    if len(rows) > 1:
        crossings = [row["time_in_widths"] for row in rows if row["failed"] and not row["disorder"]]
        finding += (
            f"; rows as a whole sway by {max(row['together'] for row in rows):.1%} of a spacing; from the lattice all"
            f" fail after {min(crossings):.3g} to {max(crossings):.3g} channel widths, when what began as rounding is"
            f" {rows[0]['drift']:.2g} dx: when, the disorder at the start decides"
        )
    exponential = all((row["explained"] or 0) > 0.99 for row in rows)
    failed = [row for row in rows if row["failed"]]
    agrees: Agreement = (
        "yes" if exponential and len(failed) == len(rows) else "partly" if failed and exponential else "no"
    )
    title = "Channel with violeau, uncorrected, beyond its steady state (Basa, Quinlan & Lastiwka 2009, figure 7)"
    columns = (
        Column("reynolds", "Re", "g"),
        Column("disorder", "disorder / dx", "g"),
        Column("time", "fails at t*", ".4g"),
        Column("time_in_widths", "t U0 / 2d", ".4g"),
        Column("error", "RMS error", ".1%"),
        Column("growth", "growth, 1 / t*", ".4g"),
        Column("growth_in_widths", "growth, U0 / 2d", ".4g"),
        Column("explained", "R²", ".5f"),
        Column("drift", "largest drift / dx", ".2g"),
        Column("together", "rows together / dx", ".1e"),
        Column("row_from_wall", "rows to the wall", "d"),
        Column("steps", "steps", "d"),
    )
    figures = {"figure-7": lambda: _figure(data, title)}
    return StudyResult(CLAIM, finding, agrees, rows, [Table(title, columns, rows)], figures)


def _sentence(row: dict[str, Any]) -> str:
    name = f"Re = {row['reynolds']:g}" + (f" disordered by {row['disorder']:g} dx" if row["disorder"] else "")
    if not row["failed"]:
        return f"{name} does not fail in {row['steps']} steps (t* = {row['time']:.4g})"
    text = f"{name} fails at t* = {row['time']:.4g} (t U0 / 2d = {row['time_in_widths']:.3g})"
    if row["energy_from"] is not None:
        text += f" with a kinetic energy of {row['energy_from']:.2f} to {row['energy_to']:.2f} until then"
    return text + (f", drift growing by exp({row['growth']:.3g} t*)" if row["growth"] else "")


def _figure(data: dict[str, Any], title: str) -> Figure:
    from sphear.results.figure import Lines, line_panels

    run = data["runs"][0]
    times, name = run["times"], f"Re = {run['reynolds']:g}"
    second = ("t U0 / 2d", widths(run["reynolds"]))
    names = {"largest": "largest", "one pair": "pair", "median": "median", "rows together": "together"}
    drifts = {label: (times, run[key]) for label, key in names.items()}
    panels = {
        f"kinetic energy over the steady one, {name}": Lines(
            {"E": (times, run["kinetic_energy"])}, ("t*", "E / E steady"), second=second
        ),
        f"drift of neighbours in a row, {name}": Lines(drifts, ("t*", "drift / dx"), logarithmic="y", second=second),
    }
    if len(data["runs"]) > 1:
        largest = {
            f"Re = {one['reynolds']:g}" + (f", disorder {one['disorder']:g} dx" if one["disorder"] else ""): (
                np.array(one["times"]) * widths(one["reynolds"]),
                one["largest"],
            )
            for one in data["runs"]
        }
        panels["largest drift"] = Lines(largest, ("t U0 / 2d", "drift / dx"), logarithmic="y")
    return line_panels(panels, 2, title)
