"""Particles on the walls whose own equation is the wall's condition, by SFDI (Zheng, Ma & Shao 2018)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from sphear.boundaries.models.base import FIRST_ROW, WallModel

if TYPE_CHECKING:
    from scipy.sparse import csr_array

    from sphear.boundaries.models.base import Array
    from sphear.boundaries.shapes import Dummies
    from sphear.neighbours import Domain
    from sphear.schemes.incompressible.walls import WallInterpolation, Walls

TOO_NEAR = 0.3  # spacings between particles on walls; those in right corners are half of one from the next


@dataclass(frozen=True)
class SFDI(WallModel):
    """Particles on the wall have the row n . grad p = rho n . a, by simplified finite difference interpolation.

    Dummy particles behind them have the pressure of the nearest, continued over their depth.

    Examples:
        >>> import sphear
        >>> print(sphear.Incompressible(walls=sphear.SFDI()))
        Incompressible(walls='sfdi')
    """

    name = "sfdi"
    aliases = ("ma",)
    formula = "n . grad p = rho n . a at particles on the wall; p_w = p(nearest on the wall) - depth n . grad p"
    source = "Zheng, Ma & Shao 2018, section 2; Ma 2008, CMES 23:75"
    surface_fault = "needs fluid before every wall"

    def wall_particles(self, behind: Dummies, spacing: float, window: Domain) -> Dummies:
        """The dummies after particles on the walls, at the feet of the first row, each some way from the others."""
        import numpy as np  # takes long, as what is imported below: models are listed without it
        from scipy.spatial import cKDTree

        first = behind.depths < FIRST_ROW * spacing
        feet, normals, velocities = behind.feet[first], behind.normals[first], behind.velocities[first]
        feet = window.wrapped(feet)
        images, source = window.with_images(feet, spacing)
        taken, kept = np.zeros(len(feet), bool), []
        for k, listed in enumerate(cKDTree(images).query_ball_point(feet, TOO_NEAR * spacing)):
            if taken[k]:
                continue
            near = source[listed]
            taken[near] = True  # in a corner the feet of several are one, which faces as they do in the mean
            mean = normals[near].mean(axis=0)
            length = np.hypot(*mean)
            normals[k] = mean / length if length > 0 else normals[k]
            kept.append(k)
        return behind._replace(
            positions=np.concatenate((feet[kept], behind.positions)),
            depths=np.concatenate((np.zeros(len(kept)), behind.depths)),
            normals=np.concatenate((normals[kept], behind.normals)),
            velocities=np.concatenate((velocities[kept], behind.velocities)),
        )

    def own_pressures(self, walls: Walls) -> int:
        """S, the number of particles on walls."""
        return walls.on_wall

    def jump(self, walls: Walls, accelerations: Array, density: float, way: Array) -> Array:
        """(W - S,), of the dummies: the pressure on the wall is continued, over the depth."""
        return super().jump(walls, accelerations, density, walls.depths[:, None] * walls.normals)[walls.on_wall :]

    def pressure_weights(
        self, walls: Walls, interpolation: WallInterpolation, column: Array, unknowns: int
    ) -> csr_array | None:
        """(W - S, unknowns): the pressure of the nearest particle on the wall."""
        import numpy as np
        from scipy.sparse import csr_array

        behind = walls.nearest_on_wall[walls.on_wall :]
        nearest = (behind.indices + (column.size - walls.count)).astype(np.int32)
        starts = behind.indptr.astype(np.int32)
        return csr_array((behind.data, nearest, starts), shape=(behind.shape[0], unknowns))

    def pressures_behind(
        self, walls: Walls, interpolation: WallInterpolation, fluid: Array, on_walls: Array, jump: Array
    ) -> Array:
        """(W,): of particles on walls their own, of dummies that of the nearest with its jump."""
        if not walls.on_wall:
            return super().pressures_behind(walls, interpolation, fluid, on_walls, jump)
        behind: Array = walls.nearest_on_wall @ on_walls
        behind[walls.on_wall :] += jump
        return behind

    def own_equations(self, walls: Walls, fluid: Array, unknown: Array) -> csr_array:
        """(S, N + S), n . grad p, over the spacing, so that all rows are of one size."""
        import numpy as np
        from scipy.sparse import csr_array

        count, on = len(fluid), walls.on_wall
        derivative = csr_array(walls.normal_derivatives(fluid, unknown[: count + on], count + on) / walls.spacing)
        total: Array = np.asarray(derivative.sum(axis=1)).ravel()
        if (wrong := total <= 0.0).any():  # in a narrow corner the plane may be no plane: a mean will do
            listed = np.repeat(wrong, np.diff(derivative.indptr))
            derivative.data[listed] = np.abs(derivative.data[listed])
            total = np.asarray(derivative.sum(axis=1)).ravel()
        own = csr_array((-total, np.arange(count, count + on), np.arange(on + 1)), shape=(on, count + on))
        return csr_array(derivative + own)
