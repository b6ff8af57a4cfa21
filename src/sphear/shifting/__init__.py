"""Ways to keep particles evenly spread, by name."""

from __future__ import annotations

from sphear.names import Registry
from sphear.shifting.base import ShiftingMethod
from sphear.shifting.lind import Lind
from sphear.shifting.none import NoShifting
from sphear.shifting.xu import Xu

SHIFTING: Registry[ShiftingMethod] = Registry("shifting")
for _method in (NoShifting(), Lind(), Xu()):
    SHIFTING.add(_method.name, _method, _method.aliases)
SHIFTING.open()

__all__ = ["SHIFTING", "Lind", "NoShifting", "ShiftingMethod", "Xu"]
