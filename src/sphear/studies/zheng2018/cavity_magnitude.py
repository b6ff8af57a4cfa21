"""Figures 8 and 12: the magnitude of the velocity, beside what is kept of OpenFOAM's."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sphear.references.cavity import Curve, cavity_cylinder, openfoam
from sphear.results.table import Column, Table
from sphear.studies.result import Agreement, StudyResult
from sphear.studies.rows import Row, failed
from sphear.studies.zheng2018.cavities import DRAWN, REYNOLDS, UNTIL
from sphear.studies.zheng2018.cavity_rows import curves, deviations
from sphear.studies.zheng2018.cavity_shown import NAMES, NOTHING, Data, drawn, ended, field_of, joined, main_rows

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from sphear.results.figure.fields import ProfilePanel

SIMILAR, UNLIKE = 0.02, 0.05  # mean deviations of profiles, in lid speeds, up to which fields are alike, or partly
LINES = (("u", "y", "u on x = 1/2"), ("v", "x", "v on y = 1/2"))
ONLY = "of OpenFOAM's field the profiles on both centrelines are known"


def finest(data: Data) -> Row | None:
    """The run with the most particles whose field is drawn; None if there is none."""
    rows = [row for row in ended(main_rows(data)) if row["viscosity"] == DRAWN]
    return max(rows, key=lambda row: int(row["resolution"]), default=None)


def meshes(data: Data) -> dict[str, dict[str, Curve]]:
    """OpenFOAM's profiles at the end of the runs: as computed, and extrapolated."""
    if data["until"] != UNTIL:
        return {}
    found = {}
    for name, extrapolated in (("OpenFOAM, finest mesh", False), ("OpenFOAM, extrapolated", True)):
        cylinder = data["case"] == "cavity-cylinder"
        flow = cavity_cylinder(extrapolated=extrapolated) if cylinder else openfoam(REYNOLDS, extrapolated=extrapolated)
        found[name] = {"u": flow.u, "v": flow.v}
    return found


def magnitude(data: Data, claim: str, number: int) -> StudyResult:
    """Deviations of the profiles from OpenFOAM's, and the field."""
    row = finest(data)
    rows = [] if row is None else _rows(data, row)
    said, verdict = _finding(row, rows)
    columns = (
        Column("reference", "compared with"),
        Column("resolution", "particles a side", "d"),
        Column("u_deviation", "mean deviation of u", ".4f"),
        Column("v_deviation", "of v", ".4f"),
        Column("u_largest", "largest of u", ".4f"),
        Column("v_largest", "of v", ".4f"),
    )
    table = Table(f"Profiles of {NAMES[data['case']]} with {DRAWN}, from OpenFOAM's", columns, rows)
    figures = {f"figure-{number}": lambda: _figure(data, number, row)}
    return StudyResult(claim, joined(said, ONLY), verdict, rows, [table], figures)


def _rows(data: Data, row: Row) -> list[dict[str, Any]]:
    mine = curves(data["case"], row)
    found = []
    for name, known in meshes(data).items():
        off = {line: deviations(mine[line], known[line]) for line in ("u", "v")}
        found.append(
            {"reference": name, "resolution": row["resolution"]}
            | {f"{line}_deviation": float(each.mean()) for line, each in off.items()}
            | {f"{line}_largest": float(each.max()) for line, each in off.items()}
        )
    return found


def _finding(row: Row | None, rows: list[dict[str, Any]]) -> tuple[str, Agreement]:
    if row is None or failed(row):
        return NOTHING, "partly"
    where = f"{row['resolution']} particles a side, t = {row['time']:.3g}"
    if not rows:
        return f"{where}: OpenFOAM's profiles are of another time", "partly"
    parts = [
        f"{line['u_deviation']:.4f} in u and {line['v_deviation']:.4f} in v from {line['reference']} (largest"
        f" {line['u_largest']:.3f} and {line['v_largest']:.3f})"
        for line in rows
    ]
    worst = max(rows[-1]["u_deviation"], rows[-1]["v_deviation"])
    verdict: Agreement = "yes" if worst <= SIMILAR else "partly" if worst <= UNLIKE else "no"
    return f"{where}: mean deviations {'; '.join(parts)}, where up to {SIMILAR:g} lid speeds count as similar", verdict


def _figure(data: Data, number: int, row: Row | None) -> Figure:
    from sphear.results.figure.fields import ProfilePanel, field_and_profiles

    mine = {} if row is None else curves(data["case"], row)
    panels: list[ProfilePanel] = []
    for name, axis, label in LINES:
        references = {which: drawn(known[name]) for which, known in meshes(data).items()}
        own = {DRAWN: drawn(mine[name], smooth=True)} if mine else {}
        panels.append(ProfilePanel(label, (axis, name), own, references))
    size = "" if row is None else f", {row['resolution']} particles a side, t = {row['time']:.3g}"
    title = f"{NAMES[data['case']].capitalize()} (Zheng, Ma & Shao 2018, figure {number})"
    return field_and_profiles(field_of(row, data["case"]), f"{DRAWN}{size}", panels, title)
