"""Writes a formula down as straight-line code by calling it with symbols in place of numbers.

A `Symbol` records each operation made on it in its `Trace`. Equal operations are recorded once, operations on plain
numbers are done at once, and what the outputs do not need is left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

Operand = "Symbol | float"


class Symbol:
    """A number that is known only at run time: an input, or the result of a recorded operation."""

    __slots__ = ("name", "trace")

    def __init__(self, trace: Trace, name: str) -> None:
        self.trace = trace
        self.name = name

    def traced_call(self, function: str, arguments: Sequence[Any]) -> Symbol:
        """The symbol of function(*arguments); `sphear.algebra` calls this."""
        return self.trace.record(function, arguments)

    def __add__(self, other: Any) -> Any:
        return self if _is(other, 0) else self.trace.record("+", (self, other))

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        return self if _is(other, 0) else self.trace.record("-", (self, other))

    def __rsub__(self, other: Any) -> Any:
        return self.trace.record("-", (other, self))

    def __mul__(self, other: Any) -> Any:
        if _is(other, 0):
            return 0.0
        return self if _is(other, 1) else self.trace.record("*", (self, other))

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Any:
        if isinstance(other, Symbol):
            return self.trace.record("/", (self, other))
        return self * (1.0 / other)

    def __rtruediv__(self, other: Any) -> Any:
        return 0.0 if _is(other, 0) else self.trace.record("/", (other, self))

    def __neg__(self) -> Any:
        return self.trace.record("-", (0.0, self))

    def __pow__(self, power: int) -> Any:
        if not isinstance(power, int):
            raise TypeError("a formula may raise to whole powers only")
        if power < 0:
            return 1.0 / self**-power
        if power == 0:
            return 1.0
        half = self ** (power // 2)  # by squaring; equal factors are recorded once
        return half * half * self if power % 2 else half * half

    def __bool__(self) -> bool:
        raise TypeError("a formula may not branch on a value: use where_less or positive_part")

    def __eq__(self, other: object) -> bool:
        return bool(self)

    __lt__ = __gt__ = __le__ = __ge__ = __eq__
    __hash__ = object.__hash__


def _is(value: Any, number: int) -> bool:
    return not isinstance(value, Symbol) and value == number


class Trace:
    """The recorded operations of one formula, in order."""

    def __init__(self) -> None:
        self._operations: dict[tuple[str, ...], Symbol] = {}
        self._definitions: dict[str, tuple[str, ...]] = {}

    def input(self, name: str) -> Symbol:
        """A new symbol that the surrounding code defines."""
        return Symbol(self, name)

    def record(self, operation: str, operands: Iterable[Any]) -> Symbol:
        """The symbol of an operation, the same one for the same operation on the same operands."""
        names = [x.name if isinstance(x, Symbol) else repr(float(x)) for x in operands]
        if operation in "+*":
            names.sort()
        key = (operation, *names)
        if key not in self._operations:
            name = f"t{len(self._operations)}"
            self._operations[key] = Symbol(self, name)
            self._definitions[name] = key
        return self._operations[key]

    def code(self, outputs: Iterable[Any]) -> tuple[list[str], set[str]]:
        """Assignments that compute the outputs, in order, and the names of the inputs they use."""
        needed: set[str] = set()
        pending = [x.name for x in outputs if isinstance(x, Symbol)]
        while pending:
            name = pending.pop()
            if name not in needed:
                needed.add(name)
                pending += [x for x in self._definitions.get(name, ())[1:] if not _number(x)]
        lines = [f"{name} = {_text(key)}" for name, key in self._definitions.items() if name in needed]
        return lines, needed - self._definitions.keys()


def _number(name: str) -> bool:
    return not name[0].isalpha()


def _text(key: tuple[str, ...]) -> str:
    operation, *operands = key
    if operation in "+-*/":
        return f"{operands[0]} {operation} {operands[1]}"
    return f"{operation}({', '.join(operands)})"
