"""Figure 4: wall treatments a short time after the start of a compressible channel."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.cases.flow.poiseuille import HALF_WIDTH, POISEUILLE, reference
from sphear.results.table import Column, Table
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings
from sphear.simulation.observers import Call
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
from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.rows import significant

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from sphear.cases.flow.run import CaseRun

CLAIM = (
    "at start-up mirroring the velocity is the worst treatment of a wall and extrapolation is good; later they are"
    " similar"
)
TREATMENTS = ("mirror", "linear", "quadratic", "global_quadratic")
TIMES = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0)
SHOWN = 0.1  # t* of the profiles, which the paper does not state: the shear layer is then two spacings thick
LATER = 1.0
NEAR = 4.0  # spacings from a wall
OF_THE_PAPER = ("two_pass", "bonet_lok")
OTHER = ("morris", "none")  # the term of the other figures, for comparison


def compute(*, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
    """The runs, one after the other: each takes some seconds, most of which compile it."""
    plan = [(*OF_THE_PAPER, name, on_wall) for on_wall in (False, True) for name in TREATMENTS]
    plan += [(*OTHER, name, False) for name in TREATMENTS]
    resolution, times = (10, TIMES[:4]) if quick else (20, TIMES)
    runs = []
    for viscosity, correction, name, on_wall in plan[:2] if quick else plan:
        progress(f"{viscosity}, {name}{', wall particles' if on_wall else ''}")
        about = {"viscosity": viscosity, "correction": correction, "continuation": name, "wall_particles": on_wall}
        settings = channel(**about, equation_of_state="ideal_gas", resolution=resolution, until=times[-1])
        runs.append({**about, **_run(settings, times)})
    return {"reynolds": settings.reynolds, "resolution": resolution, "shown": SHOWN, "near": NEAR, "runs": runs}


def _run(settings: WeaklyCompressibleSettings, times: tuple[float, ...]) -> dict[str, Any]:
    """Errors near the walls, over the channel and of the row at the wall, and the profile at `SHOWN`."""
    observed, profile = Call(_errors, when=seconds(settings, times)), Call(points, when=seconds(settings, [SHOWN]))
    run = advanced(settings, observed, profile)
    found = {name: [row[name] for row in observed.rows] for name in ("times", "near", "all", "first_row")}
    end = run.end.removeprefix(BROKE_DOWN) if run.failed else ""
    return {**found, "end": end, **({"profile": profile.rows[0]} if profile.rows else {})}


def _errors(run: CaseRun) -> dict[str, float]:
    """t*, and the errors then."""
    off, flow = deviation(run), run.flow
    distance = (HALF_WIDTH - np.abs(flow.positions[:, 1])) / flow.problem.spacing
    found = {
        "times": reached(run),
        "near": root_mean_square(off[distance < NEAR]),
        "all": root_mean_square(off),
        "first_row": float(off[distance < 1].mean()),
    }
    return {name: significant(value) for name, value in found.items()}


def at(run: dict[str, Any], what: str, time: float) -> float:
    """An error of a run at the output nearest to a time; infinite if it failed before."""
    if run["times"][-1] < 0.9 * time:
        return np.inf
    return float(run[what][int(np.abs(np.array(run["times"]) - time).argmin())])


def present(data: dict[str, Any]) -> StudyResult:
    """The errors at `SHOWN` and later, ranked."""
    runs = data["runs"]
    last = runs[0]["times"][-1]
    times = [time for time in (0.02, SHOWN, LATER, 5.0) if time < 1.1 * last]
    rows: list[dict[str, Any]] = []
    for run in runs:
        about = {key: run[key] for key in ("viscosity", "correction", "continuation", "wall_particles")}
        errors = {f"near_{time:g}": at(run, "near", time) for time in times}
        whole = {f"all_{time:g}": at(run, "all", time) for time in times}
        rows.append({**about, **errors, **whole, f"first_row_{SHOWN:g}": at(run, "first_row", SHOWN)})
    plain = [row for row in rows if row["viscosity"] == OF_THE_PAPER[0] and not row["wall_particles"]]
    start = {row["continuation"]: row[f"near_{SHOWN:g}"] for row in plain}
    finding = f"at t* = {SHOWN:g} the RMS error within {data['near']:g} spacings of the walls is {_list(start)}"
    if LATER in times:
        late = {row["continuation"]: row[f"near_{LATER:g}"] for row in plain}
        finding += f"; at t* = {LATER:g} it is {_list(late)}"
        finding += f", where mirroring has let the row at the wall run {at(runs[0], 'first_row', LATER):+.0%} off"
        finding += _of_wall_particles(rows, plain)
        other = {row["continuation"]: row[f"near_{SHOWN:g}"] for row in rows if row["viscosity"] == OTHER[0]}
        finding += f"; with {OTHER[0]}, uncorrected, at t* = {SHOWN:g} it is {_list(other)}"
    worst = max(start, key=start.__getitem__)
    second = max((name for name in start if name != worst), key=start.__getitem__)
    alone = worst == "mirror" and (len(start) < 4 or start["mirror"] > 1.25 * start[second])
    good = all(value < 0.5 * start["mirror"] for name, value in start.items() if name != "mirror")
    agrees: Agreement = "yes" if alone and good else "partly" if start["linear"] < start["mirror"] else "no"
    title = (
        f"Compressible channel at Re = {data['reynolds']:g} with {data['resolution']} particles across (Basa, Quinlan &"
        " Lastiwka 2009, figure 4)"
    )
    columns = (
        Column("viscosity", "viscosity"),
        Column("correction", "correction"),
        Column("continuation", "wall velocity"),
        Column("wall_particles", "on the wall"),
        *(Column(f"near_{time:g}", f"near, t* = {time:g}", ".1%") for time in times),
        Column(f"first_row_{SHOWN:g}", f"first row, t* = {SHOWN:g}", "+.1%"),
        *(Column(f"all_{time:g}", f"all, t* = {time:g}", ".1%") for time in times),
    )
    figures = {"figure-4": lambda: _figure(data, title)}
    return StudyResult(CLAIM, finding, agrees, rows, [Table(title, columns, rows)], figures)


def _list(errors: dict[str, float]) -> str:
    return ", ".join(f"{value:.0%} ({name})" for name, value in errors.items())


def _of_wall_particles(rows: list[dict[str, Any]], plain: list[dict[str, Any]]) -> str:
    key = f"near_{SHOWN:g}"
    with_them = {row["continuation"]: row[key] for row in rows if row["wall_particles"]}
    factors = [with_them[row["continuation"]] / row[key] for row in plain]
    return f"; particles on the wall multiply the error at t* = {SHOWN:g} by {min(factors):.2f} to {max(factors):.2f}"


def _figure(data: dict[str, Any], title: str) -> Figure:
    from sphear.results.figure import Lines, line_panels

    settings = POISEUILLE.explicit(reynolds=data["reynolds"])
    flow, unit = reference(settings), POISEUILLE.time_unit(settings)
    edge = -HALF_WIDTH + 6 * 2 * HALF_WIDTH / data["resolution"]
    y = np.linspace(-HALF_WIDTH, edge, 101)
    panels = {}
    for on_wall in (False, True):
        runs = {
            run["continuation"]: run
            for run in data["runs"]
            if run["viscosity"] == OF_THE_PAPER[0] and run["wall_particles"] == on_wall and "profile" in run
        }
        if not runs:
            continue
        beside = "with particles on the wall" if on_wall else "without particles on the wall"
        shown = {}
        for name, run in runs.items():
            near = [(a, u) for a, u in zip(run["profile"]["y"], run["profile"]["u"], strict=True) if a <= edge]
            shown[name] = ([a for a, _ in near], [u for _, u in near])
        time = next(iter(runs.values()))["profile"]["time"]
        exact = (y, flow.velocity(y, time * unit) / flow.centreline_velocity)
        panels[f"t* = {SHOWN:g}, {beside}"] = Lines(shown, ("y, m", "u / U0"), exact=exact, points=True)
        errors = {name: (run["times"], run["near"]) for name, run in runs.items()}
        panels[f"near the walls, {beside}"] = Lines(errors, ("t*", "RMS error"), logarithmic="xy")
    return line_panels(panels, 2, title)
