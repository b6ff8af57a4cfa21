"""Figure 1: the particles of the patch test."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.cases.lattice import lattice
from sphear.references.zheng2018 import TABLE_2
from sphear.results.table import Column, Table
from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.zheng2018.patch import JITTER, settings

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIZE = 20
CLAIM = "the errors of Table 2 are those of particles displaced from a uniform lattice by (R - 1/2) dx"
READINGS = {"lattice": 0.0, f"jitter {JITTER} dx": JITTER, "jitter 1 dx, as printed": 1.0}


def run(*, quick: bool, progress: Progress) -> StudyResult:
    """The particles on a lattice, with the jitter that reproduces Table 2 and with the printed one."""
    places = {name: lattice(SIZE, 2, jitter=jitter).positions for name, jitter in READINGS.items()}
    rows = [_spread(name, jitter, places[name]) for name, jitter in READINGS.items()]
    published = TABLE_2["schwaiger"][0]
    factors = {jitter: _error(jitter) / published for jitter in (JITTER, 1.0)}
    finding = (
        f"with the printed jitter of 1 dx, where the nearest pair is {rows[2]['nearest']:.2f} dx apart, the error of"
        f" VISC-03 is {factors[1.0]:.1f} times that of Table 2; with {JITTER} dx, where it is"
        f" {rows[1]['nearest']:.2f} dx, {factors[JITTER]:.2f} times"
    )
    printed, reduced = (abs(factors[jitter] - 1) < 0.2 for jitter in (1.0, JITTER))
    agrees: Agreement = "yes" if printed else "partly" if reduced else "no"
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


def _error(jitter: float) -> float:
    """Err of VISC-03 at this size, mean of 8 seeds."""
    (row,) = settings(viscosity=("schwaiger",), sizes=(SIZE,), jitter=jitter, seeds=8).rows()
    return float(row["paper"])


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
