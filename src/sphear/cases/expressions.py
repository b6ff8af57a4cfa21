"""A small, safe language for scalar fields, such as "sin(2*pi*x)*exp(-y**2)", with exact derivatives.

A text goes through Python's parser but is never executed: only what `_read` lists becomes an expression, a graph of the
nodes of `sphear.cases.nodes`. The chain rule, with the partial derivatives that the nodes' operations bring along, does
the rest.
"""

from __future__ import annotations

import ast
import difflib
import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import reduce

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sphear.cases.nodes import OPERATIONS, Node, folded, simplified
from sphear.errors import SphearError, quoted

COORDINATES = ("x", "y", "z")
MAX_LENGTH = 4000  # characters
MAX_DEPTH = 150  # nested operations: far above any formula, far below the limits of Python's parser
BLOCK = 4096  # positions evaluated at once: intermediate results stay in the cache, however many the positions

FUNCTIONS = {name: name for name in OPERATIONS if name.isalpha()} | {"arctan": "atan"}
SYMBOLS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "**"}
# a character or a word no formula has, or a number that runs into a word, which Python may read as two tokens
STRANGE = re.compile(r"[^\w.+\-*/() \t]|\b_\w*|[\d.](?!e[+-]?\d)[a-z_]\w*", re.ASCII | re.IGNORECASE)


def checked(operation: str, *operands: Node) -> Node:
    """The operation exactly as the user wrote it, but for constants; raises SphearError for one that is not finite."""
    node = folded(operation, *operands)
    if node.operands and all(isinstance(operand.head, float) for operand in operands):
        raise SphearError(f"the constant {node.text(60)} is not a finite real number")
    return node


def _read(text: str, names: Mapping[str, Node], make: Callable[..., Node]) -> Node:
    """The node a text stands for, each name replaced by its node and each operation made by `make`."""

    def refuse(tree: ast.AST, word: str = "") -> SphearError:
        nearest = difflib.get_close_matches(word.lower(), [*names, *FUNCTIONS], n=1)
        if word in FUNCTIONS:
            hint = " (a function takes one argument in parentheses)"
        elif word in names:
            hint = " (a product is written with *)"
        elif word in COORDINATES:
            hint = " (there are not so many dimensions)"
        else:
            hint = f" (did you mean {nearest[0]}?)" if nearest else ""
        return _refusal(f"{_quoted(ast.get_source_segment(text, tree) or text)} is not understood{hint}", text, names)

    def build(tree: ast.AST, depth: int = 1) -> Node:
        if depth > MAX_DEPTH:
            raise _refusal(f"more than {MAX_DEPTH} operations are nested", text, names)
        match tree:
            case ast.Constant(value=int() | float() as number) if type(number) is not bool and math.isfinite(number):
                return Node(float(number))
            case ast.Name(id=name) if name in names:
                return names[name]
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return build(operand, depth + 1)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return make("*", Node(-1.0), build(operand, depth + 1))
            case ast.BinOp(left=left, op=symbol, right=right) if type(symbol) in SYMBOLS:
                return make(SYMBOLS[type(symbol)], build(left, depth + 1), build(right, depth + 1))
            case ast.Call(func=ast.Name(id=name), args=[argument], keywords=[]) if name in FUNCTIONS:
                return make(FUNCTIONS[name], build(argument, depth + 1))
            case ast.Call(func=ast.Name(id=word)) | ast.Name(id=word):
                raise refuse(tree, word)
        raise refuse(tree)

    try:
        return build(ast.parse(text, mode="eval").body)
    except SyntaxError as error:
        raise _refusal(f"something is wrong at character {error.offset or len(text)}", text, names) from None
    except (RecursionError, MemoryError, OverflowError):
        raise _refusal("the nesting is too deep or a number too large", text, names) from None


