"""Rows to keep of each cavity run, with its deviations from the references at the same time."""

from __future__ import annotations

import math
from collections.abc import Mapping
from statistics import fmean
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from sphear.references.cavity import CavityFlow, Curve, cavity_cylinder, ghia, mac
from sphear.studies.rows import Row, significant
from sphear.studies.zheng2018.cavities import (
    DEFAULTS,
    QUICK_SIZES,
    QUICK_UNTIL,
    REYNOLDS,
    SIZES,
    TERMS,
    UNTIL,
    Wanted,
    wanted,
)

if TYPE_CHECKING:
    from sphear.sweeps import SweepResult

SAME_TIME = 2e-3  # two times are equal, relative: a run ends within a step of its time
WATCHED = ("pressure_iterations", "divergence", "density_deviation", "smallest_distance", "largest_gap")
MOMENTS = 11  # of what is watched
GAP = (0.25, 0.75)  # the cylinder, on both centrelines
IMMATERIAL = ("scheme", "reynolds", "resolution", "viscosity", "until", "threads", "force")
DERIVED = ("time_step", "alpha", "h_over_dx", "kinematic_viscosity")


def data_of(case: str, results: Mapping[Wanted, SweepResult], quick: bool = False) -> dict[str, Any]:
    """The data to keep of runs: what they have in common, what was to be computed, and a row for each."""
    return {
        "case": case,
        "until": QUICK_UNTIL if quick else UNTIL,
        "sizes": list(QUICK_SIZES if quick else SIZES),
        "terms": list(TERMS),
        "settings": _usual(case),
        "runs": [row_of(each, result) for each, result in results.items()],
    }


def _usual(case: str) -> dict[str, Any]:
    """The settings of a run with the scheme's defaults, but for what is gone through."""
    return {key: value for key, value in Wanted(case, TERMS[0], 40).run().given.items() if key not in IMMATERIAL}


def merged(case: str, old: dict[str, Any] | None, new: dict[str, Any]) -> dict[str, Any]:
    """Kept numbers with new ones, which replace those of the same run, in the order in which runs are listed.

    Settings are kept as what differs from the usual ones: where these have changed, the old numbers mean nothing. A
    setting that is new leaves them valid.
    """
    sources = (old, new) if old and {**new["settings"], **old["settings"]} == new["settings"] else (new,)
    rows = {identity(row): row for source in sources for row in source["runs"]}
    order = [identity(each._asdict()) for each in wanted(case)]
    return {**new, "runs": [rows[each] for each in order if each in rows]}


def identity(row: Mapping[str, Any]) -> tuple[Any, ...]:
    """The settings that tell a run from others of its case."""
    return tuple(row[name] for name in ("preset", "reynolds", "resolution", "viscosity", "until"))


def row_of(each: Wanted, result: SweepResult) -> Row:
    """The row to keep of a run."""
    last, history = result.metrics, result.history
    usual = _usual(each.case)
    row: Row = {
        "preset": each.preset, "reynolds": each.reynolds, "resolution": each.resolution, "viscosity": each.viscosity,
        "until": each.until, "end": result.end, "time": significant(last["time"]), "steps": last["steps"],
        "seconds": significant(result.performance["seconds"], 4), "particles": result.performance["particles"],
    }  # fmt: skip
    row |= {name: significant(result.settings[name]) for name in DERIVED}
    given = each.run().given
    row["settings"] = {key: given[key] for key, value in usual.items() if given[key] != value}
    row |= {name: significant(last.get(name)) for name in ("kinetic_energy", "kinetic_energy_error")}
    iterations = [step["pressure_iterations"] for step in history if step["pressure_iterations"] is not None]
    row |= (
        {"iterations_mean": significant(fmean(iterations), 3), "iterations_max": max(iterations)} if iterations else {}
    )
    row["energy"] = [[significant(step["time"]), significant(step["kinetic_energy"])] for step in history]
    moments = sorted({round(k * (len(history) - 1) / (MOMENTS - 1)) for k in range(MOMENTS)})
    row["watched"] = {name: [significant(history[k][name], 4) for k in moments] for name in ("time", *WATCHED)}
    fields = ("field_", "particles_")
    lines = {name: values for name, values in result.profiles.items() if not name.startswith(fields)}
    row["profiles"] = {name: [significant(x) for x in values] for name, values in lines.items()}
    if each.preset == DEFAULTS and each.reynolds == REYNOLDS:  # others are not drawn
        row |= {name: values for name, values in result.profiles.items() if name.startswith(fields)}
    return row | scores(each.case, row)


