"""Figure 2: a compressible channel starts, with and without pressure reduction."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.cases.flow.poiseuille import FAILED, HALF_WIDTH, POISEUILLE, reference
from sphear.operators import arguments
from sphear.results.table import Column, Table
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings
from sphear.simulation.observers import Call, StopWhen
from sphear.studies.basa2009.channel import (
    BROKE_DOWN,
    advanced,
    channel,
    deviation,
    points,
    reached,
    root_mean_square,
    seconds,
)
from sphear.studies.basa2009.lattice import sliding_growth
from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.rows import significant

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from sphear.cases.flow.run import CaseRun

CLAIM = (
    "at Re = 0.3 the compressible channel of model E develops critical instabilities without pressure reduction, where"
    " shear has disturbed the particles most, and none with it"
)
REYNOLDS, AT_REST = 0.3, 1e-6  # of the paper; so slow that nothing is disturbed
STEADY = 28.0  # t*, from which on the flow is steady
LOST = 10.0  # RMS error at which a run is given up
PROFILES = {
    "none": (0.01, 0.02, 0.03, 0.04),
    "mean": (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, STEADY),
    "hydrostatic": (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, STEADY),
}


def compute(*, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
    """The runs, one after the other: each takes less than a minute."""
    plan = [("none", REYNOLDS), ("mean", REYNOLDS), ("hydrostatic", REYNOLDS), ("none", AT_REST)]
    resolution, until = (10, 0.5) if quick else (20, STEADY)
    runs = []
    for reduction, reynolds in plan[:2] if quick else plan:
        progress(f"pressure reduction {reduction}, Re = {reynolds:g}")
        about: dict[str, Any] = {"pressure_reduction": reduction, "reynolds": reynolds}
        settings = channel(**about, equation_of_state="ideal_gas", resolution=resolution, until=until)
        runs.append({**about, **_run(settings, until)})
    return {"viscosity": "morris", "correction": "none", "resolution": resolution, "until": until, "runs": runs}


def _run(settings: WeaklyCompressibleSettings, until: float) -> dict[str, Any]:
    """Errors at times that grow by a twentieth, and profiles at the chosen ones."""
    shown = [time for time in PROFILES[settings.pressure_reduction] if time <= until]
    looks = seconds(settings, {*shown, *np.geomspace(0.002, until, 196).tolist()})
    observed, profiles = Call(_errors, when=looks), Call(points, when=seconds(settings, shown))
    given_up = StopWhen(lambda _: observed.rows[-1][1] >= LOST and f"RMS error of {LOST:.0%}", when=looks)
    end = advanced(settings, observed, profiles, given_up).end
    times, errors, _ = (list(column) for column in zip(*observed.rows, strict=True))
    failed, row = next(((time, row) for time, error, row in observed.rows if error >= FAILED), (None, None))
    return {
        "failure_time": failed,
        "row_from_wall": row,
        "growth": _growth(np.array(times), np.array(errors)) if failed is not None else None,
        "end": "steady" if end == "time" and until >= STEADY else end.removeprefix(BROKE_DOWN),
        "times": times,
        "errors": errors,
        "profiles": profiles.rows,
    }


def _errors(run: CaseRun) -> tuple[float, float, float]:
    """t*, the RMS error, and the row, counted from a wall, of the particle that is most off."""
    off, flow = deviation(run), run.flow
    most = HALF_WIDTH - abs(flow.positions[np.abs(off).argmax(), 1])
    return significant(reached(run)), significant(root_mean_square(off)), float(np.floor(most / flow.problem.spacing))


def _growth(times: Any, errors: Any) -> float | None:
    """The rate of the exponential growth from 12 % to 1000 %, in 1 / t*; None where it does not get there."""
    between = (errors >= FAILED) & (errors <= LOST)
    if not (errors >= LOST).any() or between.sum() < 3:
        return None
    return significant(float(np.polyfit(times[between], np.log(errors[between]), 1)[0]), 3)


def present(data: dict[str, Any]) -> StudyResult:
    """The time at which each run fails, its errors and its profiles."""
    rows = []
    for run in data["runs"]:
        at = np.array(run["times"])
        errors = {f"error_{t:g}": run["errors"][int(np.abs(at - t).argmin())] for t in (0.02, 0.05, 1.0) if t < at[-1]}
        rows.append({key: value for key, value in run.items() if not isinstance(value, list)} | errors)
        rows[-1] |= {"time": run["times"][-1], "error": run["errors"][-1], "largest": max(run["errors"])}
    without, reduced = rows[0], rows[1]
    fails, holds = without["failure_time"] is not None, reduced["failure_time"] is None
    finding = _of_none(without, data["resolution"]) if fails else "without reduction it does not fail"
    finding += f"; with the mean subtracted the error is at most {reduced['largest']:.1%}"
    finding += f" and {reduced['error']:.1%} at t* = {reduced['time']:.3g}"
    if not holds:
        finding += f", and it fails at t* = {reduced['failure_time']:.3g}"
    for row in rows[2:]:
        when = "does not fail" if row["failure_time"] is None else f"passes 12 % at t* = {row['failure_time']:.3g}"
        if row["pressure_reduction"] == "hydrostatic":
            finding += f"; with the pressure at rest subtracted it {when}"
        else:
            finding += f"; at Re = {row['reynolds']:g}, where shear disturbs nothing, it {when} without reduction"
    agrees: Agreement = "yes" if fails and holds else "no"
    if agrees == "yes" and any(row["reynolds"] < REYNOLDS and row["failure_time"] for row in rows):
        agrees = "partly"  # it fails, but not where shear disturbs
        finding += f": what is unstable is the lattice under pressure, by linear theory at {_theory():.3g} / t*"
    title = "Compressible channel at Re = 0.3, morris, uncorrected (Basa, Quinlan & Lastiwka 2009, figure 2)"
    columns = (
        Column("pressure_reduction", "pressure reduction"),
        Column("reynolds", "Re", "g"),
        Column("failure_time", "12 % at t*", ".3g"),
        Column("growth", "growth, 1 / t*", ".3g"),
        Column("error_0.02", "RMS error, t* = 0.02", ".1%"),
        Column("error_0.05", "0.05", ".1%"),
        Column("error_1", "1", ".1%"),
        Column("error", "at the end", ".1%"),
        Column("time", "t* at the end", ".3g"),
        Column("end", "end"),
    )
    figures = {"figure-2": lambda: _figure(data, title)}
    return StudyResult(CLAIM, finding, agrees, rows, [Table(title, columns, rows)], figures)


def _of_none(row: dict[str, Any], resolution: int) -> str:
    settings = POISEUILLE.explicit(reynolds=row["reynolds"])
    seconds = row["failure_time"] * POISEUILLE.time_unit(settings)
    moved = 0.5 * reference(settings).body_force * seconds**2 * resolution / (2 * HALF_WIDTH)
    grows = "" if row["growth"] is None else f" and grows at {row['growth']:.3g} / t*"
    return (
        f"without reduction the RMS error passes 12 % at t* = {row['failure_time']:.3g}{grows}, most in row"
        f" {row['row_from_wall'] + 1:.0f} from the wall and when no particle has moved by more than {moved:.1g} dx"
    )


def _theory() -> float:
    """The growth rate on an infinite lattice, in 1 / t*."""
    settings = POISEUILLE.explicit(reynolds=REYNOLDS, equation_of_state="ideal_gas")
    spacing = 2 * HALF_WIDTH / settings.resolution
    kernel = arguments.read_kernel(settings.kernel, settings.h_over_dx, spacing)
    rate, _ = sliding_growth(settings.initial_pressure, spacing, kernel.h)
    return rate * POISEUILLE.time_unit(settings)


def _figure(data: dict[str, Any], title: str) -> Figure:
    from sphear.results.figure import Snapshot, snapshots

    panels = {}
    y = np.linspace(-HALF_WIDTH, HALF_WIDTH, 201)
    for run in data["runs"]:
        settings = POISEUILLE.explicit(reynolds=run["reynolds"])
        flow, unit = reference(settings), POISEUILLE.time_unit(settings)
        if run["reynolds"] == REYNOLDS:
            panels[f"pressure reduction: {run['pressure_reduction']}"] = [
                Snapshot(
                    f"t* = {profile['time']:.2g}",
                    (y, flow.velocity(y, profile["time"] * unit) / flow.centreline_velocity),
                    (profile["y"], profile["u"]),
                )
                for profile in run["profiles"]
            ]
    return snapshots(panels, "y, m", "u / U0", title)
