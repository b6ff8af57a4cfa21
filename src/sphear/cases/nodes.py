"""Formulas as graphs of immutable nodes: their values, their text, and light simplification.

`OPERATIONS` holds what each operation computes and, in the language of `sphear.cases.expressions`, its partial
derivatives. Every walk over a graph is iterative, so no formula is too deep for it.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from sphear.errors import SphearError

T = TypeVar("T")

# name: what it computes, and its partial derivative by its operand a (and b)
OPERATIONS: dict[str, tuple[np.ufunc, tuple[str, ...]]] = {
    "+": (np.add, ("1", "1")),
    "-": (np.subtract, ("1", "-1")),
    "*": (np.multiply, ("b", "a")),
    "/": (np.divide, ("1/b", "-a/b**2")),
    "**": (np.power, ("b*a**(b - 1)", "a**b*log(a)")),
    "sin": (np.sin, ("cos(a)",)),
    "cos": (np.cos, ("-sin(a)",)),
    "tan": (np.tan, ("1 + tan(a)**2",)),
    "exp": (np.exp, ("exp(a)",)),
    "log": (np.log, ("1/a",)),
    "sqrt": (np.sqrt, ("0.5/sqrt(a)",)),
    "sinh": (np.sinh, ("cosh(a)",)),
    "cosh": (np.cosh, ("sinh(a)",)),
    "tanh": (np.tanh, ("1 - tanh(a)**2",)),
    "atan": (np.arctan, ("1/(1 + a**2)",)),
}
STRENGTH = {"+": 1, "-": 1, "*": 2, "/": 2, "**": 3}  # how strongly an operator binds its operands


@dataclass(frozen=True, eq=False, slots=True, repr=False)
class Node:
    """A number, a coordinate, or an operation (a key of `OPERATIONS`) on its operands."""

    head: float | str
    operands: tuple[Node, ...] = ()

    def fold(self, visit: Callable[[Node, list[T]], T]) -> T:
        """Call visit(node, results of its operands) once for each distinct node, operands first; the result of self."""
        done: dict[Node, T] = {}
        pending = [self]
        while pending:
            missing = [operand for operand in pending[-1].operands if operand not in done]
            pending.extend(missing)
            if not missing and (node := pending.pop()) not in done:
                done[node] = visit(node, [done[operand] for operand in node.operands])
        return done[self]

    def evaluate(self, coordinates: Mapping[str, NDArray[np.float64]]) -> NDArray[np.float64]:
        """The values, shape (N,), at the N > 0 positions whose coordinates are given by name, each of shape (N,).

        Raises SphearError, with the position, where any part has no finite real value, even if the whole has one.
        """

        def visit(node: Node, arguments: list[Any]) -> Any:
            if isinstance(node.head, float):
                return node.head
            values = OPERATIONS[node.head][0](*arguments) if arguments else coordinates[node.head]
            if not (finite := np.atleast_1d(np.isfinite(values))).all():
                at = ", ".join(f"{name} = {column[np.argmin(finite)]:.6g}" for name, column in coordinates.items())
                raise SphearError(f"the expression {node.text(60)} has no finite real value at {at}")
            return values

        with np.errstate(all="ignore"):
            values = self.fold(visit)
        return np.array(np.broadcast_to(values, next(iter(coordinates.values())).shape), dtype=np.float64)

    def text(self, limit: int = sys.maxsize) -> str:
        """The node in its own language, with every part longer than `limit` characters written as '...'."""

        def visit(node: Node, parts: list[str]) -> str:
            text = repr(node.head).removesuffix(".0") if isinstance(node.head, float) else node.head
            if len(parts) == 1:
                text = f"{node.head}({parts[0]})"
            elif parts:
                # a - b - c is (a - b) - c, but a**b**c is a**(b**c)
                for i, least in enumerate((STRENGTH[text] + (text == "**"), STRENGTH[text] + (text != "**"))):
                    held = STRENGTH["*"] if _negative(node.operands[i]) else STRENGTH.get(str(node.operands[i].head), 4)
                    parts[i] = parts[i] if held >= least else f"({parts[i]})"
                minus = text == "*" and node.operands[0].head == -1.0
                text = f"-{parts[1]}" if minus else (f" {text} " if text in "+-" else text).join(parts)
            return text if len(text) <= limit else "..."

        return self.fold(visit)

    __str__ = __repr__ = text


def _negative(node: Node) -> bool:
    """True if a node is a negative number or has one as its first factor, so that it is written with a minus."""
    head = node.operands[0].head if node.head == "*" else node.head
    return isinstance(head, float) and head < 0.0


def folded(operation: str, *operands: Node) -> Node:
    """The operation on the operands, as a number if they are numbers and the result is finite."""
    numbers = [operand.head for operand in operands if isinstance(operand.head, float)]
    if len(numbers) == len(operands):
        with np.errstate(all="ignore"):  # in floating point 9**9**9 is not a long computation but infinite at once
            value = float(OPERATIONS[operation][0](*numbers))
        if math.isfinite(value):
            return Node(value)
    return Node(operation, operands)


def simplified(operation: str, *operands: Node) -> Node:
    """The operation on the operands, without neutral elements and with a product's numeric factor in front."""
    node = folded(operation, *operands)
    if len(node.operands) != 2 or all(isinstance(operand.head, float) for operand in operands):
        return node
    a, b = operands
    match operation, a.head, b.head:
        case ("+", 0.0, _) | ("*", 1.0, _):
            return b
        case ("+" | "-", _, 0.0) | ("*" | "/" | "**", _, 1.0):
            return a
        case ("*", 0.0, _) | ("*", _, 0.0):
            return Node(0.0)
        case ("**", _, 0.0):
            return Node(1.0)
        case ("+", _, _) if _negative(b):
            return simplified("-", a, simplified("*", Node(-1.0), b))
        case ("*", _, float()):
            return simplified("*", b, a)
        case ("*", _, "*") if [isinstance(factor.head, float) for factor in b.operands] == [True, False]:
            return simplified("*", simplified("*", b.operands[0], a), b.operands[1])
    return node
