"""The pressure equation of a projection step."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from scipy.sparse import csr_array, vstack

from sphear.boundaries import Box
from sphear.corrections import NoCorrection
from sphear.interactions.free_surface import LaplacianMoments
from sphear.interactions.laplacian_weights import LaplacianWeights
from sphear.kernels import Kernel
from sphear.pressure import PressureSystem
from sphear.pressure.assembly import eliminated
from sphear.schemes.incompressible.free_surface import Surface
from sphear.schemes.incompressible.places import Places
from sphear.schemes.incompressible.surface_pressure import missing_weights
from sphear.schemes.incompressible.walls import WallRows, Walls
from sphear.viscosity.base import LaplacianTerm

Array = np.ndarray[Any, Any]


class Equation(NamedTuple):
    """A pressure equation, its unknowns in the order of the cells.

    system: the matrix.
    known: what the walls' normal gradients add to the matrix's side.
    order: (N,), the particle of each row; particles on walls follow.
    weights: (N, unknowns + W), of pairs, walls not yet eliminated.
    mirrored: (W, unknowns), the pressures behind walls; None where they are left out.
    """

    system: PressureSystem
    known: Array
    order: Array
    weights: csr_array
    mirrored: csr_array | None


class PressureRows:
    """How the pressure equation is put together, step by step.

    Args:
        term: its Laplacian.
        kernel: with its smoothing length.
        walls: None without walls.
        wall_model: how walls enter it, see `Incompressible`.
        box: around the fluid.
        spacing: of the particles.
    """

    def __init__(
        self,
        term: LaplacianTerm,
        kernel: Kernel,
        walls: Walls | None,
        wall_model: str,
        box: Box,
        spacing: float,
    ) -> None:
        self.weights = LaplacianWeights(term, kernel, NoCorrection())
        self.moments = LaplacianMoments(term, kernel, NoCorrection())
        self.preparation = term.preparation(kernel, NoCorrection())
        self.walls, self.wall_model, self.box, self.spacing = walls, wall_model, box, spacing
        self.periodic = box.periodic
        pairwise = self.preparation is None
        self.symmetric = pairwise and (walls is None or wall_model == "natural")
        self.on_wall = walls.on_wall if walls is not None and wall_model == "sfdi" else 0
        self.nearest = walls.nearest_on_wall() if self.on_wall and walls is not None else None

    def jump(self, accelerations: Array, density: float, ways: Array) -> Array:
        """(W,), p_w minus the pressure it is continued from, -w . grad p over the way w between the two.

        Args:
            accelerations: (W, d), grad p over the density: that the pressure balances at the walls.
            density: of the fluid.
            ways: (W, d), w of mirrored pressures; with sfdi the wall's is continued, over the depth.
        """
        walls = self.walls
        if walls is None or self.wall_model == "natural":
            return np.zeros(0)
        if self.wall_model == "sfdi":
            ways = walls.depths[:, None] * walls.normals
        jump: Array = -density * (accelerations * ways).sum(axis=1)
        return jump[self.on_wall :] if self.wall_model == "sfdi" else jump

    def equation(self, places: Places, rows: WallRows | None, jump: Array, found: Surface | None) -> Equation:
        """The equation at these places.

        Args:
            places: of fluid and walls.
            rows: what the fluid says of the walls' fields.
            jump: of pressures behind walls.
            found: the free surface; None without one.
        """
        count, order = places.count, places.neighbours.rows
        unknowns = count + self.on_wall
        column = np.arange(places.total, dtype=np.int32)
        column[order] = np.arange(count, dtype=np.int32)
        weights = places.matrix(self.weights, self.preparation, column, places.total)
        mirrored = self._mirrored(rows, column, unknowns)
        fixed = np.zeros(unknowns, np.bool_)
        outside = np.zeros(count)
        if found is not None:
            outside = missing_weights(places, found, self.moments, self.preparation)
            fixed[:count] = found.alone[order]
        matrix, known = eliminated(weights, mirrored, jump, fixed, unknowns)
        matrix.data[matrix.indptr[:count]] += outside[order]  # the diagonal comes first
        positions = places.positions[order]
        if self.on_wall and self.walls is not None:
            matrix, positions = self._with_walls(matrix, positions, places, column)
            known = np.concatenate((known, np.zeros(self.on_wall)))
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
        return Equation(system, known, order, weights, mirrored)

    def wall_coupling(self, equation: Equation) -> csr_array:
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

    def velocity_matrix(self, equation: Equation, rows: WallRows | None) -> csr_array:
        """(N, N), the same Laplacian of a velocity that walls hold, in the order of the equation."""
        count = equation.weights.shape[0]
        column = np.empty(count, np.int32)
        column[equation.order] = np.arange(count, dtype=np.int32)
        opposite = None
        if rows is not None:
            mirrored = rows.mirrored
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

    def _mirrored(self, rows: WallRows | None, column: Array, unknowns: int) -> csr_array | None:
        """The pressures behind walls as sums over the unknowns."""
        if rows is None or self.walls is None or self.wall_model == "natural":
            return None
        if self.wall_model == "sfdi":
            assert self.nearest is not None
            behind = self.nearest[self.on_wall :]
            places = (behind.indices + (column.size - self.walls.count)).astype(np.int32)
            starts = behind.indptr.astype(np.int32)
            return csr_array((behind.data, places, starts), shape=(behind.shape[0], unknowns))
        mirrored = rows.mirrored
        return csr_array(
            (mirrored.data, column[mirrored.indices], mirrored.indptr), shape=(mirrored.shape[0], unknowns)
        )

    def _with_walls(
        self, matrix: csr_array, positions: Array, places: Places, column: Array
    ) -> tuple[csr_array, Array]:
        """The rows of the particles on walls below: n . grad p, over the spacing, so that all rows are of one size."""
        assert self.walls is not None
        count, on = places.count, self.on_wall
        fluid = places.positions[:count]
        derivative = csr_array(self.walls.normal_derivatives(fluid, column[: count + on], count + on) / self.spacing)
        total: Array = np.asarray(derivative.sum(axis=1)).ravel()
        if (wrong := total <= 0.0).any():  # in a narrow corner the plane may be no plane: a mean will do
            listed = np.repeat(wrong, np.diff(derivative.indptr))
            derivative.data[listed] = np.abs(derivative.data[listed])
            total = np.asarray(derivative.sum(axis=1)).ravel()
        own = csr_array((-total, np.arange(count, count + on), np.arange(on + 1)), shape=(on, count + on))
        whole = vstack((matrix, derivative + own), format="csr")
        return csr_array(whole), np.concatenate((positions, self.walls.dummies.positions[:on]))
