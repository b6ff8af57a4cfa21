"""The straight-line code of a formula of one particle's fields."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import count
from types import SimpleNamespace
from typing import Any

from sphear.engine.formula import Shape
from sphear.engine.stages import PointFormula
from sphear.engine.structure import fill, leaves, with_symbols
from sphear.engine.trace import Symbol, Trace


@dataclass(frozen=True)
class TracedPoint:
    """The code of a point formula.

    Attributes:
        parameter_count: numbers of the formula, the inputs p0, p1, ...
        reads: fields and components that it uses, (field, component), the inputs `field_component`.
        lines: assignments.
        writes: fields, components and the expressions of their new values.
    """

    parameter_count: int
    reads: tuple[tuple[str, int], ...]
    lines: tuple[str, ...]
    writes: tuple[tuple[str, int, str], ...]


def traced_point(formula: PointFormula, fields: tuple[Shape, ...]) -> TracedPoint:
    """Trace a formula.

    Args:
        formula: a frozen dataclass.
        fields: the names of the fields that there are, each with a structure of the form of its value.
    """
    trace, numbers = Trace(), count()
    with_inputs = with_symbols(formula, lambda: trace.input(f"p{next(numbers)}"))
    own = {name: fill(form, (trace.input(f"{name}_{k}") for k in count())) for name, form in fields}
    results = with_inputs.at(SimpleNamespace(**own))
    outputs = [(name, k, value) for name, result in results.items() for k, value in enumerate(leaves(result))]
    lines, inputs = trace.code([value for _, _, value in outputs])
    of_fields = [(name, k) for name, form in fields for k in range(len(list(leaves(form))))]
    direct = {value.name for _, _, value in outputs if isinstance(value, Symbol)}
    return TracedPoint(
        parameter_count=next(numbers),
        reads=tuple(read for read in of_fields if f"{read[0]}_{read[1]}" in inputs | direct),
        lines=tuple(lines),
        writes=tuple((name, k, _text(value)) for name, k, value in outputs),
    )


def _text(value: Any) -> str:
    return str(value) if isinstance(value, Symbol) else repr(float(value))
