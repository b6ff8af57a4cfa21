"""The pressure Poisson equation: a matrix on particles, preconditioners by name, Krylov methods by symmetry."""

from __future__ import annotations

from sphear.pressure.failure import PressureFailure
from sphear.pressure.preconditioners import (
    PRECONDITIONERS,
    AlgebraicMultigrid,
    Grid,
    Jacobi,
    Preconditioner,
    read_preconditioner,
)
from sphear.pressure.solve import Solution, solve
from sphear.pressure.system import PressureSystem

__all__ = [
    "PRECONDITIONERS",
    "AlgebraicMultigrid",
    "Grid",
    "Jacobi",
    "Preconditioner",
    "PressureFailure",
    "PressureSystem",
    "Solution",
    "read_preconditioner",
    "solve",
]
