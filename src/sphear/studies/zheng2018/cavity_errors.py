"""Figures 10 and 14: the error of the least u against the number of particles."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

from sphear.studies.result import Agreement, StudyResult
from sphear.studies.rows import select
from sphear.studies.zheng2018.cavities import DRAWN, REYNOLDS, UNTIL
from sphear.studies.zheng2018.cavity_magnitude import meshes
from sphear.studies.zheng2018.cavity_rows import least, papers_u_min, reference
from sphear.studies.zheng2018.cavity_shown import (
    FOUR,
    NAMES,
    NOTHING,
    Data,
    capped,
    ended,
    joined,
    lacking,
    listed,
    main_rows,
    own_settings,
    paper_name,
    score_table,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Series = dict[str, list[tuple[int, float]]]
MEASURES = {
    "u_min_error": "error of min u at equal time",
    "deviation": "mean deviation of both profiles",
    "kinetic_energy_error": "error of the energy over the energy",
}


def limit(case: str) -> float:
    """The limit of the paper's Err for a method that converges: that of the time-accurate flow."""
    flow = reference(case, REYNOLDS, UNTIL)
    assert flow is not None
    return abs(least(flow.u) - papers_u_min(case))


def series(data: Data, name: str) -> Series:
    """The magnitude of a number by term, against particles a side."""
    rows = ended(main_rows(data))
    found = {
        term: [(row["resolution"], abs(row[name])) for row in select(rows, viscosity=term) if row.get(name) is not None]
        for term in data["terms"]
    }
    return {term: sorted(points) for term, points in found.items() if points}


def errors(data: Data, claim: str, number: int) -> StudyResult:
    """Errors of the least u by term and size, and whether they fall."""
    said, verdict = _finding(data)
    figures = {f"figure-{number}": lambda: _figure(data, number)}
    return StudyResult(claim, said, capped(verdict, data), data["runs"], [score_table(data)], figures)


def falling(points: Sequence[tuple[int, float]]) -> bool:
    """True if errors fall from each size to the next."""
    return all(finer < coarser for (_, coarser), (_, finer) in pairwise(points))


def order(points: Sequence[tuple[int, float]]) -> float:
    """k of error ~ dx^k, from the coarsest and the finest."""
    (coarse, first), (fine, last) = points[0], points[-1]
    return math.log(first / last) / math.log(fine / coarse)


def leads(each: Series) -> tuple[int, int]:
    """At how many sizes the drawn term has the least error of the paper's four, and of how many that have all four."""
    by_term = {term: dict(points) for term, points in each.items() if term in FOUR}
    if len(by_term) < len(FOUR):
        return 0, 0
    sizes = set.intersection(*(set(points) for points in by_term.values()))
    return sum(min(FOUR, key=lambda term: by_term[term][size]) == DRAWN for size in sizes), len(sizes)


def judged(each: Series) -> tuple[str, list[bool]]:
    """A measure in words, and whether it falls for all terms and is least with the paper's favourite."""
    several = {term: points for term, points in each.items() if len(points) > 1}
    if not several:
        return "", []
    down = [term for term, points in several.items() if falling(points)]
    up = [term for term in several if term not in down]
    said = f"falls with every refinement for {listed(down)}" if down else "falls with every refinement for no term"
    said += f" and not for {listed(up)}" if up and down else ""
    orders = ", ".join(f"{term} {order(points):.1f}" for term, points in several.items() if points[-1][1] > 0)
    said += f" (orders in dx from the coarsest to the finest: {orders})"
    first, of = leads(each)
    said += f"; {DRAWN} has the least of the paper's four at {first} of {of} sizes" if of else ""
    return said, [not up, *([first == of] if of else [])]


def _finding(data: Data) -> tuple[str, Agreement]:
    names = ("u_min_error", "deviation") if data["until"] == UNTIL else ("kinetic_energy_error",)
    parts, verdicts = [], []
    for name in names:
        each = series(data, name)
        if not each:
            continue
        sizes = listed([str(size) for size in data["sizes"] if any(size in dict(points) for points in each.values())])
        digits = ".2%" if name == "kinetic_energy_error" else ".4f"
        listed_values = ", ".join(
            f"{term} {' '.join(f'{value:{digits}}' for _, value in points)}" for term, points in each.items()
        )
        parts.append(f"{MEASURES[name]}, {sizes} particles a side: {listed_values}")
        said, right = judged(each)
        parts.append(said and f"it {said}")
        verdicts.append(right)
    if not parts:
        return joined(NOTHING, own_settings(data)), "partly"
    if data["until"] == UNTIL:
        parts.append(_papers_err(data))
    parts += [own_settings(data), lacking(data)]
    if not any(verdicts):
        return joined(*parts), "partly"
    holds = [all(right) for right in verdicts if right]
    some = any(value for right in verdicts for value in right)
    verdict: Agreement = "yes" if all(holds) else "partly" if some else "no"
    return joined(*parts), verdict


def _papers_err(data: Data) -> str:
    """The paper's own Err, and what it tends to."""
    each, case = series(data, "paper_err"), data["case"]
    finest = ", ".join(f"{term} {points[-1][1]:.4f} ({points[-1][0]})" for term, points in each.items())
    known = papers_u_min(case)
    return (
        f"the paper's Err from {paper_name(case)}'s min u of {known:.4f}, which tends to {limit(case):.4f} and not to 0"
        f" when a method converges, is at the finest size {finest}"
    )


def _figure(data: Data, number: int) -> Figure:
    from sphear.results.figure import Convergence, convergence_panels

    def curves(name: str) -> dict[str, tuple[list[int], list[float]]]:
        return {term: ([n for n, _ in points], [y for _, y in points]) for term, points in series(data, name).items()}

    title = f"{NAMES[data['case']].capitalize()} (Zheng, Ma & Shao 2018, figure {number})"
    if data["until"] != UNTIL:
        panel = Convergence(
            curves("kinetic_energy_error"), f"{MEASURES['kinetic_energy_error']}, t = {data['until']:g}"
        )
        return convergence_panels([panel], "particles a side", title)
    flow = reference(data["case"], REYNOLDS, UNTIL)
    assert flow is not None
    raw, *_ = meshes(data).values()
    mesh = abs(least(raw["u"]) - least(flow.u))
    limits = {f"limit of a converging method, {limit(data['case']):.4f}": limit(data["case"])}
    panels = [
        Convergence(curves("paper_err"), f"Err of the paper, from {paper_name(data['case'])}", levels=limits),
        Convergence(
            curves("u_min_error"), MEASURES["u_min_error"], levels={f"OpenFOAM's finest mesh, {mesh:.4f}": mesh}
        ),
        Convergence(curves("deviation"), MEASURES["deviation"]),
    ]
    return convergence_panels(panels, "particles a side", title)
