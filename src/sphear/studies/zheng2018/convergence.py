"""Figures 3 and 5: a table of errors as curves, the paper's reading of the error beside the L1-relative one."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from sphear.references.zheng2018 import TERMS

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def orders_in_particles(rows: list[dict[str, Any]], key: str) -> dict[str, float]:
    """k of Err ~ N^-k, N the number of particles, from the coarsest and the finest size: the paper's orders."""
    found = {}
    for name in TERMS.values():
        mine = sorted((row for row in rows if row["viscosity"] == name), key=lambda row: row["particles"])
        ratio = math.log(mine[0][key] / mine[-1][key])
        found[name] = ratio / math.log((mine[-1]["particles"] / mine[0]["particles"]) ** 2)
    return found


def figure(rows: list[dict[str, Any]], title: str, slopes: tuple[float, ...]) -> Figure:
    """Both readings of the error against the number of particles a side."""
    from sphear.results.figure import Convergence, convergence_panels

    def curve(name: str, key: str) -> tuple[list[float], list[float]]:
        mine = [row for row in rows if row["viscosity"] == name]
        return [row["particles"] for row in mine], [row[key] for row in mine]

    names = list(TERMS.values())
    panels = [
        Convergence(
            {name: curve(name, "computed") for name in names},
            "Err as in the paper: divided by M once more",
            published={name: curve(name, "published") for name in names},
        ),
        Convergence({name: curve(name, "l1_relative") for name in names}, "L1-relative error", slopes),
    ]
    return convergence_panels(panels, "particles a side", title)
