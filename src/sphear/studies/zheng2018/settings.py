"""The paper's own settings: which readings of them hold to t = 40 in the cavity at Re = 1000, and why others do not."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from sphear.results.table import Column, Table
from sphear.studies.result import Agreement, Progress, StudyResult
from sphear.studies.rows import Row, failed, outcome, select
from sphear.studies.zheng2018.cavities import UNTIL
from sphear.studies.zheng2018.cavity_shown import joined, listed
from sphear.studies.zheng2018.settings_combinations import BY_NAME, LONG_SIZES, READINGS, STATED
from sphear.studies.zheng2018.settings_figure import figure
from sphear.studies.zheng2018.settings_growth import predicted
from sphear.studies.zheng2018.settings_rows import Search, data_of
from sphear.studies.zheng2018.settings_runs import tried

KEPT = "settings"
CLAIM = (
    "with alpha = 0.01, a cubic spline, eq. 3 and a time step of 0.001 the cavity at Re = 1000 runs to t = 40 with 40"
    " to 200 particles a side"
)
COMPARED = (STATED, "differences", "sfdi", "least zero")  # readings whose growth is told
SIMILAR = 0.02  # lid speeds, of the mean deviation, that count as the same flow


def compute(*, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
    """All runs, in what is shown of them."""
    return data_of(Search(tried(quick)).compute(workers, progress))


def present(data: dict[str, Any]) -> StudyResult:
    """Numbers, figure and finding."""
    rows = [
        {
            **{key: value for key, value in row.items() if key not in ("profiles", "curve")},
            "why": BY_NAME[row["reading"]].why,
            "stated": BY_NAME[row["reading"]].stated,
            "predicted": predicted(row),
        }
        for row in data["runs"]
    ]
    said, agrees = finding(rows)
    return StudyResult(CLAIM, said, agrees, rows, [_table(rows), _readings()], {"settings": lambda: figure(data)})


def finding(rows: Sequence[Row]) -> tuple[str, Agreement]:
    """The ends of the readings in one sentence, and the verdict."""
    first = next((row for row in rows if row["reading"] == STATED), None)
    if first is None:
        return "not computed", "no"
    parts = [f"as stated it {_end(first)} with {first['resolution']} particles a side"]
    parts += [
        _screened(group) for size in dict.fromkeys(row["resolution"] for row in rows) if (group := _short(rows, size))
    ]
    long = [row for row in rows if row["until"] == UNTIL]
    parts += [_long(row) for row in long]
    if lacking := _lacking(long):
        parts.append(f"not computed to t = {UNTIL:g}: {lacking}" if long else f"none was computed to t = {UNTIL:g}")
    if grown := [row for row in rows if row["growth"] and row["reading"] in COMPARED and row["until"] < UNTIL]:
        parts.append("the disorder first grows " + ", ".join(_rate(row) for row in grown))
    good = {
        (row["reading"], row["resolution"])
        for row in long
        if not failed(row) and row.get("deviation") is not None and row["deviation"] < SIMILAR
    }
    whole = [r.name for r in READINGS if r.stated and all((r.name, size) in good for size in LONG_SIZES)]
    agrees: Agreement = "yes" if whole else "partly" if good else "no"
    return joined(*parts), agrees


def _rate(row: Row) -> str:
    bound = f" where eq. 3 allows {row['predicted']:.0f} under the least pressure" if row["predicted"] else ""
    return f"at {row['growth']:.0f} a unit of time ({row['reading']}, {row['resolution']} a side){bound}"


def _end(row: Row) -> str:
    return f"fails at t = {row['time']:.2g}" if failed(row) else f"holds to t = {row['time']:.3g}"


def _short(rows: Sequence[Row], size: int) -> list[Row]:
    return [row for row in select(rows, resolution=size) if row["until"] < UNTIL]


def _screened(rows: Sequence[Row]) -> str:
    """The number of readings of one size that held to the end of the short runs."""
    held = [row["reading"] for row in rows if not failed(row)]
    times = [row["time"] for row in rows if failed(row)]
    when = f", the others fail at t = {min(times):.2g} to {max(times):.2g}" if times else ""
    who = f": {listed(held)}" if held else ""
    until = f"t = {rows[0]['until']:g} at {rows[0]['resolution']} a side"
    return f"of {len(rows)} readings {len(held)} hold{'s' * (len(held) == 1)} to {until}{who}{when}"


def _long(row: Row) -> str:
    if failed(row):
        return f"{row['reading']} {_end(row)} at {row['resolution']}"
    score = row.get("deviation")
    off = f", mean deviation {score:.4f}, energy {row['kinetic_energy_error']:+.1%}" if score is not None else ""
    return f"{row['reading']} {_end(row)} at {row['resolution']} a side{off}"


def _lacking(long: Sequence[Row]) -> str:
    """The runs to the paper's time that are listed and not there."""
    there = {(row["reading"], row["resolution"]) for row in long}
    wanted = [each for each in tried() if each.until == UNTIL and each[:2] not in there]
    return ", ".join(f"{each.reading} ({each.resolution})" for each in wanted)


def _table(rows: Sequence[Row]) -> Table:
    lines = [
        {
            **row,
            "how": outcome(row),
            "as_stated": "yes" if row["stated"] else "no",
            "distance": None if failed(row) else row["smallest_distance"],
            "density": None if failed(row) else row["density_deviation"],
            "energy_error": None if failed(row) else row.get("kinetic_energy_error"),
        }
        for row in rows
    ]
    columns = (
        Column("reading", "reading"),
        Column("resolution", "particles a side", "d"),
        Column("as_stated", "within the text"),
        Column("how", "end"),
        Column("distance", "smallest distance / dx", ".3f"),
        Column("density", "rms density deviation", ".4f"),
        Column("growth", "growth of the disorder", ".3g"),
        Column("least_pressure", "least pressure then", ".2g"),
        Column("predicted", "growth by eq. 3 under it", ".3g"),
        Column("deviation", "mean deviation", ".4f"),
        Column("u_min_error", "error of min u", "+.4f"),
        Column("energy_error", "energy over the reference - 1", "+.1%"),
    )
    return Table("Readings of the paper's settings, cavity at Re = 1000", columns, lines)


def _readings() -> Table:
    lines = [
        {
            "reading": reading.name,
            "changes": ", ".join(f"{key}={value}" for key, value in reading.changes.items()) or "none",
            "as_stated": "yes" if reading.stated else "no",
            "why": reading.why,
        }
        for reading in READINGS
    ]
    columns = (
        Column("reading", "reading"),
        Column("changes", "what differs from the preset `zheng2018`"),
        Column("as_stated", "within the text"),
        Column("why", "why"),
    )
    return Table("What each reading changes", columns, lines)
