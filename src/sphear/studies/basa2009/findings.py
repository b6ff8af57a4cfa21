"""Each finding of the paper, confirmed or contradicted, with its number."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from statistics import median
from typing import Any

from sphear.results.table import Column, Table
from sphear.studies.basa2009 import figure_2, figure_4, figure_7, figure_9, figure_10
from sphear.studies.basa2009.figure_5 import LABELS
from sphear.studies.basa2009.models import CORRECTIONS, LEVELS, MODELS
from sphear.studies.basa2009.robustness import EQUATIONS, ERROR_REYNOLDS
from sphear.studies.basa2009.robustness_results import error_at, highest_steady, percent
from sphear.studies.kept import kept
from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.rows import Row, failed, select

CLAIM = "ten findings, of sections 6.1.1 to 6.2 and 7"
PAPER = "basa2009"
Rows = Sequence[Row]
Said = tuple[str, Agreement]


def reach(rows: Rows, model: str, correction: str) -> str:
    """Up to which Re a model reaches the steady state, weakly compressible and compressible."""
    found = [
        highest_steady(select(rows, viscosity=MODELS[model], correction=correction, equation_of_state=equation))
        for equation in EQUATIONS
    ]
    return " and ".join(f"{x:g}" if x else "none" for x in found)


def robust(rows: Rows, model: str, correction: str, equation: str = "batchelor_tait") -> float:
    """The highest Re up to which a model reaches the steady state."""
    return highest_steady(select(rows, viscosity=MODELS[model], correction=correction, equation_of_state=equation))


def error(rows: Rows, model: str, *corrections: str) -> float:
    """The median RMS error at Re = 0.5, t* = 5, of both equations of state and these corrections."""
    return median(
        error_at(row, 5.0)
        for row in select(rows, viscosity=MODELS[model], reynolds=ERROR_REYNOLDS)
        if row["correction"] in (corrections or CORRECTIONS)
    )


def _cured(rows: Rows) -> Said:
    said = (
        f"steady up to Re = {reach(rows, 'A', 'none')} without ({' and '.join(LABELS.values())}), "
        f"{reach(rows, 'A', 'shepard')} with level 0; RMS error at Re = 0.5, t* = 5:"
        f" {percent(error(rows, 'A', 'none'))} and {percent(error(rows, 'A', 'shepard'))}"
    )
    without, with_it = robust(rows, "A", "none"), robust(rows, "A", "shepard")
    return said, "yes" if without == 0 < with_it else "partly" if without < with_it else "no"


def _least_robust(rows: Rows) -> Said:
    others = {model: robust(rows, model, "none") for model in "BCDE"}
    said = (
        f"B is steady up to Re = {reach(rows, 'B', 'none')} uncorrected and {reach(rows, 'B', 'shepard')} with level 0,"
        f" E up to {reach(rows, 'E', 'none')}; error at Re = 0.5: B {percent(error(rows, 'B'))}, E"
        f" {percent(error(rows, 'E'))}"
    )
    least = others["B"] <= min(others.values())
    accurate = error(rows, "B") <= 1.5 * min(error(rows, model) for model in "CDE")
    return said, "yes" if least and accurate else "partly" if least or accurate else "no"


def _best(rows: Rows) -> Said:
    errors = {model: error(rows, model) for model in MODELS}
    reached = {model: robust(rows, model, "none") for model in MODELS}
    said = "errors at Re = 0.5 " + ", ".join(f"{model} {percent(value)}" for model, value in errors.items())
    said += "; steady up to Re = " + ", ".join(f"{model} {value:g}" for model, value in reached.items())
    accurate = sorted(errors, key=errors.__getitem__)[:2]
    top = max(reached.values())
    both = all(reached[model] == top for model in "DE")
    return said, "yes" if both and set(accurate) == {"D", "E"} else "partly" if both or "D" in accurate else "no"


def _as_robust(rows: Rows) -> Said:
    reached = {model: robust(rows, model, "none") for model in "CDE"}
    said = (
        f"C is steady up to Re = {reached['C']:g}, D {reached['D']:g}, E {reached['E']:g}; errors"
        f" {percent(error(rows, 'C'))}, {percent(error(rows, 'D'))} and {percent(error(rows, 'E'))}"
    )
    worse = error(rows, "C") > max(error(rows, "D"), error(rows, "E"))
    return said, "yes" if worse and reached["C"] <= reached["E"] else "partly" if worse else "no"


def _little_help(rows: Rows) -> Said:
    said, helped, harmed = [], False, False
    for model in "CDE":
        plain, corrected = error(rows, model, "none"), error(rows, model, "bonet_lok")
        said.append(f"{model} {percent(plain)} to {percent(corrected)}")
        helped |= corrected < 0.5 * plain
        harmed |= model == "D" and corrected > plain
    verdict: Agreement = "yes" if harmed and not helped else "partly" if harmed or not helped else "no"
    return "errors at Re = 0.5 without and with level 1: " + ", ".join(said), verdict


def _cavity(rows: Rows) -> Said:
    finished = [row for row in rows if not failed(row)]
    best = {
        reynolds: min(select(finished, reynolds=reynolds), key=figure_10.deviation, default=None)
        for reynolds in (100.0, 1000.0)
    }
    said = "; ".join(
        f"Re = {reynolds:g}: the least deviation has {row['viscosity']} ({LEVELS[row['correction']]}),"
        f" {figure_10.deviation(row):.4f}"
        for reynolds, row in best.items()
        if row is not None
    )
    every = [row is not None and row["viscosity"].startswith("cleary") for row in best.values()]
    return said or "no run reached its time", "yes" if all(every) else "partly" if any(every) else "no"


def run(*, quick: bool, progress: Progress) -> StudyResult:
    """The findings, from the kept numbers of the figures."""
    channel = kept(PAPER, "figure-5")["runs"]
    cavity = kept(PAPER, "figure-9")["runs"]

    def of(module: Any, item: str) -> Callable[[], Said]:
        def said() -> Said:
            result = module.present(kept(PAPER, item))
            return result.finding, result.agrees

        return said

    findings: dict[str, Callable[[], Said]] = {
        "model A fails uncorrected and is cured by level 0": lambda: _cured(channel),
        "model B is the least robust, but accurate": lambda: _least_robust(channel),
        "D and E are the best in both": lambda: _best(channel),
        "C is as robust, but less accurate": lambda: _as_robust(channel),
        "corrections help C, D and E little, and can harm D": lambda: _little_help(channel),
        "pressure reduction decides compressible runs without correction": of(figure_2, "figure-2"),
        "mirrored velocities are the worst at the start, any extrapolation is good": of(figure_4, "figure-4"),
        "the failure is a slow exponential drift out of the rows": of(figure_7, "figure-7"),
        "in the cavity all terms under-predict the energy at Re = 1000": lambda: figure_9.under_predicted(cavity),
        "in the cavity D is the best by a small margin": lambda: _cavity(cavity),
    }
    rows = []
    for statement, found in findings.items():
        said, agrees = found()
        rows.append({"finding": statement, "agrees": agrees, "found": said})
    count = {verdict: sum(row["agrees"] == verdict for row in rows) for verdict in ("yes", "partly", "no")}
    finding = f"{count['yes']} hold, {count['partly']} hold in part, {count['no']} do not"
    verdict: Agreement = "yes" if count["yes"] == len(rows) else "no" if count["no"] == len(rows) else "partly"
    columns = (Column("finding", "the paper"), Column("agrees", "holds"), Column("found", "found"))
    return StudyResult(
        CLAIM, finding, verdict, rows, [Table("Findings of Basa, Quinlan & Lastiwka 2009", columns, rows)]
    )
