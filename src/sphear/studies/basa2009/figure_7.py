"""Figure 7: kinetic energy, and drift of particles out of their rows, in a channel long after it is steady."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.cases.flow.poiseuille import HALF_WIDTH, POISEUILLE, reference
from sphear.results.table import Column, Table
from sphear.schemes.flow import Flow, FlowFailure
from sphear.schemes.settings import FlowSettings
from sphear.studies.basa2009.channel import reached
from sphear.studies.basa2009.channel import significant as kept
from sphear.studies.result import Agreement, Progress, StudyResult

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = np.ndarray[Any, Any]

CLAIM = (
    "with model C at Re = 0.5 the kinetic energy stays constant while neighbours in a row drift apart exponentially"
    " until the flow fails; it fails at Re as low as 1 too, so that this is not the physical instability"
)
REYNOLDS = 0.5
OTHERS = (1.0, 5.0)
DISORDER = 1e-6  # spacings that particles are moved by at the start of one more run
FITTED = (1e-11, 1e-2)  # drifts, in spacings, between which growth is fitted: beyond rounding, and still small
INTERVAL = 0.5  # t* times Re between two outputs


def compute(*, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
    """The runs, one after the other: each takes less than a minute."""
    resolution = 10 if quick else 20
    plan = [(5.0, 0.0)] if quick else [(REYNOLDS, 0.0), *((other, 0.0) for other in OTHERS), (REYNOLDS, DISORDER)]
    runs = []
    for reynolds, disorder in plan:
        progress(f"Re = {reynolds:g}{f', disordered by {disorder:g} dx' if disorder else ''}")
        settings = POISEUILLE.settings(viscosity="violeau", reynolds=reynolds, resolution=resolution)
        runs.append({"reynolds": reynolds, "disorder": disorder, **_run(settings, disorder)})
    return {"viscosity": "violeau", "correction": "none", "resolution": resolution, "runs": runs}


def _run(settings: FlowSettings, disorder: float) -> dict[str, Any]:
    """Advance until the flow fails or has made all steps, the steady state notwithstanding."""
    problem = POISEUILLE.problem(settings)
    moved = np.random.default_rng(0).uniform(-1, 1, problem.positions.shape) * disorder * problem.spacing
    flow = Flow(replace(problem, positions=problem.positions + moved), settings)
    every = max(1, round(INTERVAL / settings.reynolds * POISEUILLE.time_unit(settings) / flow.time_step))
    start, end = _rows(flow), ""
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
        heights.append(_rows(flow))
        judged = POISEUILLE.ended(settings, flow, found) or ""
        end = judged if judged.startswith("failed") else "steps" if flow.steps >= settings.max_steps else ""
    drifts = _drifts(np.array(heights), start, problem.spacing)
    row = drifts.pop("row")
    return {
        "end": end,
        "failed": end != "steps",
        "steps": flow.steps,
        "row_from_wall": row,
        **_growth(np.array(times), np.array(drifts["largest"])),
        "times": times,
        "rms_error": errors,
        "kinetic_energy": energy,
        **drifts,
    }


def _rows(flow: Flow) -> Array:
    """(n, n): y of each particle, the columns being the rows along the channel at the start."""
    n = flow.settings.resolution
    return flow.positions[:, 1].reshape(n, n).copy()


def _drifts(heights: Array, start: Array, spacing: float) -> dict[str, Any]:
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


def _growth(times: Array, drift: Array) -> dict[str, float | None]:
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


def widths(reynolds: float) -> float:
    """One t* in units of the paper's figure, channel width over centreline velocity."""
    settings = POISEUILLE.settings(reynolds=reynolds)
    return POISEUILLE.time_unit(settings) * reference(settings).centreline_velocity / (2 * HALF_WIDTH)


def present(data: dict[str, Any]) -> StudyResult:
    """When each run fails, in both units of time, and how fast its drift grows."""
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
