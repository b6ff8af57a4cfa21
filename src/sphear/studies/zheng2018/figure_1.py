"""Figure 1: the particles of the patch test."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.cases.lattice import lattice
from sphear.results.table import Column, Table
from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.zheng2018.patch import JITTER

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIZE = 20
CLAIM = "400 particles, on a uniform Cartesian lattice and displaced by (R - 1/2) dx"
READINGS = {"lattice": 0.0, f"jitter {JITTER} dx": JITTER, "jitter 1 dx, as printed": 1.0}


def run(*, quick: bool, progress: Progress) -> StudyResult:
    """The particles on a lattice, with the jitter that reproduces Table 2 and with the printed one."""
    places = {name: lattice(SIZE, 2, jitter=jitter).positions for name, jitter in READINGS.items()}
    rows = [_spread(name, jitter, places[name]) for name, jitter in READINGS.items()]
    finding = (
        f"the particles are drawn for the printed jitter, whose nearest pair is {rows[2]['nearest']:.2f} dx apart, and"
        f" for the {JITTER} dx that reproduces Table 2, where it is {rows[1]['nearest']:.2f} dx"
    )
    agrees: Agreement = "partly"
    table = Table(
        f"Figure 1 of Zheng, Ma & Shao 2018: {SIZE} intervals a side",
        (
            Column("particles_set", "particles"),
            Column("jitter", "jitter / dx", ".1f"),
            Column("nearest", "nearest pair / dx", ".3f"),
            Column("mean_nearest", "mean distance to the nearest / dx", ".3f"),
        ),
        rows,
    )
    return StudyResult(CLAIM, finding, agrees, rows, [table], {"figure-1": lambda: _figure(places)})


def _spread(name: str, jitter: float, positions: Any) -> dict[str, Any]:
    from scipy.spatial import cKDTree

    nearest = np.asarray(cKDTree(positions).query(positions, k=2)[0])[:, 1] * SIZE
    return {
        "particles_set": name,
        "particles": SIZE,
        "jitter": jitter,
        "nearest": float(nearest.min()),
        "mean_nearest": float(np.mean(nearest)),
    }


def _figure(places: dict[str, Any]) -> Figure:
    from sphear.results.figure import scatter_panels

    return scatter_panels(places, "Particles of the patch test (Zheng, Ma & Shao 2018, figure 1)")
