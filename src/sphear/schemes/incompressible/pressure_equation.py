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
from sphear.pressure.assembly import eliminated
from sphear.schemes.incompressible.free_surface import Surface
from sphear.schemes.incompressible.particle_sums import ParticleSums
from sphear.schemes.incompressible.surface_pressure import missing_weights
from sphear.schemes.incompressible.walls import WallInterpolation, Walls
from sphear.viscosity.base import LaplacianTerm

Array = np.ndarray[Any, Any]


class PressureEquation(NamedTuple):
    """A pressure equation, its unknowns in the order of the cells.

    system: the matrix.
    jump_terms: what the walls' normal gradients add to the matrix's side.
    order: (N,), the particle of each row; particles on walls follow.
    weights: (N, unknowns + W), of pairs, walls not yet eliminated.
    mirrored: (W, unknowns), the pressures behind walls; None where they are left out.
    """

    system: PressureSystem
    jump_terms: Array
    order: Array
    weights: csr_array
    mirrored: csr_array | None


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
        unknowns = count + self.on_wall
        column = np.arange(particles.total, dtype=np.int32)
        column[order] = np.arange(count, dtype=np.int32)
        weights = particles.matrix(self.weights, self.preparation, column, particles.total)
        walls, mirrored = self.walls, None
        if walls is not None and interpolation is not None:
            mirrored = walls.model.pressure_weights(walls, interpolation, column, unknowns)
        fixed = np.zeros(unknowns, np.bool_)
        outside = np.zeros(count)
        if surface is not None:
            outside = missing_weights(particles, surface, self.moments, self.preparation)
            fixed[:count] = surface.alone[order]
        matrix, jump_terms = eliminated(weights, mirrored, jump, fixed, unknowns)
        matrix.data[matrix.indptr[:count]] += outside[order]  # the diagonal comes first
        positions = particles.positions[order]
        if walls is not None:
            matrix, positions = walls.model.wall_equations(
                walls, matrix, positions, particles.positions[:count], column
            )
            jump_terms = np.concatenate((jump_terms, np.zeros(self.on_wall)))
        system = PressureSystem(
            matrix,
            positions,
            self.box.lower,
            self.box.upper,
            self.periodic,
            self.spacing,
            self.symmetric,
            not (fixed.any() or outside.any()),
        )
        return PressureEquation(system, jump_terms, order, weights, mirrored)

    def wall_coupling(self, equation: PressureEquation) -> csr_array:
        """(N, W), what the jumps of pressures behind walls add to the matrix's side of an equation."""
        count, behind = equation.weights.shape[0], equation.mirrored
        if behind is None:
            return csr_array((count, 0))
        coupling = csr_array(equation.weights[:, equation.weights.shape[1] - behind.shape[0] :])
        seen = np.diff(behind.indptr) > 0
        # a row whose walls have been left out, as in a narrow corner, knows of no jump
        fixed, ones = np.zeros(behind.shape[1], np.bool_), np.ones(behind.shape[0])
        used = eliminated(equation.weights, behind, ones, fixed, behind.shape[1])[1] != 0.0
        rows = np.repeat(used, np.diff(coupling.indptr))
        coupling.data = np.where(rows & seen[coupling.indices], coupling.data, 0.0)
        coupling.eliminate_zeros()
        return coupling

    def velocity_matrix(self, equation: PressureEquation, interpolation: WallInterpolation | None) -> csr_array:
        """(N, N), the same Laplacian of a velocity that walls hold, in the order of the equation."""
        count = equation.weights.shape[0]
        column = np.empty(count, np.int32)
        column[equation.order] = np.arange(count, dtype=np.int32)
        opposite = None
        if interpolation is not None:
            mirrored = interpolation.mirrored
            opposite = csr_array(
                (-mirrored.data, column[mirrored.indices], mirrored.indptr), shape=(mirrored.shape[0], count)
            )
        matrix, _ = eliminated(
            equation.weights,
            opposite,
            np.zeros(0 if opposite is None else opposite.shape[0]),
            np.zeros(count, np.bool_),
            count,
        )
        return matrix
