"""Figures 9 and 13: centreline velocities of each viscous term."""

from __future__ import annotations

from itertools import combinations
from statistics import fmean
from typing import TYPE_CHECKING

import numpy as np

from sphear.references.cavity import botella_peyret, ghia
from sphear.studies.result import Agreement, StudyResult
from sphear.studies.rows import Row, select
from sphear.studies.zheng2018.cavities import DEFAULTS, DRAWN, REYNOLDS, SLOW_REYNOLDS, UNTIL
from sphear.studies.zheng2018.cavity_magnitude import LINES, meshes
from sphear.studies.zheng2018.cavity_rows import curves
from sphear.studies.zheng2018.cavity_shown import (
    FOUR,
    NAMES,
    NOTHING,
    Data,
    capped,
    compared_size,
    drawn,
    ended,
    joined,
    known_flow,
    lacking,
    main_rows,
    one,
    own_settings,
    paper_name,
    score_table,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from sphear.results.figure.fields import ProfilePanel

LINES_OF = ("u", "v")
CLOSE = 1.05  # times the least deviation: no worse than that, within what other settings change


def profiles(data: Data, claim: str, number: int) -> StudyResult:
    """Deviations of the profiles, by term, and the profiles at the finest size."""
    said, verdict = _finding(data)
    figures = {f"figure-{number}": lambda: _figure(data, number)}
    return StudyResult(claim, said, capped(verdict, data), data["runs"], [score_table(data)], figures)


def compared(data: Data) -> list[Row]:
    """The runs of the finest size that all terms have, the paper's terms first."""
    size = compared_size(data)
    return [] if size is None else select(ended(main_rows(data)), resolution=size)


def measure(data: Data) -> tuple[str, str]:
    """By which number terms are compared, and its name."""
    if known_flow(data) is None:
        return "kinetic_energy_error", "energies over the reference - 1"
    return "deviation", "mean deviations of both profiles from the time-accurate reference"


def values(rows: list[Row], name: str, digits: str) -> str:
    """A number of each run, in words."""
    return ", ".join(f"{row['viscosity']} {row[name]:{digits}}" for row in rows if row.get(name) is not None)


def _finding(data: Data) -> tuple[str, Agreement]:
    rows = compared(data)
    name, label = measure(data)
    mine = [row for row in rows if row.get(name) is not None]
    if not mine:
        return joined(NOTHING, own_settings(data)), "partly"
    by_term = {row["viscosity"]: abs(row[name]) for row in mine}
    four = {term: by_term[term] for term in FOUR if term in by_term}
    digits = "+.2%" if name == "kinetic_energy_error" else ".4f"
    where = (
        f"{mine[0]['resolution']} particles a side, t = {mine[0]['time']:.3g}, {label}: {values(mine, name, digits)}"
    )
    best = min(four, key=four.__getitem__) if four else None
    parts = [where]
    if best is not None and len(four) > 1:
        parts.append(f"of the paper's four {best} is the nearest and {max(four, key=four.__getitem__)} the furthest")
    if paper := values(mine, "paper_deviation", ".4f"):
        parts.append(f"from {paper_name(data['case'])}: {paper}")
    if len(rows) > 1:
        parts.append(f"any two of the terms differ by at most {_spread(data, rows):.4f} in the mean")
    if energies := values(mine, "kinetic_energy_error", "+.2%") if name == "deviation" else "":
        parts.append(f"energies over the reference - 1: {energies}")
    parts += [_slow(data), own_settings(data), lacking(data)]
    verdict: Agreement = "partly"
    if DRAWN in four and all(one(main_rows(data), term, mine[0]["resolution"]) for term in FOUR):
        verdict = "yes" if best == DRAWN else "partly" if four[DRAWN] <= CLOSE * min(four.values()) else "no"
    return joined(*parts), verdict


def _spread(data: Data, rows: list[Row]) -> float:
    """The largest mean difference of two terms' profiles."""
    found = [curves(data["case"], row) for row in rows if row["profiles"]]
    pairs = [(a, b) for a, b in combinations(found, 2) if all(a[k].values.size == b[k].values.size for k in LINES_OF)]
    off = [fmean(float(np.abs(a[k].values - b[k].values).mean()) for k in LINES_OF) for a, b in pairs]
    return max(off, default=0.0)


def _slow(data: Data) -> str:
    """The deviations at Re = 100."""
    rows = ended(select(data["runs"], preset=DEFAULTS, reynolds=SLOW_REYNOLDS))
    if not values(rows, "deviation", ".4f"):
        return ""
    first = rows[0]
    where = f"Re = {SLOW_REYNOLDS:g}, {first['resolution']} particles a side, t = {first['time']:.3g}"
    return f"{where}: {values(rows, 'deviation', '.4f')}"


def _figure(data: Data, number: int) -> Figure:
    from sphear.results.figure.fields import ProfilePanel, inset_profiles

    rows, cylinder = compared(data), data["case"] == "cavity-cylinder"
    flow = known_flow(data)
    panels: list[ProfilePanel] = []
    for name, axis, label in LINES:
        own = {row["viscosity"]: drawn(curves(data["case"], row)[name], smooth=True) for row in rows if row["profiles"]}
        references, tables = {}, {}
        if flow is not None:
            references = {which: drawn(known[name]) for which, known in meshes(data).items()}
            if not cylinder:
                references["staggered grid, extrapolated"] = drawn(getattr(flow, name))
                tables = {
                    "Ghia, Ghia & Shin (steady)": drawn(getattr(ghia(REYNOLDS), name)),
                    "Botella & Peyret (steady)": drawn(getattr(botella_peyret(), name)),
                }
        windows = _windows(name, cylinder) if data["until"] == UNTIL and own else ()
        panels.append(ProfilePanel(label, (axis, name), own, references, tables, windows))
    size = f", {rows[0]['resolution']} particles a side, t = {rows[0]['time']:.3g}" if rows else ""
    title = f"{NAMES[data['case']].capitalize()}{size} (Zheng, Ma & Shao 2018, figure {number})"
    return inset_profiles(panels, title)


Place = tuple[float, float, float, float]


def _windows(name: str, cylinder: bool) -> tuple[tuple[tuple[float, float], Place], ...]:
    """The parts that are enlarged, around the extremes, and the places with room for that."""
    if cylinder and name == "u":
        return (((0.06, 0.2), (0.34, 0.42, 0.36, 0.5)),)
    if cylinder:
        return ((0.05, 0.19), (0.37, 0.58, 0.31, 0.36)), ((0.84, 0.97), (0.37, 0.1, 0.31, 0.36))
    if name == "u":
        return (((0.1, 0.23), (0.08, 0.56, 0.36, 0.4)),)
    return ((0.09, 0.23), (0.56, 0.6, 0.34, 0.36)), ((0.85, 0.96), (0.09, 0.07, 0.36, 0.38))
