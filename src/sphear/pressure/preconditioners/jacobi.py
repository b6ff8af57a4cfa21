"""The diagonal alone: costs nothing, needs iterations in proportion to particles a side."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from sphear.pressure.preconditioners.base import Preconditioner

if TYPE_CHECKING:
    from sphear.pressure.preconditioners.base import Vector
    from sphear.pressure.system import PressureSystem


@dataclass(frozen=True)
class Jacobi(Preconditioner):
    """The inverse of the diagonal.

    Examples:
        >>> import sphear
        >>> print(sphear.Incompressible(preconditioner=sphear.Jacobi()))
        Incompressible(preconditioner='jacobi')
    """

    name = "jacobi"
    aliases = ("diagonal",)
    formula = "M = D^-1"
    source = "Saad 2003, Iterative Methods for Sparse Linear Systems, section 10.2"

    def build(self, system: PressureSystem) -> Callable[[Vector], Vector]:
        """Divide by the diagonal."""
        inverse = 1.0 / system.rows.diagonal()
        return lambda vector: inverse * vector
