"""Figure 10: velocity profiles on the centrelines of the lid-driven cavity."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any

from sphear.references.cavity import ghia, mac
from sphear.results.table import Column, Table
from sphear.studies.basa2009.cavity_results import compute, corrections, reynolds_numbers
from sphear.studies.basa2009.models import LEVELS
from sphear.studies.result import Agreement, StudyResult
from sphear.studies.rows import Row, failed, outcome, select

if TYPE_CHECKING:
    from matplotlib.figure import Figure

CLAIM = (
    "at Re = 100 all terms are alike but for B, whose particles clump; at Re = 1000 they differ more, A is noisy, and D"
    " produces the best results by a small margin"
)
KEPT = "figure-9"  # whose runs are the same
__all__ = ["KEPT", "compute", "deviation", "present"]


def present(data: dict[str, Any]) -> StudyResult:
    """Deviations of the profiles from the reference at the same time, and the profiles."""
    rows: list[Row] = data["runs"]
    said, agrees = _finding(rows)
    return StudyResult(CLAIM, said, agrees, rows, [_table(rows)], {"figure-10": lambda: _figure(rows)})


def _table(rows: list[Row]) -> Table:
    names = ("u_mean_deviation", "u_max_deviation", "v_mean_deviation", "v_max_deviation")
    lines = [
        {"reynolds": row["reynolds"], "correction": LEVELS[row["correction"]], "viscosity": row["viscosity"],
         "end": outcome(row), **{name: row.get(name) for name in names}}
        for row in rows
    ]  # fmt: skip
    columns = (
        Column("reynolds", "Re", "g"),
        Column("correction", "correction"),
        Column("viscosity", "term"),
        Column("end", "end"),
        *(Column(name, name.replace("_", " "), ".4f") for name in names),
    )
    return Table("Deviations of centreline velocities, in lid speeds", columns, lines)


def deviation(row: Row) -> float:
    """The mean deviation of both profiles, in lid speeds; infinite of a run that failed."""
    if failed(row) or "u_mean_deviation" not in row:
        return float("inf")
    return 0.5 * float(row["u_mean_deviation"] + row["v_mean_deviation"])


def _finding(rows: list[Row]) -> tuple[str, Agreement]:
    parts, best = [], []
    for reynolds in reynolds_numbers(rows):
        finished = sorted((row for row in select(rows, reynolds=reynolds) if not failed(row)), key=deviation)
        broken = [row for row in select(rows, reynolds=reynolds) if failed(row)]
        each = ", ".join(f"{row['viscosity']} ({LEVELS[row['correction']]}) {deviation(row):.4f}" for row in finished)
        lost = ", ".join(f"{row['viscosity']} ({LEVELS[row['correction']]})" for row in broken)
        parts.append(
            f"Re = {reynolds:g}, mean deviation of both profiles: {each or 'none reached its time'}"
            + (f"; failed: {lost}" if lost else "")
        )
        best += [row["viscosity"].startswith("cleary") for row in finished[:1]]
    agrees: Agreement = "yes" if best and all(best) else "partly"
    return "; ".join(parts), agrees


def _figure(rows: list[Row]) -> Figure:
    from sphear.results.figure.history import HistoryPanel, history_panels

    panels = []
    for correction, reynolds in product(corrections(rows), reynolds_numbers(rows)):
        mine = [row for row in select(rows, correction=correction, reynolds=reynolds) if row["profiles"]]
        curves = {row["viscosity"]: (row["profiles"]["stations"], row["profiles"]["u"]) for row in mine}
        exact, table = mac(reynolds), ghia(reynolds)
        known = {
            "staggered grid, extrapolated": (exact.u.stations, exact.u.values),
            "Ghia, Ghia & Shin (steady)": (table.u.stations, table.u.values),
        }
        lacking = "" if mine else ": not computed"
        panels.append(HistoryPanel(f"Re = {reynolds:g}, {LEVELS[correction]}{lacking}", curves, known))
    return history_panels(
        panels, "y", "u on x = 1/2", "Lid-driven cavity (Basa, Quinlan & Lastiwka 2009, figure 10)",
        columns=max(1, len(reynolds_numbers(rows))), points=("Ghia, Ghia & Shin (steady)",),
    )  # fmt: skip
