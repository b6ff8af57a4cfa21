"""Velocities of a flow between its particles."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from sphear.schemes.base import Flow

Array = np.ndarray[Any, Any]

REACH = 2.6  # spacings: some 20 particles for the 6 coefficients of a parabola
LEAST = 12  # particles
DEFICIENT = 1e-8  # of singular values over the largest: some parabola vanishes at all particles, as on a circle


def interpolated(flow: Flow, points: Array) -> Array:
    """The velocity at points (M, 2), (M, 2): the value there of the parabola that fits the particles around best.

    Weights fall with the distance. Exact for quadratic fields, so that a profile is not smeared by reading it off.
    Where the particles around do not tell one parabola from another, those further away are asked too.
    """
    tree = cKDTree(flow.positions)
    return np.array([_at(point, flow, tree) for point in points]).reshape(len(points), flow.velocities.shape[1])


def _at(point: Array, flow: Flow, tree: Any) -> Array:
    reach = REACH
    while True:
        near = np.array(tree.query_ball_point(point, reach * flow.problem.spacing))
        if len(near) < LEAST:  # near a corner, or where particles have left a hole
            near = np.asarray(tree.query(point, k=min(LEAST, flow.count))[1])
        d = (flow.positions[near] - point) / flow.problem.spacing
        weight = np.exp(-0.5 * (REACH / reach) ** 2 * (d**2).sum(axis=1))[:, None]
        basis = np.stack((np.ones(len(d)), d[:, 0], d[:, 1], d[:, 0] ** 2, d[:, 0] * d[:, 1], d[:, 1] ** 2), axis=1)
        fit, _, rank, _ = np.linalg.lstsq(weight * basis, weight * flow.velocities[near], rcond=DEFICIENT)
        if rank == basis.shape[1] or len(near) == flow.count:
            return np.asarray(fit[0])
        reach *= 1.5
