"""Preconditioners of the pressure equation: cheap approximations to the inverse of its matrix."""

from __future__ import annotations

from sphear.names import Registry
from sphear.pressure.preconditioners.amg import AlgebraicMultigrid
from sphear.pressure.preconditioners.base import Preconditioner
from sphear.pressure.preconditioners.grid import Grid
from sphear.pressure.preconditioners.jacobi import Jacobi

PRECONDITIONERS: Registry[Preconditioner] = Registry("preconditioner")
for _preconditioner in (Jacobi(), Grid(), AlgebraicMultigrid()):
    PRECONDITIONERS.add(_preconditioner.name, _preconditioner, _preconditioner.aliases)
PRECONDITIONERS.open()


def read_preconditioner(preconditioner: str | Preconditioner) -> Preconditioner:
    """A preconditioner by name or alias, or as an object.

    Raises:
        SphearError: there is none of that name.
    """
    return PRECONDITIONERS[preconditioner] if isinstance(preconditioner, str) else preconditioner


__all__ = ["PRECONDITIONERS", "AlgebraicMultigrid", "Grid", "Jacobi", "Preconditioner", "read_preconditioner"]
