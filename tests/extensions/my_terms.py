"""An extension as a user writes one: a term by a class, one by a function, a kernel, a correction, an equation."""

from __future__ import annotations

from typing import Any

import sphear
from sphear.algebra import Scalar, Vector


@sphear.viscous_term("mine", aliases=("my term",))
class Mine(sphear.LaplacianTerm):
    """That of Morris, Fox & Zhu, with a factor."""

    factor: float = 2.0

    def weight(self, kernel: sphear.Kernel, correction: sphear.Correction, own: Any, d: Vector, r2: Scalar) -> Scalar:
        return -self.factor * correction.radial(kernel, own.prepared, d, r2) / r2


tripled = sphear.viscous_term("tripled")(Mine(factor=6.0))


@sphear.viscous_term("by_function")
def by_function(kernel: sphear.Kernel, correction: sphear.Correction, own: Any, d: Vector, r2: Scalar) -> Scalar:
    """That of Morris, Fox & Zhu, as a function."""
    return -2.0 * correction.radial(kernel, own.prepared, d, r2) / r2


@sphear.kernel("my_kernel")
class MyKernel(sphear.WendlandC2):
    """Wendland's, by another name."""

    name = "my_kernel"


@sphear.correction("my_correction", aliases=("own",))
class MyCorrection(sphear.Shepard):
    """Shepard's, by another name."""


@sphear.equation_of_state("my_equation")
class MyEquation(sphear.Linear):
    """The linear one, by another name."""
