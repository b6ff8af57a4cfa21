"""Krylov methods behind one signature: conjugate gradients, BiCGSTAB, and SciPy's GMRES.

SciPy has the first two as well, with BLAS in them: `sphear.pressure.vectors` says why that will not do here.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.sparse.linalg import LinearOperator
from scipy.sparse.linalg import gmres as scipy_gmres

from sphear.pressure.system import PressureSystem
from sphear.pressure.vectors import advance, dot, update_direction

Vector = np.ndarray[Any, np.dtype[np.float64]]
Operator = Callable[[Vector], Vector]

RESTART = 50  # iterations of GMRES after which its basis is dropped: 50 vectors are as much memory as the matrix
TINY = 1e-14  # of two vectors' lengths, a product of BiCGSTAB that only rounding is left of


@dataclass(frozen=True)
class KrylovResult:
    """The approximation that a method came to, and its cost.

    Attributes:
        values: (n,), its approximation, which need not be finite after a breakdown.
        iterations: of BiCGSTAB, each has two products by the matrix, of the others one.
        method: cg, bicgstab or gmres.
        converged: its own residual, which may have drifted from the true one, has the length asked for.
    """

    values: Vector
    iterations: int
    method: str
    converged: bool


def product(system: PressureSystem) -> Operator:
    """A, or P A where the matrix is singular and not symmetric: see `sphear.pressure.solver`."""
    times = system.rows.times

    def projected(vector: Vector) -> Vector:
        result: Vector = times(vector)
        result -= np.add.reduce(result) / len(result)  # a mean, without what NumPy's asks first
        return result

    return projected if system.singular and not system.symmetric else times


def conjugate_gradients(
    times: Operator, right: Vector, values: Vector, inverse: Operator, tolerance: float, most: int
) -> KrylovResult:
    """Hestenes and Stiefel 1952, preconditioned; A and its approximate inverse may both be negative definite.

    It has the signs of neither: alpha = r . M r / p . A p and beta = r' . M r' / r . M r are those of -A and -M.
    """
    residual = right - times(values)
    direction = inverse(residual)
    rho, iterations, square = dot(residual, direction), 0, dot(residual, residual)
    while square > tolerance**2 and iterations < most:
        along = times(direction)
        curvature = dot(direction, along)
        if rho == 0.0 or curvature == 0.0 or not math.isfinite(rho / curvature):
            break
        square = advance(values, residual, direction, along, rho / curvature)
        iterations += 1
        if square > tolerance**2:
            towards = inverse(residual)
            before, rho = rho, dot(residual, towards)
            update_direction(direction, towards, rho / before)
    return KrylovResult(values, iterations, "cg", square <= tolerance**2)


def bicgstab(
    times: Operator, right: Vector, values: Vector, inverse: Operator, tolerance: float, most: int
) -> KrylovResult:
    """Van der Vorst 1992, preconditioned from the right; ends early where one of its divisors vanishes."""
    residual = right - times(values)
    shadow, direction = residual.copy(), residual.copy()
    rho, iterations = dot(shadow, residual), 0
    square = length = rho  # of the residual, and of its shadow once and for all
    while square > tolerance**2 and iterations < most:
        first = inverse(direction)
        along = times(first)
        divisor = dot(shadow, along)
        small = TINY * math.sqrt(length)
        if not (abs(rho) > small * math.sqrt(square) and abs(divisor) > small * math.sqrt(dot(along, along))):
            break
        alpha = rho / divisor
        iterations += 1
        square = advance(values, residual, first, along, alpha)
        if square <= tolerance**2:
            break
        second = inverse(residual)
        across = times(second)
        extent = dot(across, across)
        omega = dot(across, residual) / extent if extent > 0.0 else 0.0
        square = advance(values, residual, second, across, omega)
        before, rho = rho, dot(shadow, residual)
        if omega == 0.0 or not math.isfinite(omega):
            break
        direction -= omega * along
        update_direction(direction, residual, (rho / before) * (alpha / omega))
    return KrylovResult(values, iterations, "bicgstab", square <= tolerance**2)


def gmres(
    times: Operator, right: Vector, values: Vector, inverse: Operator, tolerance: float, most: int
) -> KrylovResult:
    """Saad and Schultz 1986, restarted; nothing in it can vanish, but each iteration costs more than the last."""
    operator: Any = LinearOperator
    shape, norms = (len(right), len(right)), list[float]()
    values, _ = scipy_gmres(
        operator(shape, matvec=times, dtype=np.float64),
        right,
        values,
        M=operator(shape, matvec=inverse, dtype=np.float64),
        rtol=tolerance,
        restart=RESTART,
        maxiter=-(-most // RESTART),
        callback=norms.append,
        callback_type="pr_norm",
    )
    return KrylovResult(values, len(norms), "gmres", bool(norms) and norms[-1] <= tolerance)


def iterate(
    system: PressureSystem,
    right: Vector,
    guess: Vector | None,
    inverse: Operator,
    tolerance: float,
    most: int,
    *,
    robust: bool = False,
) -> KrylovResult:
    """Conjugate gradients where the matrix is symmetric, else BiCGSTAB, and GMRES where that breaks down.

    Args:
        system: the equation.
        right: (n,), of length one, so that methods can tell what is small; free of what a singular system cannot have.
        guess: (n,), where to begin.
        inverse: the preconditioner.
        tolerance: of the residual's length.
        most: iterations, of each method.
        robust: GMRES at once.
    """
    times = product(system)
    start = np.zeros(system.unknowns) if guess is None else guess.copy()
    if system.symmetric and not robust:
        return conjugate_gradients(times, right, start, inverse, tolerance, most)
    spent = 0
    if not robust:
        run = bicgstab(times, right, start, inverse, tolerance, most)
        if run.iterations >= most or run.converged:
            return run
        # it broke down; its approximation is as good a start as any unless that went wrong too
        spent, start = run.iterations, run.values if np.isfinite(run.values).all() else np.zeros(system.unknowns)
    run = gmres(times, right, start, inverse, tolerance, most)
    return replace(run, iterations=spent + run.iterations)
