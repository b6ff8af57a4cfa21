"""Figures 7 and 11: velocities and particles."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.references.cavity import mac
from sphear.results.table import Column, Table
from sphear.studies.basa2009.figure_8 import CENTRES, vortex_centre
from sphear.studies.result import Agreement, StudyResult
from sphear.studies.rows import Row, failed, outcome
from sphear.studies.zheng2018.cavities import DRAWN, REYNOLDS, UNTIL
from sphear.studies.zheng2018.cavity_rows import WATCHED
from sphear.studies.zheng2018.cavity_shown import (
    CYLINDER,
    NAMES,
    NOTHING,
    Data,
    field_of,
    joined,
    known_flow,
    main_rows,
    one,
    own_settings,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

STILL = 1e-3  # growth of the energy until the steady state, below which a flow counts as stable
BEFORE = 30.0  # when the energy is compared with that at the end


def vectors(data: Data, claim: str, number: int, *, sizes: tuple[int, ...]) -> StudyResult:
    """The particles' regularity over time, whether the flow is steady, and the vectors."""
    if data["until"] != UNTIL:
        sizes = tuple(data["sizes"])
    shown = {size: one(main_rows(data), DRAWN, size) for size in sizes}
    rows = [_line(data, row) for row in shown.values() if row is not None]
    said = [_said(data, size, row) for size, row in shown.items()]
    steady, stable = _steadiness(data)
    finding = joined(*said, steady, own_settings(data))
    good = [row is not None and not failed(row) for row in shown.values()]
    broken = any(row is not None and failed(row) for row in shown.values())
    verdict: Agreement = "no" if broken else "yes" if all(good) and stable else "partly"
    return StudyResult(
        claim, finding, verdict, rows, [_table(data, rows)], {f"figure-{number}": lambda: _figure(data, number, shown)}
    )


def _line(data: Data, row: Row) -> dict[str, Any]:
    """The worst of what was watched, and where the vortex is."""
    watched = {name: [x for x in row["watched"][name] if x is not None] for name in WATCHED}
    return {
        "resolution": row["resolution"], "particles": row["particles"], "time": row["time"], "end": row["end"],
        "smallest_distance": min(watched["smallest_distance"], default=None),
        "largest_gap": max(watched["largest_gap"], default=None),
        "density_deviation": max(watched["density_deviation"], default=None),
        "divergence": max(watched["divergence"], default=None),
        "iterations_mean": row.get("iterations_mean"),
        "energy_growth": _growth(row),
        **dict(zip(("vortex_x", "vortex_y"), _vortex(data, row), strict=True)),
    }  # fmt: skip


def _vortex(data: Data, row: Row) -> tuple[float | None, float | None]:
    """The centre of the primary vortex, from the sampled field."""
    field = field_of(row, data["case"])
    if field is None or data["case"] != "cavity" or data["until"] != UNTIL:
        return None, None
    places = np.stack(np.meshgrid(field.ticks, field.ticks), axis=-1).reshape(-1, 2)
    found = vortex_centre(places, np.stack((field.u.ravel(), field.v.ravel()), axis=1))
    return (None, None) if math.isnan(found[0]) else found


def _growth(row: Row) -> float | None:
    """The growth of the energy since t = 30, over that at the end; None of a run that ended before."""
    times, energies = (np.array(column, float) for column in zip(*row["energy"], strict=True))
    if failed(row) or times[-1] <= BEFORE:
        return None
    return float(1.0 - np.interp(BEFORE, times, energies) / energies[-1])


def _said(data: Data, size: int, row: Row | None) -> str:
    if row is None:
        return f"{size} particles a side: {NOTHING}"
    line = _line(data, row)
    parts = [
        f"particles stay at least {line['smallest_distance']:.2f} dx apart and leave no point further than"
        f" {line['largest_gap']:.2f} dx from one"
    ]
    if line["vortex_x"] is not None:
        x, y = CENTRES[REYNOLDS]
        off = math.hypot(line["vortex_x"] - x, line["vortex_y"] - y)
        parts.append(
            f"the vortex turns about ({line['vortex_x']:.3f}, {line['vortex_y']:.3f}), {off:.3f} from Ghia's steady"
            f" ({x:.3f}, {y:.3f})"
        )
    if line["energy_growth"] is not None:
        parts.append(f"the energy grew by {line['energy_growth']:.2%} since t = {BEFORE:g}")
    return f"{size} particles a side, {outcome(row)}: {', '.join(parts)}"


def _steadiness(data: Data) -> tuple[str, bool]:
    """True if the reference is steady at the end of the runs, and a sentence on it."""
    flow = known_flow(data)
    if flow is None or flow.energy is None:
        return "", False
    if data["case"] == "cavity":
        late = mac(REYNOLDS, 80).energy
        assert late is not None
        then, now = (float(late.at(time)) for time in (80.0, UNTIL))
        lacks = 1.0 - now / then
        return (
            f"the reference's energy is {lacks:.1%} below its value at t = 80, so it is {_word(lacks)}",
            lacks < STILL,
        )
    early, now = (float(flow.energy.at(time)) for time in (BEFORE, UNTIL))
    grown = 1.0 - early / now
    return f"the reference's energy grew by {grown:.2%} since t = {BEFORE:g}, so it is {_word(grown)}", grown < STILL


def _word(change: float) -> str:
    return "stable" if change < STILL else "not stable yet"


def _table(data: Data, rows: list[dict[str, Any]]) -> Table:
    columns = (
        Column("resolution", "particles a side", "d"),
        Column("particles", "particles", "d"),
        Column("time", "t", ".3g"),
        Column("end", "end"),
        Column("smallest_distance", "smallest distance / dx", ".2f"),
        Column("largest_gap", "largest gap / dx", ".2f"),
        Column("density_deviation", "density deviation", ".1e"),
        Column("divergence", "mean |div u|", ".1e"),
        Column("iterations_mean", "iterations", ".1f"),
        Column("energy_growth", "energy's growth", ".2%"),
        *((Column("vortex_x", "vortex x", ".3f"), Column("vortex_y", "vortex y", ".3f"))
          if data["case"] == "cavity" else ()),
    )  # fmt: skip
    return Table(f"Particles of {NAMES[data['case']]} with {DRAWN}: the worst over time", columns, rows)


def _figure(data: Data, number: int, shown: dict[int, Row | None]) -> Figure:
    from sphear.results.figure.fields import field_vectors

    panels = {}
    for size, row in shown.items():
        name = f"{size} particles a side" + ("" if row is None else f", t = {row['time']:.3g}")
        panels[name] = field_of(row, data["case"])
    title = f"{NAMES[data['case']].capitalize()}, {DRAWN} (Zheng, Ma & Shao 2018, figure {number})"
    return field_vectors(panels, title, CYLINDER if data["case"] == "cavity-cylinder" else None)
