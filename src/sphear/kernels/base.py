"""The base of all kernels: W(r, h) = sigma_d / h^d w(q), q = r / h, and its derivatives from those of w."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from sphear.algebra import Matrix, Scalar, Vector, combine, identity, outer, scale, sqrt
from sphear.errors import SphearError, quoted
from sphear.positive import is_positive


@dataclass(frozen=True)
class Kernel:
    """A radial kernel with compact support: W(r, h) = sigma_d / h^d w(r / h) in d dimensions.

    One of your own has the methods `shape`, `slope` and `curvature`: docs/how-to/extending.md.

    Args:
        h: the smoothing length, in units of length; the kernel vanishes from `support` h on.

    Raises:
        SphearError: h is not a positive number.

    Examples:
        >>> import sphear
        >>> kernel = sphear.WendlandC2(h=0.1)
        >>> isinstance(kernel, sphear.Kernel), kernel.support
        (True, 2.0)
        >>> round(kernel.value(0.05**2, dimension=2), 2)  # W at the distance 0.05
        35.25
        >>> round(kernel.gradient((0.05, 0.0), 0.05**2)[0], 1)
        -587.5
    """

    h: float

    name: ClassVar[str] = "unnamed"
    aliases: ClassVar[tuple[str, ...]] = ()
    formula: ClassVar[str] = "not stated"
    source: ClassVar[str] = "not stated"
    support: ClassVar[float]  # in smoothing lengths
    sigma: ClassVar[tuple[float, float, float]]  # makes the integral one in 1, 2 and 3 dimensions

    def __post_init__(self) -> None:
        if not is_positive(self.h):
            raise SphearError(f"the smoothing length h must be positive, not {quoted(self.h)}")

    def shape(self, q: Scalar, dimension: int) -> Scalar:
        """The shape w(q)."""
        raise NotImplementedError

    def slope(self, q: Scalar, dimension: int) -> Scalar:
        """The slope w'(q) / q, written without the division where w allows it."""
        raise NotImplementedError

    def curvature(self, q: Scalar, dimension: int) -> Scalar:
        """The curvature w''(q)."""
        raise NotImplementedError

    @property
    def radius(self) -> float:
        """The distance from which on the kernel is zero."""
        return self.support * self.h

    def _scale(self, dimension: int, derivatives: int) -> Scalar:
        return self.sigma[dimension - 1] / self.h ** (dimension + derivatives)

    def value(self, r2: Scalar, dimension: int) -> Scalar:
        """The kernel W at the squared distance r2."""
        return self._scale(dimension, 0) * self.shape(sqrt(r2) / self.h, dimension)

    def gradient_factor(self, r2: Scalar, dimension: int) -> Scalar:
        """(1/r) dW/dr: the gradient with respect to the first particle's position is this times d = r_i - r_j."""
        return self._scale(dimension, 2) * self.slope(sqrt(r2) / self.h, dimension)

    def second_derivative(self, r2: Scalar, dimension: int) -> Scalar:
        """The second derivative d2W/dr2."""
        return self._scale(dimension, 2) * self.curvature(sqrt(r2) / self.h, dimension)

    def gradient(self, d: Vector, r2: Scalar) -> Vector:
        """The gradient grad_i W(r_i - r_j) with respect to r_i."""
        return scale(self.gradient_factor(r2, len(d)), d)

    def hessian(self, d: Vector, r2: Scalar) -> Matrix:
        """All second derivatives of W (Basa, Quinlan & Lastiwka 2009, eq. 28); not for r = 0."""
        factor = self.gradient_factor(r2, len(d))
        along = (self.second_derivative(r2, len(d)) - factor) / r2
        return combine(along, outer(d, d), factor, identity(len(d)))

    def value_at_zero(self, dimension: int) -> Scalar:
        """W(0), what a particle adds to its own sum."""
        return self._scale(dimension, 0) * self.shape(0.0, dimension)

    def hessian_at_zero(self, dimension: int) -> Matrix:
        """The second derivatives at r = 0: d2W/dr2 on the diagonal."""
        curvature = self._scale(dimension, 2) * self.curvature(0.0, dimension)
        return tuple(scale(curvature, row) for row in identity(dimension))
