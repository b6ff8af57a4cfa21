"""Diagnostics of an incompressible flow, by which it is still one: divergence, density, distances of particles."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial import cKDTree

if TYPE_CHECKING:
    from sphear.schemes.incompressible.flow import IncompressibleFlow


def diagnostics(flow: IncompressibleFlow) -> dict[str, float]:
    """The state of the particles and of the last projection.

    - energy_residual, energy_created: of the energy budget, see `sphear.schemes.energy`.
    - pressure_iterations, pressure_residual: of the last solve.
    - divergence: the mean of |div u|, times length over speed.
    - density_deviation: the root mean square of the number density over that of a lattice, minus 1.
    - smallest_distance: of two particles, in spacings; 1 on a lattice.
    - largest_gap: the largest distance of a point of the fluid from the nearest particle, in spacings; 0.71 on a
      lattice.
    """
    problem, dx = flow.problem, flow.problem.spacing
    operators = flow.discretisation.at(flow.x)
    divergence = operators.divergence(operators.divergent(flow.u))
    tree = cKDTree(_with_images(flow))
    domain = flow.discretisation.domain
    nearest = np.asarray(tree.query(flow.x if domain is None else domain.wrapped(flow.x), k=2)[0])[:, 1]
    return {
        "energy_residual": flow.energy_budget.residual(flow.u),
        "energy_created": flow.energy_budget.created(flow.u),
        "pressure_iterations": float(flow.pressures.iterations),
        "pressure_residual": float(flow.pressures.residual),
        "divergence": float(np.abs(divergence).mean() * problem.length / problem.speed),
        "density_deviation": float(np.sqrt(np.mean((operators.concentration() - 1.0) ** 2))),
        "smallest_distance": float(nearest.min() / dx),
        "largest_gap": _largest_gap(flow, tree),
    }


def _with_images(flow: IncompressibleFlow) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    domain, walls = flow.discretisation.domain, flow.discretisation.walls
    positions = flow.x if domain is None else domain.with_images(flow.x, 3.0 * flow.problem.spacing)[0]
    if walls is None:
        return positions
    behind = walls.dummies.positions[walls.on_wall :]
    return np.concatenate((positions, behind))


def _largest_gap(flow: IncompressibleFlow, tree: cKDTree) -> float:
    """On a grid of half a spacing over the fluid."""
    dx = flow.problem.spacing
    box = flow.problem.box
    ticks = [np.arange(low, high, 0.5 * dx) for low, high in zip(box.lower, box.upper, strict=True)]
    points = np.stack(np.meshgrid(*ticks, indexing="ij"), axis=-1).reshape(-1, len(ticks))
    region = flow.discretisation.region
    if region is not None:
        points = points[region.distance(points) > 0]
    distance = np.asarray(tree.query(points)[0])
    if flow.problem.free_surface:  # the air is no gap
        distance = distance[distance < 2.0 * dx]
    return float(distance.max() / dx)
