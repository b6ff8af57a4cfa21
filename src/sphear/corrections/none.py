"""No correction."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Matrix, Scalar, Vector
from sphear.corrections.base import Correction
from sphear.engine.preparation import Preparation
from sphear.kernels import Kernel


@dataclass(frozen=True)
class NoCorrection(Correction):
    """The kernel as it is: W~ = W.

    Gingold & Monaghan 1977; Lucy 1977.

    Examples:
        >>> import sphear
        >>> kernel = sphear.CubicSpline(h=0.1)
        >>> corrected = sphear.NoCorrection().gradient(kernel, None, (0.05, 0.0), 0.0025)
        >>> corrected == kernel.gradient((0.05, 0.0), 0.0025)
        True
    """

    name = "none"
    aliases = ("uncorrected",)
    formula = "W~ = W"
    source = "Gingold & Monaghan 1977; Lucy 1977"
    zeroth_order = False

    def preparation(self, kernel: Kernel, second_derivatives: bool = False) -> Preparation | None:
        """Nothing to sum up."""
        return None

    def value(self, kernel: Kernel, prepared: Any, d: Vector, r2: Scalar) -> Scalar:
        """W."""
        return kernel.value(r2, len(d))

    def gradient(self, kernel: Kernel, prepared: Any, d: Vector, r2: Scalar) -> Vector:
        """grad W."""
        return kernel.gradient(d, r2)

    def hessian(self, kernel: Kernel, prepared: Any, d: Vector, r2: Scalar) -> Matrix:
        """The second derivatives of W."""
        return kernel.hessian(d, r2)

    def radial(self, kernel: Kernel, prepared: Any, d: Vector, r2: Scalar) -> Scalar:
        """d . grad W = r dW/dr."""
        return kernel.gradient_factor(r2, len(d)) * r2
