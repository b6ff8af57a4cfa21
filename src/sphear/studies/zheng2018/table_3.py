"""Table 3: the time that the four viscous terms take."""

from __future__ import annotations

import time
from typing import Any

import numpy as np

from sphear.cases.lattice import lattice
from sphear.corrections import NoCorrection
from sphear.kernels import CubicSpline
from sphear.operators import Particles
from sphear.references.zheng2018 import SIZES, TABLE_3, TERMS
from sphear.results.table import Column, Table
from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.zheng2018.patch import JITTER, last
from sphear.viscosity import VISCOSITY

CLAIM = "VISC-02 is the fastest, VISC-01 takes a little longer, VISC-04 and VISC-03 about 2.4 and 2.8 times as long"


def timed(size: int, repetitions: int) -> dict[str, float]:
    """The best time of each term's Laplacian on one thread, in seconds; neighbours are known beforehand.

    The terms take turns, so that a change of the machine's speed meets them all.
    """
    grid = lattice(size, 2, layers=3, jitter=JITTER)
    particles = Particles.read(grid.positions, kernel=CubicSpline(grid.spacing), volumes=grid.volume, threads=1)
    values = (grid.positions**4).sum(axis=1)[:, None]
    best = dict.fromkeys(TERMS.values(), np.inf)
    for repetition in range(repetitions + 1):  # the first one compiles
        for name in best:
            began = time.perf_counter()
            particles.laplacian(values, VISCOSITY[name], NoCorrection(), "nan")
            if repetition:
                best[name] = min(best[name], time.perf_counter() - began)
    return best


def rows_of_times(quick: bool, progress: Progress) -> list[dict[str, Any]]:
    """Published and computed times, and both as multiples of VISC-02 at the same size."""
    rows = []
    for k, size in enumerate(SIZES):
        progress(f"{size} particles a side")
        seconds = timed(size, 20 if quick else 100)
        for name in TERMS.values():
            rows.append(
                {
                    "particles": size,
                    "viscosity": name,
                    "published": TABLE_3[name][k],
                    "computed": seconds[name],
                    "published_relative": TABLE_3[name][k] / TABLE_3["gotoh"][k],
                    "computed_relative": seconds[name] / seconds["gotoh"],
                }
            )
    return sorted(rows, key=lambda row: list(TERMS.values()).index(row["viscosity"]))


def run(*, quick: bool, progress: Progress) -> StudyResult:
    """Table 3 as measured here."""
    rows = rows_of_times(quick, progress)
    relative = {name: last(rows, name, "computed_relative") for name in TERMS.values()}
    heaviest, fastest = max(relative, key=relative.__getitem__), min(relative, key=relative.__getitem__)
    finding = (
        f"at {SIZES[-1]} x {SIZES[-1]} particles the times are as {relative['morris']:.2f} : 1 :"
        f" {relative['schwaiger']:.2f} : {relative['oger']:.2f} (published 1.23 : 1 : 2.76 : 2.38), {fastest} is the"
        f" fastest and {heaviest} the slowest, and VISC-01 takes {last(rows, 'morris', 'computed') * 1e3:.2f} ms, some"
        f" {last(rows, 'morris', 'published') / last(rows, 'morris', 'computed'):.0f} times less than published"
    )
    order_of_two = max(relative["morris"], relative["gotoh"]) < min(relative["schwaiger"], relative["oger"])
    agrees: Agreement = "yes" if order_of_two and fastest == "gotoh" else "partly" if order_of_two else "no"
    table = Table(
        "Table 3 of Zheng, Ma & Shao 2018: seconds for one Laplacian, one thread",
        (
            Column("viscosity", "viscosity"),
            Column("particles", "particles a side", "d"),
            Column("published", "published s", ".3f"),
            Column("computed", "computed s", ".2e"),
            Column("published_relative", "published / VISC-02", ".2f"),
            Column("computed_relative", "computed / VISC-02", ".2f"),
        ),
        rows,
    )
    return StudyResult(CLAIM, finding, agrees, rows, [table])
