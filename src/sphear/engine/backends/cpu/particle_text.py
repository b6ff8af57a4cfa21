"""Text that computes values of a particle from its fields: columns of records, and formulas of a particle."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from sphear.engine.backends.cpu.written import WrittenStage
from sphear.engine.formula import Shape
from sphear.engine.point_formula import TracedPoint
from sphear.engine.stages import Rows

# the first row of each kind and the one after the last
RANGES = {
    Rows.FLUID: ("0", "count"),
    Rows.WALLS: ("count", "total"),
    Rows.PARTICLES: ("0", "total"),
    Rows.ENTRIES: ("0", "listed"),
}
ELEMENTARY = "from sphear.engine.lanes import exp, positive_part, sqrt, where_less"


@dataclass(frozen=True)
class Field:
    """An array that has a row for each particle, or one for all.

    Attributes:
        components: of a vector; 0 for a number.
        rows: the name of the size that says how many rows there are; "" for one row that is everyone's.
    """

    components: int
    rows: str = "PARTICLES"

    @property
    def form(self) -> Any:
        """A structure of the form of a particle's value."""
        return (0.0,) * self.components if self.components else 0.0


Fields = Mapping[str, Field]


def forms(fields: Fields) -> tuple[Shape, ...]:
    """The names and forms of the fields."""
    return tuple((name, field.form) for name, field in fields.items())


def element(stage: WrittenStage, fields: Fields, name: str, component: int, index: str) -> str:
    """The text of one number of a field; its array is made known."""
    field = fields[name]
    rows: int | str = field.rows or 1
    index = index if field.rows else "0"
    if field.components:
        return f"{stage.view(name, name, 'float_table', rows, field.components)}[{index}, {component}]"
    return f"{stage.view(name, name, 'floats', rows)}[{index}]"


def parameters_text(stage: WrittenStage, count: int, array: str) -> None:
    """Make the numbers p0, p1, ... of a formula known."""
    if count:
        stage.view("parameters", array, "floats", count)
        stage.body += [f"p{k} = parameters[{k}]" for k in range(count)]


def reads_text(
    stage: WrittenStage, traced: TracedPoint, fields: Fields, index: str, elsewhere: Mapping[str, str]
) -> list[str]:
    """Lines that read what a formula uses.

    Args:
        stage: that is written.
        traced: the formula.
        fields: that there are.
        index: of the particle.
        elsewhere: fields that are read at another particle, and its index.
    """
    return [f"{name}_{k} = {element(stage, fields, name, k, elsewhere.get(name, index))}" for name, k in traced.reads]
