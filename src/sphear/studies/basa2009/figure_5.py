"""Figure 5: when a channel fails, for each viscous term, correction and equation of state, and its error before."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import product
from statistics import median
from typing import TYPE_CHECKING, Any

from sphear.results.table import Column, Table
from sphear.studies.basa2009.models import CORRECTIONS, LEVELS
from sphear.studies.basa2009.robustness import EQUATIONS, ERROR_REYNOLDS, TERMS, best_runs, runs
from sphear.studies.basa2009.robustness_results import entries, error_at, highest_steady, outcome, percent
from sphear.studies.kept import swept
from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.rows import Row, select

if TYPE_CHECKING:
    from matplotlib.figure import Figure

CLAIM = (
    "model A fails without correction and is cured by level 0; B is the least robust but accurate; D and E are the best"
    " in both, C is as robust and less accurate; corrections help them little"
)
LABELS = {"batchelor_tait": "weakly compressible", "ideal_gas": "compressible"}


def compute(*, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
    """Every run, in what is shown of it."""
    best = entries(swept(best_runs(quick), "basa2009", workers, progress))
    found = entries(swept(runs(quick), "basa2009", workers, progress))
    return {**found, "best_settings": best["settings"], "best": best["runs"]}


def present(data: dict[str, Any]) -> StudyResult:
    """Tables of the times of failure, plots of both columns of the figure, and what they say."""
    rows: list[Row] = data["runs"]
    tables = [_table(rows, equation, correction) for equation, correction in _pairs(rows)]
    said, agrees = _finding(rows)
    best: list[Row] = data.get("best", [])
    if best:
        tables.append(_best_table(best))
        steady = highest_steady(best)
        worst = max((row["rms_error"] for row in best if outcome(row) == "steady"), default=math.inf)
        said += f"; beyond the paper, the best settings reach it up to Re = {steady:g}, errors at most"
        said += f" {percent(worst)}"
    return StudyResult(CLAIM, said, agrees, rows, tables, {"figure-5": lambda: _figure(rows, best)})


def _pairs(rows: Sequence[Row]) -> list[tuple[str, str]]:
    return [
        pair for pair in product(EQUATIONS, CORRECTIONS) if select(rows, equation_of_state=pair[0], correction=pair[1])
    ]


def _terms(rows: Sequence[Row]) -> list[str]:
    return [term for term in TERMS if select(rows, viscosity=term)]


def _table(rows: Sequence[Row], equation: str, correction: str) -> Table:
    """t* of failure, a row a Reynolds number; "steady" and "steps" (500,000 of them) where there was none."""
    mine = select(rows, equation_of_state=equation, correction=correction)
    lines = []
    for reynolds in sorted({row["reynolds"] for row in mine}):
        line: Row = {"reynolds": f"{reynolds:g}"}
        for row in select(mine, reynolds=reynolds):
            stood = outcome(row)
            line[row["viscosity"]] = f"{row['time']:.3g}" if stood == "failed" else f"{stood} {row['time']:.3g}"
        lines.append(line)
    columns = (Column("reynolds", "Re"), *(Column(term, term) for term in _terms(mine)))
    return Table(f"t* at which the channel fails: {LABELS[equation]}, {LEVELS[correction]}", columns, lines)


def _best_table(rows: Sequence[Row]) -> Table:
    lines = [
        {"reynolds": row["reynolds"], "end": outcome(row), "time": row["time"], "rms_error": row["rms_error"]}
        for row in sorted(rows, key=lambda row: float(row["reynolds"]))
    ]
    columns = (
        Column("reynolds", "Re", "g"),
        Column("end", "end"),
        Column("time", "t*", ".3g"),
        Column("rms_error", "RMS error", ".2e"),
    )
    return Table("Beyond the paper: the best settings", columns, lines)


def _finding(rows: Sequence[Row]) -> tuple[str, Agreement]:
    def robust(**wanted: Any) -> float:
        return highest_steady(select(rows, **wanted))

    at = [row for row in rows if row["reynolds"] == ERROR_REYNOLDS]

    def error(term: str) -> float:
        return median(error_at(row, 5.0) for row in select(at, viscosity=term))

    terms = _terms(rows)
    plain = {term: robust(equation_of_state="batchelor_tait", correction="none", viscosity=term) for term in terms}
    zeroth = {term: robust(equation_of_state="batchelor_tait", correction="shepard", viscosity=term) for term in terms}
    reach = ", ".join(f"{term} {plain[term]:g} ({zeroth[term]:g})" for term in terms)
    errors = ", ".join(f"{term} {percent(error(term))}" for term in terms)
    said = (
        f"weakly compressible, the steady state is reached at every Re tried up to, without correction (with level 0):"
        f" {reach}; median RMS errors at Re = 0.5, t* = 5, of all corrections and equations of state: {errors}"
    )
    if "takeda" not in plain:
        return said, "partly"
    cured = plain["takeda"] < min(plain["morris"], zeroth["takeda"])
    best = error("violeau") > max(error("morris"), error("cleary_4.24"))
    least = plain["two_pass"] <= min(plain["violeau"], plain["morris"], plain["cleary_4.24"])
    held = [cured, best, least]
    return said, "yes" if all(held) else "partly" if any(held) else "no"


def _figure(rows: Sequence[Row], best: Sequence[Row]) -> Figure:
    from sphear.results.figure.robustness import Panel, robustness_panels

    panels = []
    if best:
        name = best[0]["viscosity"]
        ends = [(row["reynolds"], row["time"], outcome(row)) for row in best]
        errors = [(t, e) for row in best for t, e in row.get("history", []) if e]
        panels.append(Panel("beyond the paper: best settings", {name: ends}, {name: errors}))
    for equation, correction in _pairs(rows):
        mine = select(rows, equation_of_state=equation, correction=correction)
        panels.append(
            Panel(
                f"{LABELS[equation]}, {LEVELS[correction]}",
                {
                    term: [(row["reynolds"], row["time"], outcome(row)) for row in select(mine, viscosity=term)]
                    for term in _terms(mine)
                },
                {
                    term: [(t, e) for row in select(mine, viscosity=term) for t, e in row.get("history", []) if e]
                    for term in _terms(mine)
                },
            )
        )
    return robustness_panels(panels, "Poiseuille channel, 20 x 20 particles (Basa, Quinlan & Lastiwka 2009, figure 5)")
