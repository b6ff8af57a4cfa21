"""Wall models: how walls enter the sums and the pressure equation of the incompressible scheme, by name."""

from __future__ import annotations

from sphear.boundaries.models.adami_dummies import AdamiDummies
from sphear.boundaries.models.base import WallModel
from sphear.boundaries.models.mirror_points import MirrorPoints
from sphear.boundaries.models.natural import Natural
from sphear.boundaries.models.sfdi import SFDI
from sphear.names import Registry

WALL_MODELS: Registry[WallModel] = Registry("wall model")
for _model in (MirrorPoints(), AdamiDummies(), SFDI(), Natural()):
    WALL_MODELS.add(_model.name, _model, _model.aliases)
WALL_MODELS.open()

__all__ = ["SFDI", "WALL_MODELS", "AdamiDummies", "MirrorPoints", "Natural", "WallModel"]
