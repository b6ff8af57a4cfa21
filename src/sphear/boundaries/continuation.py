"""Continuation of the velocity along a wall to the mirror particles behind it.

u(y) is the velocity along the wall at the distance y from it. Each rule finds a and b of u(y) = u_wall + a y + b y^2
for each wall, and a mirror particle at the depth y has u_wall - a y + b y^2; but `mirror` reflects each particle.
Basa, Quinlan & Lastiwka 2009, section 6.1.2 and figure 3.

Along a wall that ends at other walls, a and b vary: they are found at nodes along it, from the particles around each,
and taken linearly between. Along a periodic wall there is one node: the whole of it.
"""

from __future__ import annotations

import numpy as np

from sphear.engine.cache import compiled

PARABOLA = 3.0  # spacings from the wall within which particles decide on the parabola: three rows of them


@compiled
def node_along(place, along, lower, upper, nodes):  # type: ignore[no-untyped-def]
    """The node before a place, and the share of the one after it."""
    if along < 0 or nodes == 1:
        return 0, 0.0
    s = (place[along] - lower[along]) / (upper[along] - lower[along]) * (nodes - 1)
    s = min(max(s, 0.0), nodes - 1.0)
    node = min(int(s), nodes - 2)
    return node, s - node


@compiled
def mirror(x, v, lower, upper, axis, along, velocities, spacing, a, b):  # type: ignore[no-untyped-def]
    """Nothing to fit: a mirror particle has 2 u_wall - u of its own particle."""


@compiled
def linear(x, v, lower, upper, axis, along, velocities, spacing, a, b):  # type: ignore[no-untyped-def]
    """The line through the wall's velocity that fits the particles within one spacing of it best."""
    nodes, dimension = len(a), x.shape[1]
    yy = np.zeros((nodes, 2))
    a[:], b[:] = 0.0, 0.0
    for i in range(len(x)):
        for side in range(2):
            y = upper[axis] - x[i, axis] if side else x[i, axis] - lower[axis]
            if y < spacing:
                node, share = node_along(x[i], along, lower, upper, nodes)
                for n in range(2 if share > 0.0 else 1):
                    weight = share if n else 1.0 - share
                    yy[node + n, side] += weight * y * y
                    for k in range(dimension):
                        a[node + n, side, k] += weight * (v[i, k] - velocities[side, k]) * y
    for node in range(nodes):
        for side in range(2):
            for k in range(dimension):
                a[node, side, k] = a[node, side, k] / yy[node, side] if yy[node, side] > 0.0 else 0.0


@compiled
def quadratic(x, v, lower, upper, axis, along, velocities, spacing, a, b):  # type: ignore[no-untyped-def]
    """The parabola through the wall's velocity that fits the particles within three spacings of it best."""
    nodes, dimension = len(a), x.shape[1]
    powers = np.zeros((nodes, 2, 3))  # sums of y^2, y^3 and y^4
    a[:], b[:] = 0.0, 0.0
    for i in range(len(x)):
        for side in range(2):
            y = upper[axis] - x[i, axis] if side else x[i, axis] - lower[axis]
            if y < PARABOLA * spacing:
                node, share = node_along(x[i], along, lower, upper, nodes)
                for n in range(2 if share > 0.0 else 1):
                    weight = share if n else 1.0 - share
                    for power in range(3):
                        powers[node + n, side, power] += weight * y ** (2 + power)
                    for k in range(dimension):
                        u = weight * (v[i, k] - velocities[side, k])
                        a[node + n, side, k] += u * y
                        b[node + n, side, k] += u * y * y
    for node in range(nodes):
        for side in range(2):
            y2, y3, y4 = powers[node, side]
            determinant = y2 * y4 - y3 * y3
            for k in range(dimension):
                p, q = a[node, side, k], b[node, side, k]
                known = determinant > 1e-9 * y2 * y4
                a[node, side, k] = (p * y4 - q * y3) / determinant if known else 0.0
                b[node, side, k] = (q * y2 - p * y3) / determinant if known else 0.0


@compiled
def global_quadratic(x, v, lower, upper, axis, along, velocities, spacing, a, b):  # type: ignore[no-untyped-def]
    """The parabola through both walls' velocities that fits all particles between them best (Watkins et al. 1996)."""
    nodes, dimension = len(a), x.shape[1]
    width = upper[axis] - lower[axis]
    ss = np.zeros(nodes)
    a[:], b[:] = 0.0, 0.0
    for i in range(len(x)):
        y = x[i, axis] - lower[axis]
        shape = y * (width - y)
        node, share = node_along(x[i], along, lower, upper, nodes)
        for n in range(2 if share > 0.0 else 1):
            weight = share if n else 1.0 - share
            ss[node + n] += weight * shape * shape
            for k in range(dimension):
                slope = (velocities[1, k] - velocities[0, k]) / width
                a[node + n, 0, k] += weight * (v[i, k] - velocities[0, k] - slope * y) * shape
    for node in range(nodes):
        for k in range(dimension):
            slope = (velocities[1, k] - velocities[0, k]) / width
            curvature = a[node, 0, k] / ss[node] if ss[node] > 0.0 else 0.0
            for side in range(2):
                a[node, side, k] = curvature * width + (-slope if side else slope)
                b[node, side, k] = -curvature
