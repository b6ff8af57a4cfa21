"""Wall particles, and the fields of the fluid before a wall that they take behind it."""

from __future__ import annotations

from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from scipy.sparse import csr_array
from scipy.spatial import cKDTree

from sphear.boundaries.continuations import Mirror, Shearless
from sphear.boundaries.models import WallModel
from sphear.boundaries.models.wall_fit import WallFit, WallWeights
from sphear.boundaries.shapes import Dummies
from sphear.boundaries.shapes.base import slipping
from sphear.engine.formula import Interaction
from sphear.interactions.normal_derivative import NormalFit, NormalWeights
from sphear.interactions.point_fit import LEAST_PIVOT, PointFit, PointWeights
from sphear.kernels import Kernel
from sphear.neighbours import Domain
from sphear.neighbours.points import sorted_particles
from sphear.schemes.incompressible.free_surface import wetted
from sphear.schemes.incompressible.wall_rows import FittedRows

Array = np.ndarray[Any, Any]

NORMAL_REACH, CONTINUATION_REACH = 3.0, 3.5  # spacings: some 20 particles before a wall for a parabola
EQUAL = 1e-6  # spacings by which two distances may differ that are the same
THIN = 0.03  # of a plane's fit over its weights, in smoothing lengths squared: that of two rows is four times that


class WallInterpolation(NamedTuple):
    """Fields of wall particles as sums over the fluid, one row (W, N) a wall particle.

    mirrored: the value where the wall model takes it, at a mirror point or around the particle.
    continued: u - u_wall, from u_fluid - u_wall; None where it is the opposite of the mirrored.
    """

    mirrored: csr_array
    continued: csr_array | None


