"""Common parts of figures 7 to 14: the runs that there are, in words and in tables, and their references."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.references.cavity import CavityFlow, Curve
from sphear.references.zheng2018 import TERMS as LABELS
from sphear.results.table import Column, Table
from sphear.studies.result import Agreement
from sphear.studies.rows import Row, failed, outcome, select
from sphear.studies.zheng2018.cavities import DEFAULTS, OWN_SIZES, PAPER, REYNOLDS, SHIFTED
from sphear.studies.zheng2018.cavity_rows import reference

if TYPE_CHECKING:
    from sphear.results.figure.fields import Field

Array = np.ndarray[Any, Any]
Data = dict[str, Any]
NAMES = {"cavity": "the lid-driven cavity", "cavity-cylinder": "the cavity with a cylinder"}
FOUR = tuple(LABELS.values())
CYLINDER = (0.5, 0.5, 0.25)
NOTHING = "not computed"


def main_rows(data: Data) -> list[Row]:
    """The runs at Re = 1000 with the scheme's defaults."""
    return select(data["runs"], preset=DEFAULTS, reynolds=REYNOLDS)


def ended(rows: Sequence[Row]) -> list[Row]:
    """The runs that reached their time."""
    return [row for row in rows if not failed(row)]


def one(rows: Sequence[Row], viscosity: str, resolution: int) -> Row | None:
    """The run with a term and so many particles a side; None if there is none."""
    return next(iter(select(rows, viscosity=viscosity, resolution=resolution)), None)


def compared_size(data: Data) -> int | None:
    """The finest size at which all four terms of the paper were computed; without one, the finest with any."""
    rows = main_rows(data)
    whole = [size for size in data["sizes"] if all(one(rows, term, size) for term in FOUR)]
    return max(whole or [row["resolution"] for row in rows], default=None)


def lacking(data: Data) -> str:
    """The runs at Re = 1000 that were not computed, and those that failed; empty if none."""
    rows, said = main_rows(data), []
    absent = {size: [term for term in data["terms"] if one(rows, term, size) is None] for size in data["sizes"]}
    whole = [str(size) for size, terms in absent.items() if len(terms) == len(data["terms"])]
    if whole:
        said.append(f"{NOTHING}: {listed(whole)} particles a side")
    said += [
        f"{NOTHING} at {size}: {listed(terms)}" for size, terms in absent.items() if 0 < len(terms) < len(data["terms"])
    ]
    said += [
        f"failed: {row['viscosity']} at {row['resolution']} (t = {row['time']:.3g})" for row in rows if failed(row)
    ]
    return "; ".join(said)


def own_settings(data: Data) -> str:
    """The ends of runs with the paper's own settings, and with shifting added; empty if none was computed."""
    parts = []
    if rows := select(data["runs"], preset=PAPER):
        parts.append(f"with the paper's own settings{_sizes(rows)} {_failures(rows)}")
    if rows := select(data["runs"], preset=SHIFTED):
        scored = ", ".join(
            f"{row['deviation']:.4f} at {row['resolution']}" for row in ended(rows) if row.get("deviation") is not None
        )
        said = f"mean deviation {scored}" if scored else ""
        lost = _failures(rows) if any(failed(row) for row in rows) else ""
        parts.append(f"these with particle shifting, {rows[0]['viscosity']}: {joined(said, lost) or 'none failed'}")
    return joined(*parts)


def _sizes(rows: Sequence[Row]) -> str:
    return f" at {listed([str(size) for size in OWN_SIZES if select(rows, resolution=size)])} particles a side"


def _failures(rows: Sequence[Row]) -> str:
    """The number of runs that failed, and the times."""
    times = [row["time"] for row in rows if failed(row)]
    if not times:
        return f"none of {len(rows)} runs failed"
    when = f"at t = {min(times):.2g}" + (f" to {max(times):.2g}" if max(times) > min(times) else "")
    return f"{len(times)} of {len(rows)} runs failed, {when}"


def complete(data: Data) -> bool:
    """True if the paper's four terms reached their time at all sizes of the paper's figures."""
    rows = ended(main_rows(data))
    return data["until"] == 40.0 and all(one(rows, term, size) for term in FOUR for size in data["sizes"])


def capped(verdict: Agreement, data: Data) -> Agreement:
    """A verdict, partly confirmed at most where not all is known."""
    return "partly" if verdict == "yes" and not complete(data) else verdict


def listed(words: Sequence[str]) -> str:
    """Words in a row, the last after "and"."""
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def joined(*parts: str) -> str:
    """The parts of a sentence that are not empty."""
    return "; ".join(part for part in parts if part)


def known_flow(data: Data) -> CavityFlow | None:
    """The time-accurate flow when the runs end; None where it is not known."""
    return reference(data["case"], REYNOLDS, data["until"])


def paper_name(case: str) -> str:
    """The name of the reference of the paper's errors."""
    return "OpenFOAM" if case == "cavity-cylinder" else "Ghia"


def drawn(curve: Curve, *, smooth: bool = False) -> tuple[Array, Array]:
    """The points of a curve, or many more on the spline through them, with a gap that a line does not cross."""
    x = curve.stations
    y = curve.values
    if smooth:
        x = np.unique(np.concatenate([x + part * np.append(np.diff(x), 0.0) for part in np.arange(4) / 4]))
        y = curve.at(x)
    if curve.gap is None:
        return x, y
    place = int(np.searchsorted(x, 0.5 * (curve.gap[0] + curve.gap[1])))
    return np.insert(x, place, np.nan), np.insert(y, place, np.nan)


def field_of(row: Row | None, case: str) -> Field | None:
    """The field of a run; None where none is kept."""
    from sphear.results.figure.fields import Field

    if row is None or "field_u" not in row:
        return None
    side = round(len(row["field_u"]) ** 0.5)
    u, v = (np.array(row[name], float).reshape(side, side) for name in ("field_u", "field_v"))
    particles = None
    if "particles_x" in row:
        particles = np.stack((np.array(row["particles_x"], float), np.array(row["particles_y"], float)), axis=1)
    return Field(u, v, particles, CYLINDER if case == "cavity-cylinder" else None)


def score_table(data: Data) -> Table:
    """The end of each run, and its deviations from the references."""
    label = {name: paper for paper, name in LABELS.items()}
    lines = [
        {
            **row,
            "label": label.get(row["viscosity"]),
            "settings": {DEFAULTS: "defaults", PAPER: "the paper's"}.get(row["preset"], "with shifting"),
            "how": outcome(row),
            "kinetic_energy_error": None if failed(row) else row.get("kinetic_energy_error"),
        }
        for row in data["runs"]
    ]
    name = paper_name(data["case"])
    columns = (
        Column("reynolds", "Re", "g"),
        Column("resolution", "particles a side", "d"),
        Column("label", "paper"),
        Column("viscosity", "term"),
        Column("settings", "settings"),
        Column("how", "end"),
        Column("deviation", "mean deviation", ".4f"),
        Column("u_deviation_max", "largest of u", ".4f"),
        Column("v_deviation_max", "largest of v", ".4f"),
        Column("paper_deviation", f"mean deviation from {name}", ".4f"),
        Column("u_min", "min u", ".4f"),
        Column("u_min_error", "error of min u", "+.4f"),
        Column("paper_err", f"Err from {name}", ".4f"),
        Column("kinetic_energy_error", "energy over the reference - 1", "+.2%"),
        Column("seconds", "seconds", ".0f"),
    )
    return Table(f"Runs of {NAMES[data['case']]}: deviations at equal time, in lid speeds", columns, lines)
