"""The words that all wall models have, of whatever scheme."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar


@dataclass(frozen=True)
class AnyWallModel:
    """A way to compute walls: a `WallModel` in the incompressible scheme, an `ExplicitWallModel` in the explicit."""

    name: ClassVar[str] = "unnamed"
    aliases: ClassVar[tuple[str, ...]] = ()
    formula: ClassVar[str] = "not stated"
    source: ClassVar[str] = "not stated"

    @property
    def said(self) -> str:
        """The name, or that of the class where it has none."""
        return self.name if self.name != "unnamed" else type(self).__name__
