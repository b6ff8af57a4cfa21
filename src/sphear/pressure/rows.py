"""The matrix of a pressure equation as solvers ask for it: products, its diagonal, and what is wrong with it."""

from __future__ import annotations

from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from scipy.sparse import csr_array, csr_matrix

from sphear.engine.cache import compiled, inlined

Array = np.ndarray[Any, Any]
Sparse = csr_matrix[Any] | csr_array[Any, tuple[int, int]]

ROUNDING = 1e-8  # of a row's sum, relative to the sum of its sizes; a row has some 10 to 100 entries

FINE, NOT_FINITE, ALONE, WRONG_SIGN, NOT_NEUTRAL = range(5)


class Fault(NamedTuple):
    """The first row with a fault.

    row: its number.
    kind: FINE, or what is wrong with it.
    neutral: whether all rows before it sum to zero.
    """

    row: int
    kind: int
    neutral: bool


@runtime_checkable
class Rows(Protocol):
    """The matrix (n, n) of a pressure equation, in whatever form.

    Attributes:
        threads: that products are computed on.
        shape: (n, n).
    """

    threads: int

    @property
    def shape(self) -> tuple[int, ...]:
        """The number of unknowns twice, (n, n)."""

    def times(self, vector: Array) -> Array:
        """The product (n,) with a vector (n,)."""

    def diagonal(self) -> Array:
        """The diagonal (n,)."""

    def first_fault(self, singular: bool) -> Fault:
        """The first row that a pressure equation cannot have; `singular` ones must sum to zero."""

    def coefficient(self, positions: Array, periods: Array, step: int) -> float:
        """The c of c lap that rows stand for: the mean of sum_j a_ij |r_j - r_i|^2 / (2 d) over every `step`-th row.

        It is one for lap |r|^2 = 2 d. Rows near walls have neighbours on one side only and count less, as they should:
        their matrix is as much smaller.

        Args:
            positions: (n, d), of the unknowns.
            periods: (d,), of the axes that repeat, 0 of others.
            step: between rows.
        """

    def assembled(self) -> Sparse:
        """The matrix in compressed rows."""


@compiled
def _first_fault(first, column, entry, start, singular, rounding):  # type: ignore[no-untyped-def]
    neutral = True
    for row in range(len(first) - 1):
        diagonal, total, size, neighbours = 0.0, 0.0, 0.0, 0
        for k in range(first[row], first[row + 1]):
            total += entry[k]
            size += abs(entry[k])
            if column[k] == row + start:
                diagonal += entry[k]
            elif entry[k] != 0.0:
                neighbours += 1
        if not np.isfinite(size):
            return row, NOT_FINITE, neutral
        if neighbours == 0 and (singular or diagonal == 0.0):
            return row, ALONE, neutral
        if diagonal >= 0.0:
            return row, WRONG_SIGN, neutral
        if abs(total) > rounding * size:
            neutral = False
            if singular:
                return row, NOT_NEUTRAL, neutral
    return len(first) - 1, FINE, neutral


@inlined
def square_distance(positions, i, j, periods):  # type: ignore[no-untyped-def]
    """|r_j - r_i|^2 of positions (n, d), by the shortest way along axes that repeat."""
    square = 0.0
    for axis in range(positions.shape[1]):
        d = positions[j, axis] - positions[i, axis]
        if periods[axis] > 0.0:
            d -= periods[axis] * np.rint(d / periods[axis])
        square += d * d
    return square


@compiled
def moments(first, column, entry, start, positions, periods, step):  # type: ignore[no-untyped-def]
    """The sum over every `step`-th row from number `start` on of sum_j a_ij |r_j - r_i|^2, and how many rows."""
    total, rows = 0.0, 0
    for i in range(-start % step, len(first) - 1, step):
        for k in range(first[i], first[i + 1]):
            total += entry[k] * square_distance(positions, i + start, column[k], periods)
        rows += 1
    return total, rows


def fault_of(matrix: Sparse, start: int, singular: bool) -> Fault:
    """The first of the rows `start`, start + 1, ... of a matrix that a pressure equation cannot have."""
    row, kind, neutral = _first_fault(matrix.indptr, matrix.indices, matrix.data, start, singular, ROUNDING)
    return Fault(start + row, kind, neutral)


class CompressedRows:
    """A matrix that is given in compressed rows.

    Args:
        matrix: (n, n).
    """

    threads = 1

    def __init__(self, matrix: Sparse) -> None:
        self.matrix = matrix

    @property
    def shape(self) -> tuple[int, ...]:
        """The number of unknowns twice, (n, n)."""
        return self.matrix.shape

    def times(self, vector: Array) -> Array:
        """The product (n,) with a vector (n,)."""
        result: Array = self.matrix @ vector
        return result

    def diagonal(self) -> Array:
        """The diagonal (n,)."""
        result: Array = self.matrix.diagonal()
        return result

    def first_fault(self, singular: bool) -> Fault:
        """The first row that a pressure equation cannot have."""
        return fault_of(self.matrix, 0, singular)

    def coefficient(self, positions: Array, periods: Array, step: int) -> float:
        """The c of c lap that rows stand for."""
        matrix = self.matrix
        total, rows = moments(matrix.indptr, matrix.indices, matrix.data, 0, positions, periods, step)
        return float(total / (2 * positions.shape[1] * rows))

    def assembled(self) -> Sparse:
        """The matrix itself."""
        return self.matrix
