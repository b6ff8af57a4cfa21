"""Solve a pressure equation: method by symmetry, null space exactly, warm start, one retry with what is safer."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.sparse.csgraph import connected_components

from sphear.errors import SphearError
from sphear.pressure.failure import PressureFailure
from sphear.pressure.krylov import KrylovResult, Vector, iterate
from sphear.pressure.preconditioners import PRECONDITIONERS, AlgebraicMultigrid, Preconditioner, read_preconditioner
from sphear.pressure.rows import ROUNDING
from sphear.pressure.system import PressureSystem
from sphear.pressure.vectors import norm

REPEATS = 3  # runs of a method, each from the last one's result: recursions for residuals drift from the residual
SLACK = 1.01  # by which the residual may miss the tolerance, for the same reason
MOST_AGAIN = {"amg": 200, "jacobi": 5000}  # iterations of the second attempt
NOTHING = 1e-14  # the share of a right-hand side that is rounding: of a constant, when the constant is taken out


@dataclass(frozen=True)
class Solution:
    """The pressure, and what it took.

    Attributes:
        values: (n,), with mean zero where the system is singular.
        iterations: of all attempts; of BiCGSTAB each has two products by the matrix.
        residual: ||b - A p|| / ||b||, computed anew at the end; in a singular system of what is left of b.
        imbalance: |lambda| ||1|| / ||b||, the share of the right-hand side that a singular system cannot have.
        method: cg, bicgstab, gmres, or direct where there was nothing to do.
        preconditioner: the one it was reached with.
        retried: whether the preconditioner asked for did not suffice.
    """

    values: Vector
    iterations: int
    residual: float
    imbalance: float
    method: str
    preconditioner: str
    retried: bool = False


def solve(
    system: PressureSystem,
    right: Vector,
    guess: Vector | None = None,
    preconditioner: str | Preconditioner = "grid",
    tolerance: float = 1e-6,
    most: int = 500,
    floor: float = 0.0,
) -> Solution:
    """The p of A p = b, or where that is singular the p of mean zero and the lambda of A p + lambda 1 = b.

    Where no pressure is fixed, A 1 = 0 and b must be orthogonal to the left null vector, which rounding or a
    non-symmetric discretisation never quite brings about. The bordered system

        A p + lambda 1 = b,  1 . p = 0

    always has one solution (if the left null vector is not orthogonal to 1). With P = 1 - 1 1^T / n it is
    P A P p = P b: A P = A, and P removes lambda 1, so Krylov methods are given P A and P b, at the cost of a mean a
    product, and lambda is the mean of b - A p. Of a symmetric matrix P A = A, lambda is the mean of b, and only b is
    projected.

    Args:
        system: matrix, particles and box.
        right: b, (n,), in units of the matrix times pressure.
        guess: (n,), where to begin, such as the pressure of the last step. The tolerance does not depend on it.
        preconditioner: a name of `PRECONDITIONERS`, or one with settings of its own.
        tolerance: ||b - A p|| / ||b|| to be reached, without b's imbalance.
        most: iterations of the first attempt.
        floor: a length ||b|| below which b, without its imbalance, is the rounding of what it was made from: it is
            taken for nothing.

    Raises:
        SphearError: the right-hand side or the guess is not (n,) finite numbers.
        PressureFailure: neither the preconditioner asked for nor GMRES with a safer one (amg if pyamg is installed,
            else jacobi) reaches the tolerance.
    """
    first = read_preconditioner(preconditioner)
    right = _checked("right-hand side", right, system.unknowns)
    guess = None if guess is None else _checked("first guess", guess, system.unknowns)
    if not 0 < tolerance < 1:
        raise SphearError(f"the tolerance of the pressure equation must be between 0 and 1, not {tolerance:g}")
    whole = norm(right)
    balanced = right - right.mean() if system.singular else right
    length = norm(balanced)
    if length <= max(NOTHING * whole, floor):
        nothing = np.zeros(system.unknowns)
        return Solution(nothing, 0, 0.0, 1.0 if whole else 0.0, "direct", first.name)

    # of length one, so that what is small does not depend on units
    balanced, guess = balanced / length, None if guess is None else guess / length
    if system.singular:  # where little is left of a large constant, so is rounding of it: no product has that
        balanced -= balanced.mean()
    attempt, residual, mean = _attempt(system, balanced, guess, first, tolerance, most, robust=False)
    retried = False
    iterations, used = attempt.iterations, first
    if not residual <= SLACK * tolerance:
        retried, used = True, _safer(first)
        most = MOST_AGAIN[used.name]
        system = replace(system, symmetric=False)  # which nothing that follows relies upon any more
        attempt, residual, mean = _attempt(system, balanced, None, used, tolerance, most, robust=True)
        iterations += attempt.iterations
        if not residual <= SLACK * tolerance:
            raise PressureFailure(iterations, residual, tolerance, _reason(system, first.name, used.name))

    values, imbalance = length * attempt.values, 0.0
    if system.singular:
        values -= values.mean()
        excess = right.mean() if system.symmetric else right.mean() - length * mean
        imbalance = float(abs(excess) * np.sqrt(system.unknowns) / whole)
    return Solution(values, iterations, residual, imbalance, attempt.method, used.name, retried=retried)


def _attempt(
    system: PressureSystem,
    right: Vector,
    guess: Vector | None,
    preconditioner: Preconditioner,
    tolerance: float,
    most: int,
    *,
    robust: bool,
) -> tuple[KrylovResult, float, float]:
    """The result of a method, its residual's length, and the mean of A p."""
    inverse = preconditioner.build(system)
    iterations = 0
    for _ in range(REPEATS):
        with np.errstate(all="ignore"):  # what grows beyond all bounds shows in the result
            run = iterate(system, right, guess, inverse, tolerance, most - iterations, robust=robust)
            residual, mean = _residual(system, right, run.values)
        iterations += run.iterations
        finite = bool(np.isfinite(run.values).all())
        if not finite or iterations >= most or residual <= SLACK * tolerance:
            break
        guess = run.values
    return replace(run, iterations=iterations), residual, mean


