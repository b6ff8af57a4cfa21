"""The pressure equation of one step: its matrix, and what a preconditioner may know of the particles behind it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from sphear.errors import SphearError
from sphear.pressure.rows import ALONE, FINE, NOT_FINITE, NOT_NEUTRAL, WRONG_SIGN, CompressedRows, Rows

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class PressureSystem:
    """A p = b, where row i of A is the Laplacian at particle i.

        (A p)_i = sum_j w_ij (p_j - p_i), w_ij > 0 as a rule

    so the diagonal is negative and, where no pressure is given, rows sum to zero. Particles of known pressure (a free
    surface) are no unknowns: their w_ij stays in the diagonal of their neighbours, their w_ij p_j is in b.

    Args:
        matrix: (n, n), 1 / length^2 times whatever the equation divides by (nothing, or a density): a sparse matrix,
            or `Rows` that are never put together.
        positions: (n, d), of the unknowns, in units of length.
        lower: (d,), the lower corner of the box around the fluid; walls are at its sides, or it is periodic.
        upper: (d,), its upper corner.
        periodic: (d,), along which axes the flow repeats.
        spacing: the mean distance of particles, in units of length.
        symmetric: whether the matrix is. It is taken at its word: where it is not, conjugate gradients fail, and the
            second attempt of a solve, which does not rely on it, costs its time.
        singular: whether no pressure is given anywhere, so that p is known up to a constant only.

    Raises:
        SphearError: sizes do not fit; an entry is not finite; a particle has no neighbour; a diagonal entry is not
            negative; the matrix is singular and not said to be, or the other way round.

    Examples:
        >>> import numpy as np
        >>> import sphear
        >>> from scipy.sparse import csr_array
        >>> matrix = csr_array([[-3.0, 1.0, 0.0], [1.0, -2.0, 1.0], [0.0, 1.0, -3.0]])
        >>> box = {"lower": (0.0,), "upper": (3.0,), "periodic": (False,), "spacing": 1.0}
        >>> positions = np.array([[0.5], [1.5], [2.5]])
        >>> system = sphear.PressureSystem(matrix, positions, **box, symmetric=True, singular=False)
        >>> sphear.Jacobi().build(system)(np.array([3.0, 2.0, 3.0]))
        array([-1., -1., -1.])
    """

    matrix: Any
    positions: Array
    lower: tuple[float, ...]
    upper: tuple[float, ...]
    periodic: tuple[bool, ...]
    spacing: float
    symmetric: bool
    singular: bool

    def __post_init__(self) -> None:
        object.__setattr__(self, "positions", np.ascontiguousarray(self.positions, np.float64))
        for corner in ("lower", "upper"):
            object.__setattr__(self, corner, tuple(map(float, getattr(self, corner))))
        object.__setattr__(self, "periodic", tuple(map(bool, self.periodic)))
        self._check_sizes()
        row, fault, neutral = self.rows.first_fault(self.singular)
        if fault != FINE:
            where = f"particle {row} at ({', '.join(f'{x:.6g}' for x in self.positions[row])})"
            raise SphearError(
                {
                    NOT_FINITE: f"{where} has an entry in the pressure equation that is not finite",
                    ALONE: f"{where} has no neighbour in the pressure equation",
                    WRONG_SIGN: f"{where} has a diagonal entry in the pressure equation that is not negative",
                    NOT_NEUTRAL: f"the pressure equation is said to fix no pressure, but the row of {where} does not "
                    "sum to zero",
                }[fault]
            )
        if neutral and not self.singular:
            raise SphearError(
                "the pressure equation fixes no pressure anywhere, since all its rows sum to zero: it must be marked "
                "as singular"
            )

    @cached_property
    def rows(self) -> Rows:
        """The matrix as solvers ask for it."""
        matrix: Any = self.matrix
        rows: Rows = matrix if isinstance(matrix, Rows) else CompressedRows(matrix)
        return rows

    @property
    def unknowns(self) -> int:
        """The number of particles of unknown pressure."""
        return len(self.positions)

    @property
    def dimension(self) -> int:
        """The number of axes."""
        return len(self.lower)

    def _check_sizes(self) -> None:
        if self.positions.ndim != 2 or not len(self.positions):
            raise SphearError("the pressure equation needs particles: there is nothing to solve for")
        unknowns, dimension = self.positions.shape
        if self.matrix.shape != (unknowns, unknowns):
            raise SphearError(
                f"the pressure equation of {unknowns} particles needs a {unknowns} x {unknowns} matrix, "
                f"not {' x '.join(map(str, self.matrix.shape))}"
            )
        if not len(self.lower) == len(self.upper) == len(self.periodic) == dimension:
            raise SphearError(f"the box of the pressure equation needs {dimension} axes, like its particles")
        if not all(np.isfinite(high - low) and low < high for low, high in zip(self.lower, self.upper, strict=True)):
            raise SphearError("the box of the pressure equation must extend along each axis")
        if not 0 < self.spacing < float("inf"):
            raise SphearError(f"the particle spacing of the pressure equation must be positive, not {self.spacing}")
        if not np.isfinite(self.positions).all():
            raise SphearError("the positions of the particles in the pressure equation must be finite")
