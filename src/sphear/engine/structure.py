"""Formulas as structures: their float attributes become run-time parameters, everything else is part of the code.

Equal formulas in a formula, such as the kernel of all parts of a sum, are one: their numbers are parameters once, so
that the trace finds what is computed from them equal too.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator
from typing import Any

_FLOATS = ("float", float, "float | None", float | None)  # None is part of the code, a number is not


def _attributes(formula: Any) -> list[tuple[str, bool, Any]]:
    """(name, whether it is a run-time float, value) of each field of a frozen dataclass."""
    return [
        (field.name, field.type in _FLOATS and value is not None, value)
        for field in dataclasses.fields(formula)
        for value in (getattr(formula, field.name),)
    ]


def _formulas(value: Any) -> tuple[Any, ...]:
    """The formulas among the items of an attribute: it itself, or those of a tuple."""
    return tuple(part for part in (value if isinstance(value, tuple) else (value,)) if dataclasses.is_dataclass(part))


def kind(value: Any) -> Any:
    """The kind of a formula, which decides its code. Hashable.

    It is class and attributes, but not the values of floats; and which formulas in it are equal.
    """
    return _kind(value, {})


def _kind(value: Any, known: dict[Any, Any]) -> Any:
    if dataclasses.is_dataclass(value):
        if value in known:
            return "again", known[value]
        found = type(value), tuple("float" if is_float else _kind(x, known) for _, is_float, x in _attributes(value))
        known[value] = len(known)
        return found
    return tuple(_kind(x, known) for x in value) if isinstance(value, tuple) else value


def parameters(formula: Any) -> list[float]:
    """The floats of a formula and of the formulas in it, depth first; of equal ones once."""
    return _parameters(formula, set())


def _parameters(formula: Any, known: set[Any]) -> list[float]:
    values: list[float] = []
    for _, is_float, value in _attributes(formula):
        if is_float:
            values.append(float(value))
        else:
            for part in _formulas(value):
                values += [] if part in known else _parameters(part, known)
    known.add(formula)
    return values


def with_symbols(formula: Any, symbol: Callable[[], Any]) -> Any:
    """The same formula with a new symbol in place of each float, in the order of `parameters`."""
    return _with_symbols(formula, symbol, {})


def _with_symbols(value: Any, symbol: Callable[[], Any], known: dict[Any, Any]) -> Any:
    if isinstance(value, tuple):
        return tuple(_with_symbols(part, symbol, known) if dataclasses.is_dataclass(part) else part for part in value)
    if not dataclasses.is_dataclass(value):
        return value
    if value not in known:
        copy = object.__new__(type(value))  # not through __init__, which checks values
        for name, is_float, x in _attributes(value):
            object.__setattr__(copy, name, symbol() if is_float else _with_symbols(x, symbol, known))
        known[value] = copy
    return known[value]


def made_of(formula: Any) -> str:
    """The class and the attributes of a formula, such as Cleary(xi=2, eta=0.1)."""
    parts = (
        (name, made_of(value) if dataclasses.is_dataclass(value) else repr(float(value) if is_float else value))
        for name, is_float, value in _attributes(formula)
    )
    return f"{type(formula).__name__}({', '.join(f'{name}={part}' for name, part in parts)})"


def leaves(value: Any) -> Iterator[Any]:
    """The numbers of a nested tuple, depth first."""
    if isinstance(value, tuple):
        for item in value:
            yield from leaves(item)
    else:
        yield value


def fill(template: Any, values: Iterator[Any]) -> Any:
    """A structure like `template` (nested tuples and named tuples) with its numbers taken from `values`."""
    if not isinstance(template, tuple):
        return next(values)
    items = [fill(item, values) for item in template]
    return type(template)(*items) if hasattr(template, "_fields") else tuple(items)
