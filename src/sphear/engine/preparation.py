"""Preparations: what is summed up of each particle's neighbourhood before the sums that need it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, Protocol

from sphear.engine.formula import Interaction, Sum

if TYPE_CHECKING:
    import numpy as np

    Array = np.ndarray[Any, Any]


class Preparation(Interaction, Protocol):
    """An interaction whose result later sums know of their particle, as `own.prepared`, and that says how good it is.

    The first number of the result is its quality, between 0, where neighbours are too few or too uneven, and about 1.
    It depends on the particles and their volumes alone. Most are what `finish` makes of the sum; one of
    `NormalEquations` is solved for many particles at once. An interaction without a quality can be prepared too, where
    its `finish` has an answer whatever the neighbours are.
    """

    @property
    def least_quality(self) -> float:
        """The quality that a particle's result must be above, or it is deficient."""


class NormalEquations(Sum, ABC):
    """A preparation whose sums are the moments of a weighted fit, M c = b, one symmetric system for each particle.

    The result is the quality, M's smallest pivot after it is scaled to a unit diagonal, and c.
    """

    least_quality: float

    @abstractmethod
    def pair(self, own: Any, other: Any, d: tuple[Any, ...], r2: Any) -> tuple[Any, ...]:
        """One neighbour's part of the moments, each once."""

    @abstractmethod
    def template(self, dimension: int) -> Any:
        """The form of the result, a structure of the quality and c."""

    @abstractmethod
    def normal_equations(self, dimension: int) -> tuple[Array, Array]:
        """The number of the moment that each entry of M is, (n, n), and b, (n,), the same for all particles."""


def form_of(preparation: Interaction, dimension: int, sums: Any) -> Any:
    """The structure of a particle's result: that of its sums, or of the solution of their equations."""
    return preparation.template(dimension) if isinstance(preparation, NormalEquations) else sums