def reference(case: str, reynolds: float, time: float) -> CavityFlow | None:
    """The time-accurate flow at this time; None where none was computed."""
    if case == "cavity-cylinder":
        flow = cavity_cylinder() if reynolds == 1000.0 else None
    else:
        flow = mac(reynolds, {100.0: 20, 1000.0: 40}[reynolds]) if reynolds in (100.0, 1000.0) else None
    return flow if flow is not None and math.isclose(time, flow.time, rel_tol=SAME_TIME) else None


def papers_reference(case: str) -> CavityFlow:
    """The reference of the paper's errors at Re = 1000: Ghia's table, or OpenFOAM around the cylinder.

    Of OpenFOAM the finer mesh as it is, since the paper has nothing extrapolated.
    """
    return cavity_cylinder(extrapolated=False) if case == "cavity-cylinder" else ghia(1000)


def papers_u_min(case: str) -> float:
    """The least u that the paper's Err is from; of Ghia's table the least entry."""
    return float(np.nanmin(papers_reference(case).u.values)) if case == "cavity" else least(papers_reference(case).u)


def curves(case: str, row: Row) -> dict[str, Curve]:
    """Both centreline profiles of a run, with the velocities of the walls; none of one that has none."""
    lines = row["profiles"]
    if not lines:
        return {}
    gap = GAP if case == "cavity-cylinder" else None
    found = {}
    for name, axis in (("u", "y"), ("v", "x")):
        values = {0.0: 0.0, 1.0: 1.0 if name == "u" else 0.0} | (dict.fromkeys(GAP, 0.0) if gap else {})
        stations = lines.get(axis) or lines["stations"]
        values |= {x: value for x, value in zip(stations, lines[name], strict=True) if value is not None}
        ordered = sorted(values.items())
        found[name] = Curve(np.array([x for x, _ in ordered]), np.array([y for _, y in ordered]), gap)
    return found


def least(curve: Curve) -> float:
    """The least value of a curve, between its stations too."""
    stations = curve.stations
    fine = np.unique(np.concatenate([stations + f * np.append(np.diff(stations), 0.0) for f in np.arange(16) / 16]))
    return float(np.nanmin(curve.at(fine)))


def deviations(curve: Curve, reference: Curve) -> NDArray[np.float64]:
    """Deviations of two profiles at the inner stations that are in the fluid, those of a table at its own."""
    few = reference.stations if reference.table else curve.stations
    inner = np.array([x for x in few if 0 < x < 1 and not (reference.gap and GAP[0] <= x <= GAP[1])])
    return np.abs(curve.at(inner) - reference.at(inner))


def scores(case: str, row: Row) -> Row:
    """The least u, and deviations in lid speeds from the time-accurate flow, if the run ended when that is known.

    u_min_error: the least u less that of the reference.
    u_deviation, v_deviation: means over the profiles; with _max, the largest.
    deviation: the mean of both.
    paper_err: the paper's Err, |least u less that of `papers_reference`|.
    paper_deviation: as deviation, from that reference.
    """
    mine = curves(case, row)
    if not mine:
        return {}
    row_scores: Row = {"u_min": least(mine["u"])}
    reference_flow = reference(case, row["reynolds"], row["time"])
    if reference_flow is None:
        return {name: significant(value) for name, value in row_scores.items()}
    off = {name: deviations(mine[name], curve) for name, curve in (("u", reference_flow.u), ("v", reference_flow.v))}
    row_scores["u_min_error"] = row_scores["u_min"] - least(reference_flow.u)
    for name, each in off.items():
        row_scores |= {f"{name}_deviation": float(each.mean()), f"{name}_deviation_max": float(each.max())}
    row_scores["deviation"] = fmean(float(each.mean()) for each in off.values())
    if row["reynolds"] == REYNOLDS:
        paper = papers_reference(case)
        row_scores["paper_err"] = abs(row_scores["u_min"] - papers_u_min(case))
        both = (deviations(mine["u"], paper.u), deviations(mine["v"], paper.v))
        row_scores["paper_deviation"] = fmean(float(each.mean()) for each in both)
    return {name: significant(value) for name, value in row_scores.items()}
