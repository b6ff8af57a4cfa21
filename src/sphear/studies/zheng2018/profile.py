"""Figures 2 and 4: the Laplacian along the line x = 0.5, computed and exact."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.cases.lattice import lattice
from sphear.corrections import NoCorrection
from sphear.kernels import CubicSpline
from sphear.operators import Particles
from sphear.references.zheng2018 import TERMS
from sphear.results.table import Column, Table
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
        name: float(np.mean([abs(row["computed"] - row["exact"]) for row in rows if row["viscosity"] == name]))
        / largest
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


def figure(rows: list[dict[str, Any]], title: str) -> Figure:
    """A panel a term."""
    from sphear.results.figure import Profile, profiles

    y = np.linspace(0, 1, 101)
    panels = {}
    for name in TERMS.values():
        mine = [row for row in rows if row["viscosity"] == name]
        panels[name] = Profile((y, 12 * (0.25 + y**2)), ([row["y"] for row in mine], [row["computed"] for row in mine]))
    return profiles(panels, "y", "Laplacian at x = 0.5", title)
