"""Wall models: how walls enter the sums of a scheme and the pressure equation of the incompressible one, by name."""

from __future__ import annotations

from sphear.boundaries.models.adami_dummies import AdamiDummies
from sphear.boundaries.models.any_model import AnyWallModel
from sphear.boundaries.models.base import WallModel
from sphear.boundaries.models.explicit import ExplicitWallModel
from sphear.boundaries.models.fixed_particles import FixedParticles
from sphear.boundaries.models.mirror_particles import MirrorParticles
from sphear.boundaries.models.mirror_points import MirrorPoints
from sphear.boundaries.models.natural import Natural
from sphear.boundaries.models.sfdi import SFDI
from sphear.names import Registry

WALL_MODELS: Registry[AnyWallModel] = Registry("wall model")
for _model in (MirrorPoints(), AdamiDummies(), SFDI(), Natural(), MirrorParticles(), FixedParticles()):
    WALL_MODELS.add(_model.name, _model, _model.aliases)
WALL_MODELS.open()

__all__ = [
    "SFDI",
    "WALL_MODELS",
    "AdamiDummies",
    "AnyWallModel",
    "ExplicitWallModel",
    "FixedParticles",
    "MirrorParticles",
    "MirrorPoints",
    "Natural",
    "WallModel",
]
