"""The base of all consistency corrections: a kernel corrected by sums over the neighbourhood."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from sphear.algebra import Matrix, Scalar, Vector, dot
from sphear.engine.preparation import Preparation
from sphear.errors import SphearError
from sphear.kernels import Kernel


@dataclass(frozen=True)
class Correction:
    """A way to make sums over disordered or missing neighbours consistent.

    `prepared` is what `preparation` sums up for the particle; the corrected kernel W~ is evaluated from it.
    One of your own has the methods `preparation`, `value` and `gradient`: docs/how-to/extending.md.

    Examples:
        >>> import sphear
        >>> isinstance(sphear.Shepard(), sphear.Correction)
        True
        >>> print(sphear.Shepard.formula)
        W~_ab = W_ab / <1>_a, its derivatives by the quotient rule
    """

    name: ClassVar[str] = "unnamed"
    aliases: ClassVar[tuple[str, ...]] = ()
    formula: ClassVar[str] = "not stated"
    source: ClassVar[str] = "not stated"
    zeroth_order: ClassVar[bool] = False  # whether sums of derivatives of W~, the particle itself included, vanish

    def preparation(self, kernel: Kernel, second_derivatives: bool = False) -> Preparation | None:
        """The interaction that sums up what the correction needs, for `hessian` too if asked for; None if nothing."""
        raise NotImplementedError

    def value(self, kernel: Kernel, prepared: Any, d: Vector, r2: Scalar) -> Scalar:
        """The corrected kernel W~."""
        raise NotImplementedError

    def gradient(self, kernel: Kernel, prepared: Any, d: Vector, r2: Scalar) -> Vector:
        """The corrected gradient of W with respect to the first particle's position."""
        raise NotImplementedError

    def gradient_at_zero(self, kernel: Kernel, prepared: Any, dimension: int) -> Vector | None:
        """The corrected gradient of W at r = 0, which a particle adds to its own sums; None where it is zero."""
        return None

    def hessian(self, kernel: Kernel, prepared: Any, d: Vector, r2: Scalar) -> Matrix:
        """The corrected second derivatives of W, which few viscous terms need.

        Raises:
            SphearError: the correction has none.
        """
        raise SphearError(
            f"the correction {type(self).__name__} has no method hessian, and this viscous term needs its second"
            " derivatives"
        )

    def radial(self, kernel: Kernel, prepared: Any, d: Vector, r2: Scalar) -> Scalar:
        """d . grad W~."""
        return dot(d, self.gradient(kernel, prepared, d, r2))
