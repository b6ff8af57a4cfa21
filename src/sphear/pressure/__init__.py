"""The pressure Poisson equation: a matrix on particles, preconditioners by name, Krylov methods by symmetry.

Preconditioners are listed without what computes: systems and solvers are imported when first used.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sphear.lazy import lazy_names
from sphear.pressure.failure import PressureFailure
from sphear.pressure.preconditioners import (
    PRECONDITIONERS,
    AlgebraicMultigrid,
    Grid,
    Jacobi,
    Preconditioner,
    read_preconditioner,
)

if TYPE_CHECKING:
    from sphear.pressure.solver import Solution, solve
    from sphear.pressure.system import PressureSystem
else:
    __getattr__ = lazy_names(
        __name__,
        {"sphear.pressure.solver": ("Solution", "solve"), "sphear.pressure.system": ("PressureSystem",)},
    )

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
