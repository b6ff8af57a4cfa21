"""Velocities of a flow between its particles."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from sphear.schemes.flow import Flow

Array = np.ndarray[Any, Any]

REACH = 2.6  # spacings: some 20 particles for the 6 coefficients of a parabola


def interpolated(flow: Flow, points: Array) -> Array:
    """The velocity at points (M, 2), (M, 2): the value there of the parabola that fits the particles around best.

    Weights fall with the distance. Exact for quadratic fields, so that a profile is not smeared by reading it off.
    """
    spacing = flow.problem.spacing
    tree = cKDTree(flow.positions)
    found = np.empty((len(points), flow.velocities.shape[1]))
    for row, point in enumerate(points):
        near = np.array(tree.query_ball_point(point, REACH * spacing))
        if len(near) < 12:  # near a corner, or where particles have left a hole
            near = np.asarray(tree.query(point, k=12)[1])
        d = (flow.positions[near] - point) / spacing
        weight = np.exp(-0.5 * (d**2).sum(axis=1))
        basis = np.stack((np.ones(len(d)), d[:, 0], d[:, 1], d[:, 0] ** 2, d[:, 0] * d[:, 1], d[:, 1] ** 2), axis=1)
        fit = np.linalg.lstsq(weight[:, None] * basis, weight[:, None] * flow.velocities[near], rcond=None)[0]
        found[row] = fit[0]
    return found
