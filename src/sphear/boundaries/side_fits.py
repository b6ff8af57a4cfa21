"""Fits of the velocity before the sides of a box, by which it is continued to mirror particles.

Each function finds a and b of u(y) = u_wall + a y + b y^2, y the distance from a wall, for both walls of an axis; the
arithmetic is that of `sphear.boundaries.continuations`. A mirror particle at the depth y has u_wall - a y + b y^2; but
`mirror` reflects each particle.

Along a wall that ends at other walls, a and b vary: they are found at nodes along it, from the particles around each,
and taken linearly between. Along a periodic wall there is one node: the whole of it.
"""

from __future__ import annotations

import numpy as np
from numba.extending import overload, register_jitable

from sphear.algebra import where_less
from sphear.boundaries.continuations import GlobalParabola, Line, Parabola, determinant, inverse, solved
from sphear.engine.cache import compiled, inlined

PARABOLA = 3.0  # spacings from the wall within which particles decide on the parabola: three rows of them


@overload(where_less)
def _where_less(a, b, yes, no):  # type: ignore[no-untyped-def]
    """The choice that formulas have in place of `if`, in compiled code."""
    return lambda a, b, yes, no: yes if a < b else no


for _called in (inverse, determinant, solved):
    register_jitable(_called)
line = register_jitable(Line.coefficients)
parabola = register_jitable(Parabola.coefficients)
shape = register_jitable(GlobalParabola.shape)
excess = register_jitable(GlobalParabola.excess)
between_walls = register_jitable(GlobalParabola.coefficients)


@inlined
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
    squares = np.zeros((nodes, 2))
    a[:], b[:] = 0.0, 0.0
    for i in range(len(x)):
        for side in range(2):
            s = (upper[axis] - x[i, axis] if side else x[i, axis] - lower[axis]) / spacing
            if s < 1.0:
                node, share = node_along(x[i], along, lower, upper, nodes)
                for n in range(2 if share > 0.0 else 1):
                    weight = share if n else 1.0 - share
                    squares[node + n, side] += weight * s * s
                    for k in range(dimension):
                        a[node + n, side, k] += weight * (v[i, k] - velocities[side, k]) * s
    for node in range(nodes):
        for side in range(2):
            for k in range(dimension):
                a[node, side, k] = line((squares[node, side],), (a[node, side, k],))[0] / spacing


@compiled
def quadratic(x, v, lower, upper, axis, along, velocities, spacing, a, b):  # type: ignore[no-untyped-def]
    """The parabola through the wall's velocity that fits the particles within three spacings of it best."""
    nodes, dimension = len(a), x.shape[1]
    squares = np.zeros((nodes, 2, 3))  # sums of s^2, s^3 and s^4
    a[:], b[:] = 0.0, 0.0
    for i in range(len(x)):
        for side in range(2):
            s = (upper[axis] - x[i, axis] if side else x[i, axis] - lower[axis]) / spacing
            if s < PARABOLA:
                node, share = node_along(x[i], along, lower, upper, nodes)
                for n in range(2 if share > 0.0 else 1):
                    weight = share if n else 1.0 - share
                    for power in range(3):
                        squares[node + n, side, power] += weight * s ** (2 + power)
                    for k in range(dimension):
                        u = weight * (v[i, k] - velocities[side, k])
                        a[node + n, side, k] += u * s
                        b[node + n, side, k] += u * s * s
    for node in range(nodes):
        for side in range(2):
            s2, s3, s4 = squares[node, side]
            for k in range(dimension):
                slope, bend = parabola((s2, s3, s4), (a[node, side, k], b[node, side, k]))
                a[node, side, k], b[node, side, k] = slope / spacing, bend / spacing**2


@compiled
def global_quadratic(x, v, lower, upper, axis, along, velocities, spacing, a, b):  # type: ignore[no-untyped-def]
    """The parabola through both walls' velocities that fits all particles between them best."""
    nodes, dimension = len(a), x.shape[1]
    width = upper[axis] - lower[axis]
    squares = np.zeros(nodes)
    a[:], b[:] = 0.0, 0.0
    for i in range(len(x)):
        s = (x[i, axis] - lower[axis]) / width
        term = shape(s)
        node, share = node_along(x[i], along, lower, upper, nodes)
        for n in range(2 if share > 0.0 else 1):
            weight = share if n else 1.0 - share
            squares[node + n] += weight * term * term
            for k in range(dimension):
                a[node + n, 0, k] += weight * excess(v[i, k], velocities[0, k], velocities[1, k], s) * term
    for node in range(nodes):
        for k in range(dimension):
            c = line((squares[node],), (a[node, 0, k],))[0]
            for side in range(2):
                slope, bend = between_walls(velocities[side, k], velocities[1 - side, k], c)
                a[node, side, k], b[node, side, k] = slope / width, bend / width**2
