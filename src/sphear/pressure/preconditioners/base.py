"""The methods that all preconditioners have."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    import numpy as np

    from sphear.pressure.system import PressureSystem

    Vector = np.ndarray[Any, np.dtype[np.float64]]


@dataclass(frozen=True)
class Preconditioner:
    """A way to approximate the inverse of the matrix of a pressure equation.

    Matrices are negative definite (or semidefinite), and so must be the approximation: conjugate gradients only ask
    that both have the same sign. Of a symmetric matrix the approximation is symmetric.

    Examples:
        >>> import sphear
        >>> isinstance(sphear.Grid(), sphear.Preconditioner)
        True
        >>> print(sphear.Jacobi.formula)
        M = D^-1
    """

    name: ClassVar[str] = "unnamed"
    aliases: ClassVar[tuple[str, ...]] = ()
    formula: ClassVar[str] = "not stated"
    source: ClassVar[str] = "not stated"

    def check(self) -> None:
        """Refuse what cannot be had here.

        Raises:
            SphearError: a package that it needs is not installed.
        """

    def build(self, system: PressureSystem) -> Callable[[Vector], Vector]:
        """The function that applies M to a vector (n,); M stands for the inverse of the matrix."""
        raise NotImplementedError
