"""The stage that packs records of all entries and sums an interaction over the pairs of rows."""

from __future__ import annotations

from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

from sphear.boundaries.box import ON_WALL
from sphear.engine.backends.cpu.particle_text import ELEMENTARY, RANGES, Fields, forms, reads_text
from sphear.engine.backends.cpu.written import WrittenStage
from sphear.engine.cache import generated_module
from sphear.engine.formula import Interaction, Shape, TracedFormula, traced
from sphear.engine.point_formula import traced_point
from sphear.engine.program import sweep_text
from sphear.engine.stages import AtImages, Column, Columns, Rows
from sphear.engine.sweep import FAR


@dataclass(frozen=True)
class Sum:
    """A sum as the backend knows it.

    Attributes:
        interaction: summed.
        rows: that it is summed for.
        columns: that it may use.
        result: the name of the array of its result.
        by_row: whether the result is kept by the rows of the list, instead of by entries.
        before: the name of the result before it, and its width.
        prepared: the name of the array of what is prepared, and its width.
        own: the form of that.
    """

    interaction: Interaction
    rows: Rows
    columns: Columns
    result: str
    by_row: bool = False
    before: tuple[str, int] = ("", 0)
    prepared: tuple[str, int] = ("", 0)
    own: tuple[Shape, ...] = ()

    def traced(self, fields: Fields, dimension: int) -> TracedFormula:
        """The formula of a pair."""
        shared = tuple((name, _form(column, fields)) for name, column in self.columns)
        if self.before[0]:
            shared = (*shared, ("before", (0.0,) * self.before[1]))
        return traced(self.interaction, dimension, shared, self.own)


def _form(column: Column, fields: Fields) -> Any:
    """The form of a column's value: that of numbers in place of the fields."""
    own = SimpleNamespace(**{name: _ones(form) for name, form in forms(fields)})
    value = column.value(own)
    return (0.0,) * len(value) if isinstance(value, tuple) else 0.0


def _ones(form: Any) -> Any:
    return (1.0,) * len(form) if isinstance(form, tuple) else 1.0


@dataclass(frozen=True)
class _Needed:
    """The columns that a formula needs, as a formula of a particle."""

    columns: Columns

    def at(self, own: Any) -> dict[str, Any]:
        return {name: column.value(own) for name, column in self.columns}


def pair_sum(
    of: Sum, fields: Fields, dimension: int, continued: bool, parameters: str
) -> tuple[WrittenStage, dict[str, int]]:
    """Write the stage of a sum; also the arrays between stages that it needs, a row for each entry, and their widths.

    Args:
        of: the sum.
        fields: that there are.
        dimension: 2 or 3.
        continued: whether images have velocities of their own.
        parameters: the name of the array of its numbers.
    """
    formula = of.traced(fields, dimension)
    title = type(of.interaction).__name__
    module = generated_module(sweep_text(formula, title, dimension, "float64"))
    stage = WrittenStage(f"the sum {title}")
    stage.imports = ["import numpy as np", ELEMENTARY, f"from {module.__name__} import sweep"]
    width = -(-(dimension + len(formula.columns)) // 4) * 4  # whole vectors of four
    results = len(formula.finish_outputs)
    stage.view("radius", "support", "floats", 1)
    stage.view("parameters", parameters, "floats", max(1, formula.parameter_count))
    stage.view("records", "records", "float_table", "ENTRIES", width)
    stage.view("private", "private", "float_table", "ENTRIES", len(formula.private))
    stage.view("positions", "positions", "float_table", "ENTRIES", dimension)
    for name in ("order", "source"):
        stage.view(name, name, "short_integers", "ENTRIES")
    stage.view("wall", "wall", "octets", "ENTRIES")
    for name in ("entry", "target"):
        stage.view(name, name, "short_integers", "LISTED")
    if of.by_row:
        stage.view("to", "numbers", "short_integers", "LISTED")
    stage.view("bounds", "bounds", "integers", "PARTS + 1")
    stage.view("first", "first", "integer_table", "PARTS", "SHARE")
    stage.view("neighbour", "neighbour", "short_integer_table", "PARTS", "PAIR_ROOM")
    stage.view("own", of.prepared[0] or "private", "float_table", "LISTED" if of.prepared[0] else 0, of.prepared[1])
    rows = "LISTED" if of.by_row else "ENTRIES"
    stage.view("out", of.result, "float_table", rows, results)
    sizes = {"count": "FLUID", "total": "PARTICLES", "entries": "ENTRIES", "listed": "LISTED", "parts": "PARTS"}
    for name, size in sizes.items():
        stage.size(name, size)
    low, high = RANGES[of.rows]
    stage.body = [
        "for part in prange(parts):",
        "    for s in range(entries * part // parts, entries * (part + 1) // parts):",
        "        e = order[s]",
        "        i = source[e]",
        *(f"        {line}" for line in _packing(stage, of, formula, fields, dimension, continued)),
        "for part in prange(parts):",
        "    origin = bounds[part]",
        f"    begin, end = max({low}, origin), min({high}, bounds[part + 1])",
        "    if begin < end:",
        f"        sweep(parameters, {FAR!r} * radius[0], records, private, own[origin:], out,",
        f"              {'to' if of.by_row else 'target'}[origin:], entry, first[part], neighbour[part], begin, end,",
        "              origin)",
    ]
    return stage, {"records": width, "private": len(formula.private), of.result: results}


def _packing(
    stage: WrittenStage, of: Sum, formula: TracedFormula, fields: Fields, dimension: int, continued: bool
) -> list[str]:
    """Lines that write the record of entry e, an image of particle i, at its place s."""
    columns = dict(of.columns)
    cells = (*formula.columns, *formula.private)
    of_images = [name for name, column in columns.items() if continued and column.at_images is AtImages.CONTINUED]
    values = {(name, k): f"image_velocity[e, {k}]" for name in of_images for k in range(dimension)}
    values |= {("before", k): f"before[e, {k}]" for k in range(of.before[1])}
    names = dict.fromkeys(name for name, _ in cells)
    if any(name in names for name in of_images):
        stage.view("image_velocity", "image_velocity", "float_table", "ENTRIES", dimension)
    if "before" in names:
        stage.view("before", of.before[0], "float_table", "ENTRIES", of.before[1])
    needed = _Needed(tuple((name, columns[name]) for name in names if name != "before" and name not in of_images))
    point = traced_point(needed, forms(fields))
    values |= {(name, k): _at_image(columns[name].at_images, value, k) for name, k, value in point.writes}
    lines = [*reads_text(stage, point, fields, "i", {}), *point.lines]
    lines += [f"records[s, {axis}] = positions[e, {axis}]" for axis in range(dimension)]
    lines += [f"records[s, {dimension + c}] = {values[cell]}" for c, cell in enumerate(formula.columns)]
    lines += [f"private[s, {c}] = {values[cell]}" for c, cell in enumerate(formula.private)]
    return lines


def _at_image(rule: AtImages, value: str, component: int) -> str:
    """The value of an image's column."""
    mirrored = f"(-1.0 if (wall[e] >> {2 * component}) & 3 else 1.0)"
    on_wall = f"wall[e] & {ON_WALL}"
    return {
        AtImages.SAME: value,
        AtImages.CONTINUED: value,
        AtImages.REFLECTED: f"({value}) * {mirrored}",
        AtImages.STANDING: f"(0.0 if {on_wall} else ({value}) * {mirrored})",
        AtImages.ABSENT: f"(0.0 if {on_wall} else {value})",
    }[rule]
