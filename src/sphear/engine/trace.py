"""Writes a formula down as straight-line code by calling it with symbols in place of numbers.

A `Symbol` records each operation made on it in its `Trace`. Equal operations are recorded once, operations on plain
numbers are done at once, and what the outputs do not need is left out.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any


class Symbol:
    """A number that is known only at run time: an input, or the result of a recorded operation, or its negative.

    The sign is kept beside the name, so that what a pair does to its one particle and to the other, often equal and
    opposite, is recorded once.
    """

    __slots__ = ("name", "negative", "trace")

    def __init__(self, trace: Trace, name: str, negative: bool = False) -> None:
        self.trace = trace
        self.name = name
        self.negative = negative

    def __str__(self) -> str:
        return f"-{self.name}" if self.negative else self.name

    def traced_call(self, function: str, arguments: Sequence[Any]) -> Symbol:
        """The symbol of function(*arguments); `sphear.algebra` calls this."""
        return self.trace.record(function, arguments)

    def __neg__(self) -> Symbol:
        return Symbol(self.trace, self.name, not self.negative)

    def __add__(self, other: Any) -> Any:
        if _is(other, 0):
            return self
        (a, minus_a), (b, minus_b) = _signed(self), _signed(other)
        total = self.trace.record("+", (a, b)) if minus_a == minus_b else self.trace.difference(a, b)
        return -total if minus_a else total

    __radd__ = __add__

    def __sub__(self, other: Any) -> Any:
        return self + (-other)

    def __rsub__(self, other: Any) -> Any:
        return (-self) + other

    def __mul__(self, other: Any) -> Any:
        if _is(other, 0):
            return 0.0
        if _is(other, 1):
            return self
        (a, minus_a), (b, minus_b) = _signed(self), _signed(other)
        product = a if _is(b, 1) else self.trace.record("*", (a, b))
        return -product if minus_a != minus_b else product

    __rmul__ = __mul__

    def __truediv__(self, other: Any) -> Any:
        if not isinstance(other, Symbol):
            return self * (1.0 / other)
        (a, minus_a), (b, minus_b) = _signed(self), _signed(other)
        quotient = self.trace.record("/", (a, b))
        return -quotient if minus_a != minus_b else quotient

    def __rtruediv__(self, other: Any) -> Any:
        if _is(other, 0):
            return 0.0
        (a, minus_a), (b, minus_b) = _signed(other), _signed(self)
        quotient = self.trace.record("/", (a, b))
        return -quotient if minus_a != minus_b else quotient

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


def _signed(value: Any) -> tuple[Any, bool]:
    """The value without its sign, and whether it had one."""
    if isinstance(value, Symbol):
        return Symbol(value.trace, value.name), value.negative
    return abs(value), value < 0


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
        names = [str(x) if isinstance(x, Symbol) else repr(float(x)) for x in operands]
        if operation in "+*":
            names.sort()
        key = (operation, *names)
        if key not in self._operations:
            name = f"t{len(self._operations)}"
            self._operations[key] = Symbol(self, name)
            self._definitions[name] = key
        return self._operations[key]

    def difference(self, a: Any, b: Any) -> Symbol:
        """The symbol of a - b; the negative of b - a where that is recorded already."""
        reversed_key = ("-", *(x.name if isinstance(x, Symbol) else repr(float(x)) for x in (b, a)))
        known = self._operations.get(reversed_key)
        return self.record("-", (a, b)) if known is None else -known

    def code(self, outputs: Iterable[Any]) -> tuple[list[str], set[str]]:
        """Assignments that compute the outputs, in order, and the names of the inputs they use."""
        needed: set[str] = set()
        pending = [x.name for x in outputs if isinstance(x, Symbol)]
        while pending:
            name = pending.pop()
            if name not in needed:
                needed.add(name)
                operands = (x.removeprefix("-") for x in self._definitions.get(name, ())[1:])
                pending += [x for x in operands if not _number(x)]
        lines = [f"{name} = {_text(key)}" for name, key in self._definitions.items() if name in needed]
        return lines, needed - self._definitions.keys()


def _number(name: str) -> bool:
    return not name[0].isalpha()


def _text(key: tuple[str, ...]) -> str:
    operation, *operands = key
    if operation in "+-*/":
        return f"{operands[0]} {operation} {operands[1]}"
    return f"{operation}({', '.join(operands)})"
