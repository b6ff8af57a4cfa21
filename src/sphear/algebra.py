"""Scalars, vectors and matrices for formulas: plain numbers, tuples of them, and row-major tuples of tuples.

Every function works on Python floats (so that a formula can be called and checked by hand), on NumPy arrays and on
the symbols with which `sphear.engine` writes a formula down as straight-line code. The dimension is the length of a
tuple, so one source serves 1-D, 2-D and 3-D. Formulas may not branch on values: `positive_part` and `where_less`
take the place of `if`, which keeps them evaluable on many neighbours at once.

Examples:
    >>> from sphear import algebra
    >>> algebra.dot((1.0, 2.0), (3.0, 4.0)), algebra.positive_part(-0.5)
    (11.0, 0.0)
    >>> algebra.where_less(1.0, 2.0, 10.0, 20.0)
    10.0
    >>> algebra.determinant(((2.0, 1.0), (0.0, 4.0)))
    8.0
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

# a float, a NumPy array, or a symbol of the engine's trace: whatever has arithmetic
Scalar = Any
Vector = tuple[Scalar, ...]
Matrix = tuple[Vector, ...]


def _elementary(name: str, on_floats: Callable[..., float], on_arrays: str) -> Callable[..., Scalar]:
    def function(*arguments: Scalar) -> Scalar:
        for argument in arguments:
            if hasattr(argument, "traced_call"):
                return argument.traced_call(name, arguments)
        if all(isinstance(argument, int | float) for argument in arguments):
            return on_floats(*arguments)
        import numpy

        return eval(on_arrays, {"np": numpy, "a": arguments})  # a constant of this file

    function.__name__ = function.__qualname__ = name
    return function


sqrt = _elementary("sqrt", math.sqrt, "np.sqrt(a[0])")
exp = _elementary("exp", math.exp, "np.exp(a[0])")
positive_part = _elementary("positive_part", lambda x: x if x > 0.0 else 0.0, "np.maximum(a[0], 0.0)")
where_less = _elementary(
    "where_less", lambda a, b, yes, no: yes if a < b else no, "np.where(np.less(a[0], a[1]), a[2], a[3])"
)

sqrt.__doc__ = "The square root of x."
exp.__doc__ = "The exponential of x."
positive_part.__doc__ = "max(x, 0), without a branch."
where_less.__doc__ = "`yes` where a < b, else `no`, without a branch: where_less(a, b, yes, no)."


def add(a: Vector, b: Vector) -> Vector:
    """a + b."""
    return tuple(x + y for x, y in zip(a, b, strict=True))


def subtract(a: Vector, b: Vector) -> Vector:
    """a - b."""
    return tuple(x - y for x, y in zip(a, b, strict=True))


def scale(factor: Scalar, a: Vector) -> Vector:
    """factor a."""
    return tuple(factor * x for x in a)


def dot(a: Vector, b: Vector) -> Scalar:
    """a . b."""
    total = a[0] * b[0]
    for x, y in zip(a[1:], b[1:], strict=True):
        total = total + x * y
    return total


def outer(a: Vector, b: Vector) -> Matrix:
    """The matrix a_i b_j."""
    return tuple(tuple(x * y for y in b) for x in a)


def identity(dimension: int) -> Matrix:
    """The unit matrix."""
    return tuple(tuple(1.0 if i == j else 0.0 for j in range(dimension)) for i in range(dimension))


def combine(s: Scalar, a: Matrix, t: Scalar, b: Matrix) -> Matrix:
    """s A + t B."""
    return tuple(add(scale(s, x), scale(t, y)) for x, y in zip(a, b, strict=True))


def apply(a: Matrix, v: Vector) -> Vector:
    """A v."""
    return tuple(dot(row, v) for row in a)


def transpose(a: Matrix) -> Matrix:
    """A^T."""
    return tuple(zip(*a, strict=True))


def multiply(a: Matrix, b: Matrix) -> Matrix:
    """A B."""
    columns = transpose(b)
    return tuple(tuple(dot(row, column) for column in columns) for row in a)


def trace(a: Matrix) -> Scalar:
    """The sum of the diagonal."""
    total = a[0][0]
    for i in range(1, len(a)):
        total = total + a[i][i]
    return total


def determinant(a: Matrix) -> Scalar:
    """det A, by expansion: for the 1 x 1 to 3 x 3 matrices of 1-D to 3-D."""
    if len(a) == 1:
        return a[0][0]
    total: Scalar = 0.0
    for column in range(len(a)):
        minor = tuple(row[:column] + row[column + 1 :] for row in a[1:])
        total = total + (-1.0) ** column * a[0][column] * determinant(minor)
    return total


def adjugate(a: Matrix) -> Matrix:
    """adj A, so that A adj A = det A I: the inverse before its division, which may be by zero."""
    size = len(a)
    if size == 1:
        return ((1.0,),)

    def cofactor(i: int, j: int) -> Scalar:
        minor = tuple(row[:j] + row[j + 1 :] for k, row in enumerate(a) if k != i)
        return (-1.0) ** (i + j) * determinant(minor)

    return tuple(tuple(cofactor(j, i) for j in range(size)) for i in range(size))


def solve(a: Matrix, b: Vector) -> tuple[Scalar, Vector]:
    """The smallest pivot, and x with A x = b, by elimination with exchanges of rows, without branches.

    Where A is singular the smallest pivot is of the order of rounding, of what A is made of; it is for the caller to
    compare it with that. Where it is zero, x is finite and means nothing.
    """
    size = len(b)
    rows = [[*row, right] for row, right in zip(a, b, strict=True)]
    smallest: Scalar = None
    for k in range(size):
        for row in rows[k + 1 :]:
            upper, lower = _magnitude(rows[k][k]), _magnitude(row[k])
            for column in range(k, size + 1):
                x, y = rows[k][column], row[column]
                rows[k][column] = where_less(upper, lower, y, x)
                row[column] = where_less(upper, lower, x, y)
        pivot = rows[k][k]
        magnitude = _magnitude(pivot)
        smallest = magnitude if smallest is None else where_less(magnitude, smallest, magnitude, smallest)
        inverse = where_less(0.0, magnitude, 1.0 / where_less(0.0, magnitude, pivot, 1.0), 0.0)
        for row in rows[k + 1 :]:
            factor = row[k] * inverse
            for column in range(k + 1, size + 1):
                row[column] = row[column] - factor * rows[k][column]
        rows[k] = [x * inverse for x in rows[k]]
    solution: list[Scalar] = [0.0] * size
    for k in reversed(range(size)):
        value = rows[k][size]
        for column in range(k + 1, size):
            value = value - rows[k][column] * solution[column]
        solution[k] = value
    return smallest, tuple(solution)


def _magnitude(x: Scalar) -> Scalar:
    return where_less(x, 0.0, -x, x)
