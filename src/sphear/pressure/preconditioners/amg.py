"""Algebraic multigrid: knows the matrix alone, so any geometry will do; its set-up costs more than a solve."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec
from typing import TYPE_CHECKING

from sphear.errors import SphearError
from sphear.pressure.preconditioners.base import Preconditioner

if TYPE_CHECKING:
    from sphear.pressure.preconditioners.base import Vector
    from sphear.pressure.system import PressureSystem


@dataclass(frozen=True)
class AlgebraicMultigrid(Preconditioner):
    """One V-cycle of Ruge and Stuben's algebraic multigrid, from pyamg.

    Symmetric for symmetric matrices: its smoother is Gauss-Seidel forth and back.

    Raises:
        SphearError: pyamg is not installed.

    Examples:
        >>> import sphear
        >>> print(sphear.Incompressible(preconditioner=sphear.AlgebraicMultigrid()))
        Incompressible(preconditioner='amg')
    """

    name = "amg"
    aliases = ("multigrid", "pyamg", "ruge_stuben")
    formula = "M = one V-cycle on coarser matrices chosen by the strength of their entries"
    source = "Ruge & Stueben 1987, in Multigrid Methods, SIAM, chapter 4"

    @staticmethod
    def installed() -> bool:
        """True where pyamg can be imported."""
        return find_spec("pyamg") is not None

    def check(self) -> None:
        """Ask for pyamg."""
        if not self.installed():
            raise SphearError('the preconditioner amg needs pyamg: pip install "sphear[amg]"')

    def build(self, system: PressureSystem) -> Callable[[Vector], Vector]:
        """Choose the coarse levels and set them up."""
        self.check()
        import numpy as np
        import pyamg
        from scipy.sparse import csr_matrix  # takes long: preconditioners are listed without it

        matrix = csr_matrix(-system.rows.assembled())  # pyamg takes no csr_array, and positive definite matrices
        matrix.indices, matrix.indptr = matrix.indices.astype(np.int32), matrix.indptr.astype(np.int32)
        cycle = pyamg.ruge_stuben_solver(matrix, max_coarse=100).aspreconditioner(cycle="V")

        def apply(vector: Vector) -> Vector:
            result: Vector = -(cycle @ vector)
            return result

        return apply