def _residual(system: PressureSystem, right: Vector, values: Vector) -> tuple[float, float]:
    """||b - A p||, without its mean where the system is singular and not symmetric; and the mean of A p."""
    along: Vector = system.rows.times(values)
    mean = float(along.mean())
    return norm(right - (along - mean if system.singular and not system.symmetric else along)), mean


def _safer(preconditioner: Preconditioner) -> Preconditioner:
    known = preconditioner.name != "amg" and AlgebraicMultigrid.installed()
    return PRECONDITIONERS["amg" if known else "jacobi"]


def _reason(system: PressureSystem, first: str, second: str) -> str:
    matrix = system.rows.assembled()
    parts, part = connected_components(matrix, directed=False)
    ones = np.ones(system.unknowns)
    given = np.abs(matrix @ ones) > ROUNDING * (abs(matrix) @ ones)
    fixed = part[:1] if system.singular else np.unique(part[given])  # one part's is fixed by the mean
    if len(fixed) < parts:
        return (
            f"the fluid falls into {parts} parts without a common neighbour, and in {parts - len(fixed)} of them "
            "nothing fixes the pressure"
        )
    return f"with the preconditioner {first}, then with {second}"


def _checked(what: str, vector: Any, unknowns: int) -> Vector:
    array: Vector = np.asarray(vector, dtype=np.float64)
    if array.shape != (unknowns,):
        raise SphearError(f"the {what} of the pressure equation must be {unknowns} numbers, not of shape {array.shape}")
    if not np.isfinite(array).all():
        raise SphearError(
            f"the {what} of the pressure equation is not finite at particle {int(np.argmin(np.isfinite(array)))}"
        )
    return array
