"""Consistency corrections of the kernel and its derivatives."""

from __future__ import annotations

from sphear.corrections.base import Correction
from sphear.corrections.bonet_lok import BonetLok
from sphear.corrections.moving_least_squares import MovingLeastSquares
from sphear.corrections.none import NoCorrection
from sphear.corrections.renormalised import Renormalised
from sphear.corrections.shepard import Shepard
from sphear.names import Registry

CORRECTIONS: Registry[Correction] = Registry("correction")
for _correction in (NoCorrection(), Shepard(), BonetLok(), Renormalised()):
    CORRECTIONS.add(_correction.name, _correction, _correction.aliases)
CORRECTIONS.open()

# of values at points only, by name and alias
VALUE_CORRECTIONS = {name: MovingLeastSquares() for name in (MovingLeastSquares.name, *MovingLeastSquares.aliases)}

__all__ = [
    "CORRECTIONS", "VALUE_CORRECTIONS", "BonetLok", "Correction", "MovingLeastSquares", "NoCorrection", "Renormalised",
    "Shepard",
]  # fmt: skip
