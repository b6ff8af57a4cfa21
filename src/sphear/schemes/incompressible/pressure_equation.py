"""The pressure equation of a projection step."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy.sparse import csr_array

from sphear.boundaries import Box
from sphear.corrections import NoCorrection
from sphear.interactions.free_surface import LaplacianMoments
from sphear.interactions.laplacian_weights import LaplacianWeights
from sphear.kernels import Kernel
from sphear.pressure import PressureSystem
from sphear.pressure.pair_rows import PairRows, WallRows
from sphear.schemes.incompressible.free_surface import Surface
from sphear.schemes.incompressible.particle_sums import ParticleSums
from sphear.schemes.incompressible.surface_pressure import missing_weights
from sphear.schemes.incompressible.walls import WallInterpolation, Walls
from sphear.viscosity.base import LaplacianTerm

Array = np.ndarray[Any, Any]


class PressureEquation(NamedTuple):
    """A pressure equation, its unknowns in the order of the cells.

    system: the matrix.
    rows: it, as a solver has it.
    order: (N,), the particle of each row; particles on walls follow.
    """

    system: PressureSystem
    rows: PairRows
    order: Array


class PressureAssembly:
    """Puts the pressure equation together, step by step.

    Args:
        term: its Laplacian.
        kernel: with its smoothing length.
        walls: that enter it by their model; None without walls.
        box: around the fluid.
        spacing: of the particles.

    Attributes:
        on_wall: S, the number of wall particles with a pressure of their own.
    """

    def __init__(self, term: LaplacianTerm, kernel: Kernel, walls: Walls | None, box: Box, spacing: float) -> None:
        self.weights = LaplacianWeights(term, kernel, NoCorrection())
        self.moments = LaplacianMoments(term, kernel, NoCorrection())
        self.preparation = term.preparation(kernel, NoCorrection())
        self.walls, self.box, self.spacing = walls, box, spacing
        self.periodic = box.periodic
        pairwise = self.preparation is None
        self.symmetric = pairwise and (walls is None or walls.model.symmetric)
        self.on_wall = 0 if walls is None else walls.model.own_pressures(walls)

    def jump(self, accelerations: Array, density: float, way: Array) -> Array:
        """(W - S,), p_w minus the pressure it is continued from, by the wall model; (0,) where there is none.

        Args:
            accelerations: (W, d), grad p over the density: that the pressure balances at the walls.
            density: of the fluid.
            way: (W, d), from wall particles to where fields are taken for them.
        """
        walls = self.walls
        return np.zeros(0) if walls is None else walls.model.jump(walls, accelerations, density, way)

    def equation(
        self, particles: ParticleSums, interpolation: WallInterpolation | None, jump: Array, surface: Surface | None
    ) -> PressureEquation:
        """The equation of particles at one moment.

        Args:
            particles: of fluid and walls.
            interpolation: the fields of wall particles from the fluid; None without walls.
            jump: of pressures behind walls.
            surface: the free surface; None without one.
        """
        count, order = particles.count, particles.neighbours.rows
        walls, unknown = self.walls, self._unknown(particles)
        outside, fixed = np.zeros(count), np.zeros(count + self.on_wall, np.bool_)
        if surface is not None:
            outside = missing_weights(particles, surface, self.moments, self.preparation)[order]
            fixed[:count] = surface.alone[order]
        behind = self._behind(interpolation, unknown, count)
        if not len(jump):
            jump = np.zeros(len(behind.starts) - 1)
        positions, others = np.take(particles.positions, order, axis=0), None
        if walls is not None and self.on_wall:
            others = walls.model.own_equations(walls, particles.positions[:count], unknown)
            positions = np.concatenate((positions, walls.dummies.positions[: self.on_wall]))
        rows = self._rows(particles, unknown, behind, jump=jump, fixed=fixed, outside=outside, others=others)
        neutral = not (fixed.any() or outside.any())
        return PressureEquation(self._system(rows, positions, neutral), rows, order)

    def _unknown(self, particles: ParticleSums) -> Array:
        """(N + W,), the unknown of each particle, that of wall particles without one after all of them."""
        unknown = np.arange(particles.total, dtype=np.int32)
        unknown[particles.neighbours.rows] = np.arange(particles.count, dtype=np.int32)
        return unknown

    def _behind(self, interpolation: WallInterpolation | None, unknown: Array, count: int) -> WallRows:
        """The pressures of the W - S wall particles without one of their own, by the unknowns.

        Rows are empty where the wall model leaves walls out.
        """
        walls, unknowns = self.walls, count + self.on_wall
        if walls is not None and interpolation is not None:
            mirrored = walls.model.pressure_weights(walls, interpolation, unknown, unknowns)
            if mirrored is not None:
                return WallRows(mirrored.indptr, mirrored.indices, mirrored.data)
        return WallRows(np.zeros(len(unknown) - unknowns + 1, np.int32), np.zeros(0, np.int32), np.zeros(0))

    def _rows(self, particles: ParticleSums, unknown: Array, behind: WallRows, **others: Any) -> PairRows:
        """The Laplacian as rows over the pair list; `others` are further arguments of `PairRows`."""
        neighbours = particles.neighbours
        return PairRows(
            neighbours.chunks,
            particles.weights(self.weights, self.preparation),
            unknown[neighbours.source],
            behind,
            threads=neighbours.threads,
            **others,
        )

    def _system(self, rows: PairRows, positions: Array, singular: bool) -> PressureSystem:
        box = self.box
        return PressureSystem(
            rows, positions, box.lower, box.upper, box.periodic, self.spacing, self.symmetric, singular
        )

    def wall_coupling(self, equation: PressureEquation) -> csr_array:
        """(N, W - S), what the jumps of pressures behind walls add to the matrix's side of an equation."""
        coupling = csr_array(equation.rows.by_pairs()[:, equation.rows.unknowns :])
        coupling.eliminate_zeros()
        return coupling

    def velocity_system(
        self, particles: ParticleSums, interpolation: WallInterpolation | None, shift: float
    ) -> PressureSystem:
        """The same Laplacian of a velocity that walls hold, less a number on its diagonal, in the order of the cells.

        Args:
            particles: of fluid and walls.
            interpolation: the fields of wall particles from the fluid; None without walls.
            shift: the number.
        """
        count, unknown = particles.count, self._unknown(particles)
        behind = particles.total - count
        opposite = WallRows(np.zeros(behind + 1, np.int32), np.zeros(0, np.int32), np.zeros(0))
        if interpolation is not None:
            mirrored = interpolation.mirrored
            opposite = WallRows(mirrored.indptr, unknown[mirrored.indices], -mirrored.data)
        rows = self._rows(
            particles,
            unknown,
            opposite,
            jump=np.zeros(behind),
            fixed=np.zeros(count, np.bool_),
            outside=np.full(count, -shift),
        )
        return self._system(rows, np.take(particles.positions, particles.neighbours.rows, axis=0), False)
