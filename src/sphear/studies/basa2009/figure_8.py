"""Figure 8: velocities in the lid-driven cavity, model E with level 0."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.cases.flow import FLOWS
from sphear.cases.flow.run import CaseRun
from sphear.cases.flow.start import flow_settings
from sphear.results.table import Column, Table
from sphear.studies.basa2009.cavity import PARTICLES, UNTIL
from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.rows import failed

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = np.ndarray[Any, Any]

CLAIM = "model E with level 0 gives the primary vortex at Re = 100 and 1000"
# the centres of the primary vortex, Ghia, Ghia & Shin 1982, table III
CENTRES = {100.0: (0.6172, 0.7344), 1000.0: (0.5313, 0.5625)}

NEAR = 20  # particles around the centre of a vortex


def compute(*, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
    """Positions and velocities of all particles at the end."""
    found = []
    for reynolds, until in {100.0: 1.0}.items() if quick else UNTIL.items():
        changes: dict[str, Any] = {"reynolds": reynolds, "until": until, "resolution": 20 if quick else PARTICLES}
        case = FLOWS["cavity"]
        run = CaseRun(case, flow_settings(case, changes, "basa2009"))
        run.run(lambda text, reynolds=reynolds: progress(f"Re = {reynolds:g}: {text}"))  # type: ignore[misc]
        found.append(
            {
                "reynolds": reynolds,
                "time": run.history[-1]["time"],
                "end": run.end,
                "positions": np.round(run.flow.positions, 4).tolist(),
                "velocities": np.round(run.flow.velocities, 4).tolist(),
            }
        )
    return {"runs": found}


def vortex_centre(positions: Array, velocities: Array) -> tuple[float, float]:
    """The place where fluid stands still in the primary vortex; NaN if there is none.

    The particle around which its 20 nearest turn best, by the mean sine of the angle between the way to them and their
    velocity (Graftieaux, Michard & Grosjean 2001, Meas. Sci. Technol. 12:1422), then the zero of the linear field that
    fits these best.
    """
    inside = ((positions > 0.25) & (positions < 0.9)).all(axis=1) & np.isfinite(velocities).all(axis=1)
    x, v = positions[inside], velocities[inside]
    if len(x) <= NEAR:
        return math.nan, math.nan
    away = x[None] - x[:, None]
    near = np.argsort((away**2).sum(axis=2), axis=1)[:, 1 : NEAR + 1]
    way, u = np.take_along_axis(away, near[:, :, None], 1), v[near]
    lengths = np.linalg.norm(way, axis=2) * np.linalg.norm(u, axis=2)
    turning = (way[..., 0] * u[..., 1] - way[..., 1] * u[..., 0]) / np.maximum(lengths, 1e-300)
    best = int(np.abs(turning.mean(axis=1)).argmax())
    chosen = np.append(near[best], best)
    fit = np.linalg.lstsq(np.column_stack((np.ones(len(chosen)), x[chosen])), v[chosen], rcond=None)[0]
    if np.linalg.matrix_rank(fit[1:]) < 2:
        return math.nan, math.nan
    centre = np.linalg.solve(fit[1:].T, -fit[0])
    return float(centre[0]), float(centre[1])


def present(data: dict[str, Any]) -> StudyResult:
    """The centre of the vortex beside Ghia's, and the vectors."""
    rows = []
    for run in data["runs"]:
        x, y = vortex_centre(np.array(run["positions"], float), np.array(run["velocities"], float))
        known = CENTRES[run["reynolds"]]
        rows.append(
            {"reynolds": run["reynolds"], "time": run["time"], "end": run["end"], "x": x, "y": y, "ghia_x": known[0],
             "ghia_y": known[1]}
        )  # fmt: skip
    off = [float(np.hypot(row["x"] - row["ghia_x"], row["y"] - row["ghia_y"])) for row in rows]
    said = "; ".join(
        f"Re = {row['reynolds']:g}, t = {row['time']:.3g}: the vortex turns about ({row['x']:.3f}, {row['y']:.3f}),"
        f" {distance:.3f} from Ghia's steady ({row['ghia_x']:.3f}, {row['ghia_y']:.3f})"
        for row, distance in zip(rows, off, strict=True)
    )
    agrees: Agreement = "no" if any(map(failed, rows)) else "yes" if np.max(off) < 0.03 else "partly"
    columns = (
        Column("reynolds", "Re", "g"), Column("time", "t", ".3g"), Column("end", "end"), Column("x", "x", ".3f"),
        Column("y", "y", ".3f"), Column("ghia_x", "Ghia's x", ".3f"), Column("ghia_y", "Ghia's y", ".3f"),
    )  # fmt: skip
    table = Table("Centre of the primary vortex", columns, rows)
    return StudyResult(CLAIM, said, agrees, rows, [table], {"figure-8": lambda: _figure(data)})


def _figure(data: dict[str, Any]) -> Figure:
    from sphear.results.figure.vectors import vector_panels

    panels = {
        f"Re = {run['reynolds']:g}, t = {run['time']:.3g}": (run["positions"], run["velocities"])
        for run in data["runs"]
    }
    return vector_panels(panels, "Lid-driven cavity, model E, level 0 (Basa, Quinlan & Lastiwka 2009, figure 8)")
