"""The right-hand side of a flow in one sweep: what changes velocity, density, energy and place of a particle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

from sphear.algebra import Scalar, Vector, add

ROLES = ("velocity", "density", "energy", "drift", "density_gradient")


@dataclass(frozen=True)
class Part:
    """A contribution to the rate of one variable.

    Attributes:
        role: which of `ROLES` it changes.
    """

    role: ClassVar[str]

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> tuple[Vector, Any]:
        """The pair's part of the rate, and further sums (a nested tuple) that `finish` needs."""
        raise NotImplementedError

    def finish(self, own: Any, sums: Any) -> Vector | None:
        """The rate that the further sums and the particle itself add; None if nothing."""
        return None


@dataclass(frozen=True)
class Rates:
    """The sum of several parts, those of one role added up pair by pair.

    Its result is a tuple of vectors, one for each role that occurs, in the order of `ROLES`. The parts of a pair share
    the kernel, its correction and whatever else is equal in them: the trace records it once.
    """

    parts: tuple[Part, ...]

    @property
    def roles(self) -> tuple[str, ...]:
        """The roles that occur."""
        return tuple(role for role in ROLES if any(part.role == role for part in self.parts))

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """The sums of each role, and the further ones of each part."""
        totals: dict[str, Vector] = {}
        further = []
        for part in self.parts:
            rate, sums = part.pair(own, other, d, r2)
            totals[part.role] = add(totals[part.role], rate) if part.role in totals else rate
            further.append(sums)
        return tuple(totals[role] for role in self.roles), tuple(further)

    def finish(self, own: Any, total: Any) -> Any:
        """The rates."""
        totals = dict(zip(self.roles, total[0], strict=True))
        for part, sums in zip(self.parts, total[1], strict=True):
            rest = part.finish(own, sums)
            if rest is not None:
                totals[part.role] = add(totals[part.role], rest)
        return tuple(totals[role] for role in self.roles)
