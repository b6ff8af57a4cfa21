"""How the velocity along a wall is continued to the mirror particles behind it.

u(y) is the velocity along the wall at the distance y from it. Each rule finds a and b of u(y) = u_wall + a y + b y^2
for each wall, and a mirror particle at the depth y has u_wall - a y + b y^2; but `mirror` reflects each particle.
Basa, Quinlan & Lastiwka 2009, section 6.1.2 and figure 3.
"""

from __future__ import annotations

from typing import Any

from sphear.engine.cache import compiled
from sphear.names import Registry


@compiled
def mirror(x, v, lower, upper, axis, velocities, spacing, a, b):  # type: ignore[no-untyped-def]
    """Nothing to fit: a mirror particle has 2 u_wall - u of its own particle."""


@compiled
def linear(x, v, lower, upper, axis, velocities, spacing, a, b):  # type: ignore[no-untyped-def]
    """The line through the wall's velocity that fits the particles within one spacing of it best."""
    for side in range(2):
        for component in range(x.shape[1]):
            uy, yy = 0.0, 0.0
            for i in range(len(x)):
                y = upper[axis] - x[i, axis] if side else x[i, axis] - lower[axis]
                if y < spacing:
                    uy += (v[i, component] - velocities[side, component]) * y
                    yy += y * y
            a[side, component] = uy / yy if yy > 0.0 else 0.0


@compiled
def quadratic(x, v, lower, upper, axis, velocities, spacing, a, b):  # type: ignore[no-untyped-def]
    """The parabola through the wall's velocity that fits the particles within two spacings of it best."""
    for side in range(2):
        for component in range(x.shape[1]):
            uy, uyy, y2, y3, y4 = 0.0, 0.0, 0.0, 0.0, 0.0
            for i in range(len(x)):
                y = upper[axis] - x[i, axis] if side else x[i, axis] - lower[axis]
                if y < 2.0 * spacing:
                    u = v[i, component] - velocities[side, component]
                    uy += u * y
                    uyy += u * y * y
                    y2 += y * y
                    y3 += y * y * y
                    y4 += y * y * y * y
            determinant = y2 * y4 - y3 * y3
            if determinant > 1e-9 * y2 * y4:
                a[side, component] = (uy * y4 - uyy * y3) / determinant
                b[side, component] = (uyy * y2 - uy * y3) / determinant


@compiled
def global_quadratic(x, v, lower, upper, axis, velocities, spacing, a, b):  # type: ignore[no-untyped-def]
    """The parabola through both walls' velocities that fits all particles of the channel best (Watkins et al. 1996)."""
    width = upper[axis] - lower[axis]
    for component in range(x.shape[1]):
        slope = (velocities[1, component] - velocities[0, component]) / width
        us, ss = 0.0, 0.0
        for i in range(len(x)):
            y = x[i, axis] - lower[axis]
            shape = y * (width - y)
            us += (v[i, component] - velocities[0, component] - slope * y) * shape
            ss += shape * shape
        curvature = us / ss if ss > 0.0 else 0.0
        for side in range(2):
            a[side, component] = curvature * width + (-slope if side else slope)
            b[side, component] = -curvature


WALL_VELOCITIES: Registry[Any] = Registry("wall velocity")
WALL_VELOCITIES.add("mirror", mirror, ("mirroring",))
WALL_VELOCITIES.add("linear", linear)
WALL_VELOCITIES.add("quadratic", quadratic)
WALL_VELOCITIES.add("global_quadratic", global_quadratic, ("global",))