class Walls:
    """Wall particles at rest: S on the walls, the others, dummies, behind them; W in all.

    Args:
        dummies: the wall particles; those of depth 0 are on the walls and come first.
        spacing: of the particles.
        kernel: of the scheme, of which the fits take their form.
        domain: with its periodic axes.
        model: how they take fields of the fluid.
        free_surface: the fluid ends at its own surface too: fits that would reach far beyond it are avoided.
        accelerations: (W, d), of the walls at the feet, which have some where they turn; None is none.
        curvatures: (W,), of the walls at the feet, positive around fluid; None is none.
        threads: to compute on.
    """

    def __init__(
        self,
        dummies: Dummies,
        spacing: float,
        kernel: Kernel,
        domain: Domain | None,
        model: WallModel,
        free_surface: bool = False,
        accelerations: Array | None = None,
        curvatures: Array | None = None,
        threads: int = 1,
    ) -> None:
        self.dummies, self.spacing, self.domain, self.model = dummies, spacing, domain, model
        self.threads = threads
        self.count = len(dummies.positions)
        self.on_wall = int((dummies.depths <= 0).sum())
        self.depths, self.normals, self.slips = dummies.depths, dummies.normals, slipping(dummies.velocities)
        self.velocities = np.where(self.slips[:, None], 0.0, dummies.velocities)
        self.accelerations = np.zeros_like(dummies.velocities) if accelerations is None else accelerations
        self.curvatures = np.zeros(self.count) if curvatures is None else curvatures
        self.feet = dummies.feet
        self.images = self.feet + dummies.depths[:, None] * dummies.normals
        self.sampling = model.sampling(dummies, kernel, spacing)
        before = type(kernel)(CONTINUATION_REACH * spacing / kernel.support)
        deepest = float(dummies.depths.max(initial=0.0))
        self.reach = max(deepest + self.sampling.kernel.radius, before.radius)
        self._support = max(self.sampling.kernel.radius, before.radius)
        points, around, order = self.sampling
        fit = PointFit(around, order, THIN if free_surface else LEAST_PIVOT)
        self._mirrored = self._rows(points, around.radius, fit, PointWeights(around))
        self._continued = None
        if (curve := model.curve) is not None:
            self._continued = self._rows(self.feet, before.radius, WallFit(before, curve), WallWeights(before, curve))
        along = type(kernel)(NORMAL_REACH * spacing / kernel.support)
        on = dummies.positions[: self.on_wall]
        self._derivatives = self._rows(on, along.radius, NormalFit(along), NormalWeights(along), coincident=False)

    def interpolation(self, positions: Array, distances: Array) -> WallInterpolation:
        """The fields of wall particles from fluid at `positions` (N, d), so far from the walls (N,)."""
        near = np.flatnonzero(distances < self.reach).astype(np.int32)
        around = sorted_particles(positions[near], self._support, self.domain)
        fields = {"volume": self._volume(near), "depth": distances[near]}
        mirrored = self._mirrored.matrix(around, fields, near, len(positions), self.threads)
        if self._continued is None:
            return WallInterpolation(mirrored, None)
        continued = self._continued.matrix(around, fields, near, len(positions), self.threads)
        return WallInterpolation(mirrored, continued)

    def wetted(self, positions: Array, distances: Array) -> Array:
        """(W,), the share of wall particles that stand for fluid at `positions` (N, d), so far from walls (N,)."""
        near = positions[distances < self.reach]
        fluid = near if self.domain is None else self.domain.with_images(near, self.reach)[0]
        return wetted(self.images, fluid, self.spacing)

    def _volume(self, particles: Array) -> Array:
        return np.full(len(particles), self.spacing ** self.normals.shape[1])

    def _rows(
        self, points: Array, support: float, fit: Interaction, weights: Interaction, coincident: bool = True
    ) -> FittedRows:
        count = len(points)
        fields = {"volume": np.zeros(count), "depth": self.depths[:count], "normal": self.normals[:count]}
        points = points if self.domain is None else self.domain.wrapped(points)
        return FittedRows(points, support, fit, weights, fields, coincident)

    def continued(self, interpolation: WallInterpolation, velocities: Array) -> Array:
        """(N + W, d): the fluid's velocities, and behind walls those that give the wall's velocity on it.

        Behind walls that fluid slips along they are mirrored, so that nothing is sheared there.
        """
        behind = self.model.continued(self, interpolation, velocities)
        if self.slips.any():
            behind = np.where(self.slips[:, None], self._sheared_by_nothing(interpolation, velocities), behind)
        return np.concatenate((velocities, behind))

    def _sheared_by_nothing(self, interpolation: WallInterpolation, velocities: Array) -> Array:
        """(W, d): velocities behind walls that no shear stress is on.

        Along a straight wall they are the fluid's; along a circle they grow with the distance from its centre, as where
        fluid turns with it.
        """
        behind = self.slipping(interpolation, velocities)[len(velocities) :]
        across = np.einsum("wd,wd->w", behind, self.normals)[:, None] * self.normals
        along = Shearless.behind(behind - across, (self.curvatures * self.depths)[:, None])
        result: Array = across + along
        return result

    def slipping(self, interpolation: WallInterpolation, velocities: Array, since: float = 0.0) -> Array:
        """(N + W, d): behind walls the velocity along the wall is the fluid's, that across it the opposite.

        Args:
            interpolation: of the fluid's fields.
            velocities: (N, d), along the walls a time `since` after the particles were here.
            since: across walls that turn they then are, seen from here, that time times the walls' acceleration.
        """
        behind = interpolation.mirrored @ velocities
        wall = self.velocities + since * self.accelerations
        before, at_wall = (np.einsum("wd,wd->w", field, self.normals) for field in (behind, wall))
        across = np.where(self.depths > 0, Mirror.behind(at_wall, before), at_wall)
        return np.concatenate((velocities, behind + (across - before)[:, None] * self.normals))

    def even(self, interpolation: WallInterpolation, field: Array) -> Array:
        """(N + W, ...): a field that is the same on both sides of walls."""
        return np.concatenate((field, interpolation.mirrored @ field))

    @cached_property
    def nearest_on_wall(self) -> csr_array:
        """(W, S): of each wall particle the one on the wall that is nearest, or the mean of those equally near."""
        if not self.on_wall:
            return csr_array((self.count, 0))
        points, source = self.dummies.positions[: self.on_wall], np.arange(self.on_wall)
        if self.domain is not None:
            points, source = self.domain.with_images(points, self.reach)
        tree = cKDTree(points)
        distance = np.asarray(tree.query(self.feet)[0])
        listed = tree.query_ball_point(self.feet, distance + EQUAL * self.spacing)
        numbers = np.array([len(found) for found in listed])
        starts = np.concatenate(([0], np.cumsum(numbers)))
        column = np.concatenate([np.sort(source[found]) for found in listed])
        return csr_array((np.repeat(1.0 / numbers, numbers), column, starts), shape=(self.count, self.on_wall))

    def normal_derivatives(self, positions: Array, column: Array, columns: int) -> csr_array:
        """The rows (S, columns) of n . grad f at the particles on walls, from them and the fluid, by SFDI.

        Args:
            positions: (N, d), of the fluid.
            column: (N + S,), of each particle, those on walls last.
            columns: their number.
        """
        on = self.dummies.positions[: self.on_wall]
        everything = np.concatenate((positions, on))
        around = sorted_particles(everything, self._derivatives.support, self.domain)
        volume = self._volume(everything)
        return self._derivatives.matrix(around, {"volume": volume}, column, columns, self.threads)