def derivative(root: Node, name: str) -> Node:
    """The derivative by the coordinate `name`, by the chain rule: d f(a, b) = df/da da + df/db db."""

    def visit(node: Node, changes: list[Node]) -> Node:
        total = Node(1.0 if node.head == name else 0.0)
        for i, change in enumerate(changes):
            if change.head != 0.0:  # so that d(x**2) never asks for the log in the other partial derivative
                operands = dict(zip("ab", node.operands, strict=False))
                partial = _read(OPERATIONS[str(node.head)][1][i], operands, simplified)
                total = simplified("+", total, simplified("*", partial, change))
        return total

    return root.fold(visit)


def _quoted(text: str) -> str:
    """The text on one line in plain ASCII, which tells look-alike letters apart, and not too long to read."""
    return ascii(text if len(text) <= 60 else f"{text[:57]}...")


def _refusal(what: str, text: str, names: Mapping[str, Node]) -> SphearError:
    """The one sentence: what is not understood in the text, and what is allowed."""
    return SphearError(
        f"in the expression {_quoted(text)}, {what}: allowed are finite numbers, the names {', '.join(names)}, "
        f"the operators + - * / ** with parentheses, and the functions {', '.join(FUNCTIONS)}"
    )


@dataclass(frozen=True)
class Expression:
    """A scalar field of x, y and z in `dimension` dimensions."""

    root: Node
    dimension: int

    @classmethod
    def parse(cls, text: str, dimension: int) -> Expression:
        """The expression a text stands for; raises SphearError, saying what is allowed, if there is none."""
        if dimension not in (1, 2, 3):
            raise SphearError(f"an expression has dimension 1, 2 or 3, not {dimension}")
        names = {name: Node(name) for name in COORDINATES[:dimension]} | {"pi": Node(math.pi), "e": Node(math.e)}
        if len(text) > MAX_LENGTH:
            raise _refusal(f"there are more than {MAX_LENGTH} characters", text, names)
        text = text.strip()
        if not text:
            raise _refusal("there is nothing to read", text, names)
        if strange := STRANGE.search(text):
            first = strange[0][0]
            hint = " (a power is written **)" if first == "^" else " (a product with *)" if first.isdigit() else ""
            raise _refusal(f"{_quoted(strange[0])} is not understood{hint}", text, names)
        return cls(_read(text, names, checked), dimension)

    def derivative(self, name: str) -> Expression:
        """The partial derivative by the coordinate `name`; raises SphearError if this dimension has no such one."""
        names = COORDINATES[: self.dimension]
        if name not in names:
            raise SphearError(
                f"there is no derivative by {quoted(name)} in {self.dimension}-D, only by {', '.join(names)}"
            )
        return Expression(derivative(self.root, name), self.dimension)

    def gradient(self) -> tuple[Expression, ...]:
        """The partial derivatives by each coordinate in turn."""
        return tuple(self.derivative(name) for name in COORDINATES[: self.dimension])

    def laplacian(self) -> Expression:
        """The sum of the second derivatives, d2/dx2 + d2/dy2 + d2/dz2."""
        seconds = (derivative(derivative(self.root, name), name) for name in COORDINATES[: self.dimension])
        return Expression(reduce(lambda a, b: simplified("+", a, b), seconds), self.dimension)

    def __call__(self, positions: ArrayLike) -> NDArray[np.float64]:
        """The values, shape (N,), at positions of shape (N, dimension).

        Raises SphearError where a position has no finite real value, or if the positions have another shape.
        """
        points = np.asarray(positions, dtype=np.float64)
        if points.ndim != 2 or points.shape[1] != self.dimension:
            raise SphearError(f"positions in {self.dimension}-D have shape (N, {self.dimension}), not {points.shape}")
        values = np.empty(len(points))
        for start in range(0, len(points), BLOCK):
            columns = np.ascontiguousarray(points[start : start + BLOCK].T)
            values[start : start + BLOCK] = self.root.evaluate(dict(zip(COORDINATES, columns, strict=False)))
        return values

    def __str__(self) -> str:
        return str(self.root)
