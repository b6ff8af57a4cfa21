"""Figure 9: kinetic energy in the lid-driven cavity against time."""

from __future__ import annotations

from itertools import pairwise, product
from typing import TYPE_CHECKING, Any

from sphear.references.cavity import MAC_TIMES, mac, openfoam
from sphear.results.table import Column, Table
from sphear.studies.basa2009.cavity_results import compute, corrections, reynolds_numbers
from sphear.studies.basa2009.models import LEVELS
from sphear.studies.result import Agreement, StudyResult
from sphear.studies.rows import Row, failed, outcome, select

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["compute", "present"]

CLAIM = (
    "all terms under-predict the kinetic energy at Re = 1000; D is the best by a small margin, C nearly as good; B"
    " fails at Re = 1000 when corrected; E shows spikes, above all uncorrected; A is stable with corrections only"
)


def present(data: dict[str, Any]) -> StudyResult:
    """The energies at the end beside the reference, and over time."""
    rows: list[Row] = data["runs"]
    said, agrees = _finding(rows)
    return StudyResult(CLAIM, said, agrees, rows, [_table(rows)], {"figure-9": lambda: _figure(rows)})


def _table(rows: list[Row]) -> Table:
    lines = [
        {
            "reynolds": row["reynolds"], "correction": LEVELS[row["correction"]], "viscosity": row["viscosity"],
            "end": outcome(row), "kinetic_energy": row["kinetic_energy"],
            "error": None if failed(row) else row.get("kinetic_energy_error"),
        }
        for row in rows
    ]  # fmt: skip
    columns = (
        Column("reynolds", "Re", "g"),
        Column("correction", "correction"),
        Column("viscosity", "term"),
        Column("end", "end"),
        Column("kinetic_energy", "kinetic energy", ".4g"),
        Column("error", "over the reference - 1", "+.1%"),
    )
    return Table("Kinetic energy in the cavity at the end of each run", columns, lines)


def _finding(rows: list[Row]) -> tuple[str, Agreement]:
    parts = []
    for reynolds in reynolds_numbers(rows):
        for correction in corrections(rows):
            mine = select(rows, reynolds=reynolds, correction=correction)
            if mine:
                each = (
                    f"{row['viscosity']} "
                    + (outcome(row) if failed(row) else f"{row.get('kinetic_energy_error', 0):+.1%}")
                    for row in mine
                )
                parts.append(f"Re = {reynolds:g}, {LEVELS[correction]}: {', '.join(each)}")
    held, agrees = judged(rows)
    said = [f"{statement}: {'yes' if holds else 'no'}" for statement, holds in held.items()]
    return "; ".join((*parts, *said)), agrees


def spike(row: Row) -> float:
    """The largest change of the energy from one output to the next, in the second half of a run."""
    energies = [energy for _, energy in row["energy"]]
    return max((abs(b - a) for a, b in pairwise(energies[len(energies) // 2 :])), default=0.0)


def judged(rows: list[Row]) -> tuple[dict[str, bool], Agreement]:
    """Verdicts on each part of the claim that the runs can tell, and on the claim as a whole."""
    finished = [row for row in select(rows, reynolds=1000.0) if not failed(row)]
    corrected = [row for row in rows if row["correction"] != "none"]
    closer, closest, spikes = [], [], []
    for correction in corrections(finished):
        mine = {row["viscosity"]: row for row in select(finished, correction=correction)}
        off = {term: abs(row["kinetic_energy_error"]) for term, row in mine.items()}
        if "cleary_4.24" in mine and len(mine) > 1:
            closer += [off["cleary_4.24"] <= off[term] for term in ("violeau", "morris") if term in off]
            closest.append(off["cleary_4.24"] == min(off.values()))
        if "morris" in mine and len(mine) > 1:
            spikes.append(max(mine, key=lambda term: spike(mine[term])) == "morris")
    broken = [failed(row) for row in select(corrected, viscosity="two_pass", reynolds=1000.0)]
    stable = [not failed(row) for row in select(corrected, viscosity="takeda")]
    parts = {
        "all under-predict at Re = 1000": [row["kinetic_energy_error"] < 0 for row in finished],
        "D is closer there than C and E": closer,
        "and than A": closest,
        "E has the largest spikes": spikes,
        "B fails there when corrected": broken,
        "A is stable when corrected": stable,
    }
    held = {statement: all(each) for statement, each in parts.items() if each}
    return held, "partly" if not finished or not all(held.values()) else "yes"


def under_predicted(rows: list[Row]) -> tuple[str, Agreement]:
    """The part of the claim about the energy, with the range of the errors."""
    errors = {
        f"{row['viscosity']}, {LEVELS[row['correction']]}": row["kinetic_energy_error"]
        for row in select(rows, reynolds=1000.0)
        if not failed(row)
    }
    if not errors:
        return "no run at Re = 1000 reached its time", "partly"
    least, most = min(errors, key=errors.__getitem__), max(errors, key=errors.__getitem__)
    lost = sum(failed(row) for row in select(rows, reynolds=1000.0))
    said = f"at t = 80 from {errors[least]:+.1%} ({least}) to {errors[most]:+.1%} ({most}); failed before: {lost}"
    return said, "yes" if errors[most] < 0 else "no"


def _figure(rows: list[Row]) -> Figure:
    from sphear.results.figure.history import HistoryPanel, history_panels

    panels = []
    for correction, reynolds in product(corrections(rows), reynolds_numbers(rows)):
        mine = select(rows, correction=correction, reynolds=reynolds)
        known = {}
        if reynolds in MAC_TIMES:
            for name, flow in (("staggered grid, extrapolated", mac(reynolds)), ("OpenFOAM", openfoam(reynolds))):
                assert flow.energy is not None
                known[name] = (flow.energy.stations, flow.energy.values)
        curves = {
            row["viscosity"]: ([t for t, _ in row["energy"]], [energy for _, energy in row["energy"]]) for row in mine
        }
        lacking = "" if mine else ": not computed"
        panels.append(HistoryPanel(f"Re = {reynolds:g}, {LEVELS[correction]}{lacking}", curves, known))
    title = "Lid-driven cavity, 50 x 50 particles (Basa, Quinlan & Lastiwka 2009, figure 9)"
    return history_panels(panels, "t", "kinetic energy", title, columns=max(1, len(reynolds_numbers(rows))))
