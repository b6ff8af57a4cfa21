"""An interaction, traced: which fields of the particles it needs, and its straight-line code."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import count
from types import SimpleNamespace
from typing import Any, Protocol, runtime_checkable

from sphear.algebra import scale
from sphear.engine.structure import fill, kind, leaves, with_symbols
from sphear.engine.trace import Symbol, Trace


@runtime_checkable
class Interaction(Protocol):
    """A sum over the neighbours of each particle.

    `own` and `other` have the fields of the sweep as attributes: a number, or a tuple of them. `d` is the vector from
    other to own, `r2` its square. Both methods return a nested tuple of numbers.
    """

    def pair(self, own: Any, other: Any, d: tuple[Any, ...], r2: Any) -> tuple[Any, ...]:
        """The contribution of the pair to the sum of `own`; it must be zero from the support on, as kernels are."""

    def finish(self, own: Any, total: Any) -> tuple[Any, ...]:
        """The result for `own`, from the sum over its neighbours."""


Shape = tuple[str, Any]  # a field's name, and a structure of the form of its value (0.0 for a number)


@dataclass(frozen=True)
class TracedFormula:
    """The code of one interaction for one dimension and one set of fields.

    `columns` are the fields and components that a particle's record holds for its neighbours, (field, component), after
    the position; `private` are those that it alone needs, kept apart so that neighbours do not load them.
    `pair_outputs` are what is summed up, equal and opposite numbers once; of weights all.
    `reverse_outputs` are what the pair contributes to the sum of `other`, where both sides of it are wanted.
    `own_names` and `own_columns` are the used columns of what was prepared for the particle.
    """

    parameter_count: int
    columns: tuple[tuple[str, int], ...]
    private: tuple[tuple[str, int], ...]
    own_names: tuple[str, ...]
    own_columns: tuple[int, ...]
    pair_lines: tuple[str, ...]
    pair_outputs: tuple[str, ...]
    reverse_outputs: tuple[str, ...]
    finish_lines: tuple[str, ...]
    finish_outputs: tuple[str, ...]
    result: Any  # a structure of the form of the result


@cache
def _traced(
    key: Any,
    holder: _Unhashed,
    dimension: int,
    shared: tuple[Shape, ...],
    own_only: tuple[Shape, ...],
    both_sides: bool,
) -> TracedFormula:
    trace = Trace()
    numbers = count()
    formula = with_symbols(holder.value, lambda: trace.input(f"p{next(numbers)}"))

    def values(prefix: str, shapes: tuple[Shape, ...]) -> dict[str, Any]:
        return {
            name: fill(template, (trace.input(f"{prefix}_{name}_{k}") for k in count())) for name, template in shapes
        }

    d = tuple(trace.input(f"d{axis}") for axis in range(dimension))
    known = {"prepared": None, "dimension": dimension}
    own = SimpleNamespace(**(known | values("own", shared) | values("coefficient", own_only)))
    other = SimpleNamespace(**(known | values("other", shared)))
    r2 = trace.input("r2")
    total = formula.pair(own, other, d, r2)
    given = list(leaves(total))
    reverse_outputs = list(leaves(formula.pair(other, own, scale(-1.0, d), r2))) if both_sides else []
    kept = both_sides or isinstance(formula, Weights)
    pair_outputs = given if kept else _different(given)
    pair_lines, pair_inputs = trace.code(pair_outputs + reverse_outputs)

    totals = [trace.input(f"total{k}") for k in range(len(pair_outputs))]
    sums = fill(total, iter(totals) if kept else _totals(given, pair_outputs, totals))
    result = formula.finish(own, sums)
    finish_outputs = list(leaves(result))
    finish_lines, finish_inputs = trace.code(finish_outputs)

    used = pair_inputs | finish_inputs
    cells = [(name, k) for name, template in shared for k in range(len(list(leaves(template))))]
    of_other = _whole_runs(cells, [cell for cell in cells if f"other_{cell[0]}_{cell[1]}" in used])
    of_own = _whole_runs(
        cells, [cell for cell in cells if f"own_{cell[0]}_{cell[1]}" in used and cell not in of_other], of_other
    )
    own_names = [f"coefficient_{name}_{k}" for name, template in own_only for k in range(len(list(leaves(template))))]
    return TracedFormula(
        parameter_count=next(numbers),
        columns=tuple(of_other),
        private=tuple(of_own),
        own_names=tuple(name for name in own_names if name in used),
        own_columns=tuple(k for k, name in enumerate(own_names) if name in used),
        pair_lines=tuple(pair_lines),
        pair_outputs=tuple(_name(x) for x in pair_outputs),
        reverse_outputs=tuple(_name(x) for x in reverse_outputs),
        finish_lines=tuple(finish_lines),
        finish_outputs=tuple(_name(x) for x in finish_outputs),
        result=fill(result, iter([0.0] * len(finish_outputs))),
    )


def _whole_runs(
    cells: list[tuple[str, int]], used: list[tuple[str, int]], taken: Sequence[tuple[str, int]] = ()
) -> list[tuple[str, int]]:
    """The used components of each field and those between them, so that a field is packed by one copy."""
    bounds = {name: [k for n, k in used if n == name] for name, _ in used}
    return [(n, k) for n, k in cells if n in bounds and bounds[n][0] <= k <= bounds[n][-1] and (n, k) not in taken]


def _unsigned(value: Any) -> str:
    return value.name if isinstance(value, Symbol) else repr(abs(float(value)))


def _different(outputs: list[Any]) -> list[Any]:
    """Of equal and opposite outputs the first, and none that is always zero: what is to be summed up."""
    found: dict[str, Any] = {}
    for x in outputs:
        if isinstance(x, Symbol) or x != 0.0:
            found.setdefault(_unsigned(x), x)
    return list(found.values())


def _totals(outputs: list[Any], summed: list[Any], totals: list[Symbol]) -> Iterator[Any]:
    """The sum of each output, from the `totals` of those that are summed up."""
    place = {_unsigned(x): (_negative(x), total) for x, total in zip(summed, totals, strict=True)}
    for x in outputs:
        negative, total = place.get(_unsigned(x), (_negative(x), 0.0))
        yield total if negative == _negative(x) else -total


def _negative(value: Any) -> bool:
    return value.negative if isinstance(value, Symbol) else value < 0.0


class _Unhashed:
    """Carries a value past a cache's key: the key beside it says all about it that matters."""

    def __init__(self, value: Any) -> None:
        self.value = value

    def __hash__(self) -> int:
        return 0

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Unhashed)


def _name(value: Any) -> str:
    return str(value) if isinstance(value, Symbol) else repr(float(value))


def traced(
    interaction: Interaction,
    dimension: int,
    shared: tuple[Shape, ...],
    own_only: tuple[Shape, ...] = (),
    *,
    both_sides: bool = False,
) -> TracedFormula:
    """The traced code of an interaction; traced once for each kind of interaction, dimension and fields.

    Args:
        interaction: what is summed.
        dimension: 1, 2 or 3.
        shared: the fields that both particles of a pair have.
        own_only: the fields (coefficients prepared by an earlier sweep) of the particle summed for.
        both_sides: also what the pair contributes to its other particle; not with fields of one side only.
    """
    return _traced(kind(interaction), _Unhashed(interaction), dimension, shared, own_only, both_sides)


class Sum:
    """Mix-in for interactions whose result is the sum itself."""

    def finish(self, own: Any, total: Any) -> Any:
        """The sum, unchanged."""
        return total


class Weights(Sum):
    """Mix-in for interactions whose `pair` gives weights that are kept and not summed."""


__all__ = ["Interaction", "Shape", "Sum", "TracedFormula", "Weights", "traced"]
