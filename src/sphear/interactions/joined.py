"""Several sums over the same neighbours, in one sweep."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import Scalar, Vector


@dataclass(frozen=True)
class Joined:
    """Sums that are made together, of which the result is the tuple of their results.

    Parts need not know of each other: what is equal in them, such as the kernel, the trace records once.
    """

    parts: tuple[Any, ...]

    def pair(self, own: Any, other: Any, d: Vector, r2: Scalar) -> Any:
        """The pair's part of each sum."""
        return tuple(part.pair(own, other, d, r2) for part in self.parts)

    def finish(self, own: Any, total: Any) -> Any:
        """The result of each."""
        return tuple(part.finish(own, sums) for part, sums in zip(self.parts, total, strict=True))
