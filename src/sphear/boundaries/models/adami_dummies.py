"""Dummy particles with the mean of the fluid around them (Adami, Hu & Adams 2012)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from sphear.boundaries.models.base import Array, Sampling, WallModel
from sphear.kernels import Kernel

if TYPE_CHECKING:
    from sphear.boundaries.shapes import Dummies
    from sphear.schemes.incompressible.walls import WallInterpolation, Walls


@dataclass(frozen=True)
class AdamiDummies(WallModel):
    """Dummy particles have the mean pressure of the fluid around them, continued by the normal gradient.

    Examples:
        >>> import sphear
        >>> print(sphear.Incompressible(walls=sphear.AdamiDummies()))
        Incompressible(walls='adami')
    """

    name = "adami"
    aliases = ("adami_dummies",)
    formula = "p_w = sum_f W_wf (p_f + rho a . (r_w - r_f)) / sum_f W_wf"
    source = "Adami, Hu & Adams 2012, J. Comput. Phys. 231:7057, eq. 27"

    def sampling(self, behind: Dummies, kernel: Kernel, spacing: float) -> Sampling:
        """The mean around the dummies themselves: one that is a neighbour of the fluid has fluid around it."""
        return Sampling(behind.positions, kernel, 0)

    def way(self, walls: Walls, interpolation: WallInterpolation, positions: Array) -> Array:
        """(W, d): from dummies to the middle of the fluid around them, in corners aside of the wall."""
        weights = interpolation.mirrored
        wall = np.repeat(np.arange(walls.count), np.diff(weights.indptr))
        way = positions[weights.indices] - walls.dummies.positions[wall]
        if walls.domain is not None:
            way = walls.domain.shortest(way)
        columns = [np.bincount(wall, weights.data * part, walls.count) for part in way.T]
        return np.stack(columns, axis=1)
