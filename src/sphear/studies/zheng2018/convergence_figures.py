"""Figures 3 and 5: a table of errors as curves, the paper's reading of the error beside the honest one."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from types import ModuleType
from typing import TYPE_CHECKING

from sphear.references.zheng2018 import TERMS
from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.rows import Row, select
from sphear.studies.zheng2018 import table_1, table_2
from sphear.studies.zheng2018.patch import JITTER, last

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Orders = dict[str, float]


def orders_in_particles(rows: list[Row], key: str) -> Orders:
    """k of Err ~ N^-k, N the number of particles, from the coarsest and the finest size: the paper's orders."""
    found = {}
    for name in TERMS.values():
        mine = sorted(select(rows, viscosity=name), key=lambda row: row["particles"])
        ratio = math.log(mine[0][key] / mine[-1][key])
        found[name] = ratio / math.log((mine[-1]["particles"] / mine[0]["particles"]) ** 2)
    return found


def curves(rows: list[Row], key: str) -> dict[str, tuple[list[float], list[float]]]:
    """A number of each term against the number of particles a side."""
    mine = {name: select(rows, viscosity=name) for name in TERMS.values()}
    return {name: ([row["particles"] for row in its], [row[key] for row in its]) for name, its in mine.items()}


def drawn(rows: list[Row], title: str, slope: float) -> Figure:
    """Both readings of the error against the number of particles a side, beside a line of a slope."""
    from sphear.results.figure import Convergence, convergence_panels

    panels = [
        Convergence(
            curves(rows, "computed"),
            "Err as in the paper: divided by M once more",
            published=curves(rows, "published"),
        ),
        Convergence(curves(rows, "l1_relative"), "L1-relative error", (slope,)),
    ]
    return convergence_panels(panels, "particles a side", title)


@dataclass(frozen=True)
class ConvergenceFigure:
    """A table of errors as curves.

    Attributes:
        number: of the figure.
        table: the module of the table.
        where: on which particles.
        slope: of the line that is drawn beside the honest errors.
        claim: what the paper says of it.
        said: what was found, from the orders k in the paper's reading, the honest ones and the rows.
        as_claimed: whether the paper's reading has the orders that it claims.
        converges: whether the honest errors fall.
    """

    number: int
    table: ModuleType
    where: str
    slope: float
    claim: str
    said: Callable[[Orders, Orders, list[Row]], str]
    as_claimed: Callable[[Orders], bool]
    converges: Callable[[Orders], bool]

    def run(self, *, quick: bool, progress: Progress) -> StudyResult:
        """The table as curves."""
        table: StudyResult = self.table.run(quick=quick, progress=progress)
        paper, honest = (orders_in_particles(table.rows, key) for key in ("computed", "l1_relative"))
        agrees: Agreement = "no"
        if self.as_claimed(paper):
            agrees = "yes" if self.converges(honest) else "partly"
        title = f"Patch test on {self.where} (Zheng, Ma & Shao 2018, figure {self.number})"
        figures = {f"figure-{self.number}": lambda: drawn(table.rows, title, self.slope)}
        finding = self.said(paper, honest, table.rows)
        return StudyResult(self.claim, finding, agrees, table.rows, table.tables, figures, table.other_readings)


def _on_a_lattice(paper: Orders, honest: Orders, rows: list[Row]) -> str:
    return (
        f"Err falls with k = {paper['morris']:.2f}, {paper['gotoh']:.2f}, {paper['schwaiger']:.2f} and"
        f" {paper['oger']:.2f}, of which 1 is the division by the number of samples: the error itself has k ="
        f" {honest['morris']:.2f}, {honest['gotoh']:.2f}, {honest['schwaiger']:.2f} and {honest['oger']:.2f}, so"
        f" VISC-01 and VISC-02 do not converge and VISC-03 and VISC-04 are of order"
        f" {last(rows, 'schwaiger', 'order'):.1f} in dx"
    )


def _on_jittered_particles(paper: Orders, honest: Orders, rows: list[Row]) -> str:
    return (
        f"Err falls with k = {paper['schwaiger']:.2f} for VISC-03 and {paper['morris']:.2f}, {paper['gotoh']:.2f} and"
        f" {paper['oger']:.2f} for VISC-01, VISC-02 and VISC-04, but without the division by the number of samples k is"
        f" {honest['schwaiger']:+.2f} and {honest['morris']:+.2f}, {honest['gotoh']:+.2f}, {honest['oger']:+.2f}:"
        f" VISC-03 does not converge and the other three diverge like 1/dx"
    )


def _only_visc_03(paper: Orders) -> bool:
    """True if VISC-03 is near first order and the others are not."""
    third = paper["schwaiger"]
    return abs(third - 1) < 0.2 and all(paper[name] < third - 0.2 for name in paper if name != "schwaiger")


FIGURES = (
    ConvergenceFigure(
        3,
        table_1,
        "a lattice",
        -2,
        "the errors fall with the number of particles N as N^-k, with k about 1 for VISC-01 and VISC-02 and 2 for"
        " VISC-03 and VISC-04",
        _on_a_lattice,
        lambda paper: all(abs(paper[name] - k) < 0.35 for name, k in zip(paper, (1, 1, 2, 2), strict=True)),
        lambda honest: min(honest.values()) > 0.1,
    ),
    ConvergenceFigure(
        5,
        table_2,
        f"particles jittered by {JITTER} dx",
        1,
        "the convergence rate of VISC-03 is near first order in N, the other three terms do not reach it",
        _on_jittered_particles,
        _only_visc_03,
        lambda honest: honest["schwaiger"] > 0.1,
    ),
)
STUDIES = {f"figure-{figure.number}": figure for figure in FIGURES}
