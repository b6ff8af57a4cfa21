"""Shapes as they are written on a command line."""

from __future__ import annotations

import ast
from collections.abc import Callable
from inspect import signature
from typing import Any

from sphear.boundaries.shapes.base import Shape
from sphear.boundaries.shapes.circle import Circle
from sphear.boundaries.shapes.half_plane import HalfPlane
from sphear.boundaries.shapes.polygon import Polygon
from sphear.boundaries.shapes.rectangle import Rectangle
from sphear.errors import SphearError, quoted, shortened
from sphear.names import unknown

PRIMITIVES: dict[str, Callable[..., Shape]] = {kind.__name__: kind for kind in (Circle, HalfPlane, Polygon, Rectangle)}
JOINED: dict[type[ast.operator], Callable[[Shape, Shape], Shape]] = {
    ast.BitOr: lambda a, b: a | b,
    ast.BitAnd: lambda a, b: a & b,
    ast.Sub: lambda a, b: a - b,
}


def written(text: str) -> Shape:
    """The shape of a text, as Python writes it: `Circle((0.3, 0.5), 0.1) | Rectangle((0.6, 0.2), (0.8, 0.4))`.

    Circle, HalfPlane, Polygon and Rectangle with their arguments, joined with |, &, - and ~. The text is read, not run.

    Args:
        text: the shape; lengths are those of the flow.

    Raises:
        SphearError: it is no shape.
    """
    try:
        return _shape(ast.parse(text.strip(), mode="eval").body, text)
    except SphearError:
        raise
    except (RecursionError, MemoryError):
        raise SphearError("a shape is made of fewer others: of these there are more than can be joined") from None
    except (SyntaxError, ValueError):
        raise _no_shape(text) from None


def _shape(node: ast.expr, text: str) -> Shape:
    if isinstance(node, ast.BinOp) and type(node.op) in JOINED:
        return JOINED[type(node.op)](_shape(node.left, text), _shape(node.right, text))
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Invert):
        return ~_shape(node.operand, text)
    if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Name):
        raise _no_shape(text)
    name = node.func.id
    if name not in PRIMITIVES:
        raise unknown("shape", name, PRIMITIVES)
    try:
        values = [ast.literal_eval(argument) for argument in node.args]
        named: dict[str, Any] = {str(each.arg): ast.literal_eval(each.value) for each in node.keywords}
    except (ValueError, TypeError):
        raise SphearError(
            f"the arguments of {shortened(ast.unparse(node))} are to be numbers, in brackets where several"
        ) from None
    if len(named) < len(node.keywords):
        raise SphearError(f"{shortened(ast.unparse(node))} says the same twice: each argument is given once")
    try:
        signature(PRIMITIVES[name]).bind(*values, **named)
    except TypeError as error:
        takes = ", ".join(signature(PRIMITIVES[name]).parameters)
        raise SphearError(f"{shortened(ast.unparse(node))} has {error}: it takes {takes}") from None
    return PRIMITIVES[name](*values, **named)


def _no_shape(text: str) -> SphearError:
    return SphearError(
        f"a shape is written as in Circle((0.3, 0.5), 0.1) | Rectangle((0.6, 0.2), (0.8, 0.4)), not as {quoted(text)}"
    )
