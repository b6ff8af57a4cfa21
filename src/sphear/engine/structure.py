"""Formulas as structures: their float attributes become run-time parameters, everything else is part of the code."""

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


def kind(value: Any) -> Any:
    """The kind of a formula, which decides its code: class and attributes, but not the values of floats. Hashable."""
    if dataclasses.is_dataclass(value):
        return type(value), tuple("float" if is_float else kind(x) for _, is_float, x in _attributes(value))
    return tuple(kind(x) for x in value) if isinstance(value, tuple) else value


def parameters(formula: Any) -> list[float]:
    """The floats of a formula and of the formulas in it, depth first."""
    values: list[float] = []
    for _, is_float, value in _attributes(formula):
        if is_float:
            values.append(float(value))
        else:
            for part in value if isinstance(value, tuple) else (value,):
                values += parameters(part) if dataclasses.is_dataclass(part) else []
    return values


def with_symbols(formula: Any, symbol: Callable[[], Any]) -> Any:
    """The same formula with a new symbol in place of each float, in the order of `parameters`."""
    copy = object.__new__(type(formula))  # not through __init__, which checks values
    for name, is_float, value in _attributes(formula):
        if is_float:
            value = symbol()
        elif isinstance(value, tuple):
            value = tuple(with_symbols(part, symbol) if dataclasses.is_dataclass(part) else part for part in value)
        elif dataclasses.is_dataclass(value):
            value = with_symbols(value, symbol)
        object.__setattr__(copy, name, value)
    return copy


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
