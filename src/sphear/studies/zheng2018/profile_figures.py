"""Figures 2 and 4: the Laplacian along the line x = 0.5, computed and exact, on a lattice and on jittered particles."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.cases.lattice import lattice
from sphear.corrections import NoCorrection
from sphear.kernels import CubicSpline
from sphear.operators import Particles
from sphear.references.zheng2018 import TERMS
from sphear.results.table import Column, Table
from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.rows import select
from sphear.studies.zheng2018.patch import JITTER
from sphear.viscosity import VISCOSITY

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIZE = 20


def rows_along_line(jitter: float, seed: int = 0) -> list[dict[str, Any]]:
    """The Laplacian of x^4 + y^4 at the particles whose lattice node has x = 0.5 and 0 <= y <= 1."""
    grid = lattice(SIZE, 2, layers=6, jitter=jitter, seed=seed)
    particles = Particles.read(grid.positions, kernel=CubicSpline(grid.spacing), volumes=grid.volume)
    nodes = lattice(SIZE, 2, layers=6).positions
    line = np.flatnonzero((np.abs(nodes[:, 0] - 0.5) < 1e-9) & (grid.inside >= 0))
    exact = 12 * (grid.positions**2).sum(axis=1)
    values = (grid.positions**4).sum(axis=1)[:, None]
    rows = []
    for name in TERMS.values():
        computed = particles.laplacian(values, VISCOSITY[name], NoCorrection(), "nan")[:, 0]
        for i in line:
            x, y = grid.positions[i]
            found = {"computed": float(computed[i]), "exact": float(exact[i])}
            rows.append({"viscosity": name, "particles": SIZE, "x": float(x), "y": float(y), **found})
    return rows


def deviations(rows: list[dict[str, Any]]) -> dict[str, float]:
    """The mean deviation of each term along the line, relative to the largest exact value."""
    largest = max(row["exact"] for row in rows)
    return {
        name: float(np.mean([abs(row["computed"] - row["exact"]) for row in select(rows, viscosity=name)])) / largest
        for name in TERMS.values()
    }


def table(title: str, rows: list[dict[str, Any]]) -> Table:
    """All points of the profiles."""
    return Table(
        title,
        (
            Column("viscosity", "viscosity"),
            Column("x", "x", ".4f"),
            Column("y", "y", ".4f"),
            Column("computed", "computed", ".3f"),
            Column("exact", "exact", ".3f"),
        ),
        rows,
    )


def drawn(rows: list[dict[str, Any]], title: str) -> Figure:
    """A panel a term."""
    from sphear.results.figure import Profile, profiles

    y = np.linspace(0, 1, 101)
    panels = {}
    for name in TERMS.values():
        mine = select(rows, viscosity=name)
        panels[name] = Profile((y, 12 * (0.25 + y**2)), ([row["y"] for row in mine], [row["computed"] for row in mine]))
    return profiles(panels, "y", "Laplacian at x = 0.5", title)


@dataclass(frozen=True)
class ProfileFigure:
    """A figure of the profiles of all four terms.

    Attributes:
        number: of the figure.
        jitter: of the particles, in dx.
        digits: of the deviations that are said.
        claim: what the paper says of it.
        judged: says of the mean deviations by term whether they support that.
    """

    number: int
    jitter: float
    digits: str
    claim: str
    judged: Callable[[dict[str, float]], Agreement]

    def run(self, *, quick: bool, progress: Progress) -> StudyResult:
        """Profiles with 20 intervals a side."""
        rows = rows_along_line(self.jitter)
        off = deviations(rows)
        finding = f"with a jitter of {self.jitter} dx the" if self.jitter else "the"
        finding += f" mean deviations are {', '.join(f'{x:{self.digits}} for {name}' for name, x in off.items())}"
        finding += " of the largest exact value"
        where = f", jitter {self.jitter} dx" if self.jitter else " on a lattice"
        title = f"Laplacian along x = 0.5{where}, dx = 0.05 (Zheng, Ma & Shao 2018, figure {self.number})"
        figures = {f"figure-{self.number}": lambda: drawn(rows, title)}
        return StudyResult(self.claim, finding, self.judged(off), rows, [table(title, rows)], figures)


def _ranked(off: dict[str, float]) -> Agreement:
    """Judge the ranking: VISC-03 the nearest, VISC-01 and VISC-04 the furthest."""
    first, second, *_ = sorted(off, key=off.__getitem__)
    if first != "schwaiger":
        return "no"
    return "yes" if second == "gotoh" else "partly"


FIGURES = (
    ProfileFigure(
        2,
        0.0,
        ".2%",
        "all four terms agree very well with the exact Laplacian on uniform particles",
        lambda off: "yes" if max(off.values()) < 0.02 else "no",
    ),
    ProfileFigure(
        4,
        JITTER,
        ".1%",
        "on non-uniform particles VISC-03 is the most accurate, and VISC-01 and VISC-04 have the largest errors",
        _ranked,
    ),
)
STUDIES = {f"figure-{figure.number}": figure for figure in FIGURES}
