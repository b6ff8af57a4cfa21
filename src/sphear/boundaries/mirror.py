"""The velocities of mirror particles: opposite across the wall, continued along it."""

from __future__ import annotations

import numpy as np
from numba.extending import register_jitable

from sphear.boundaries.box import ON_WALL
from sphear.boundaries.continuations import Mirror, Parabola
from sphear.boundaries.side_fits import node_along
from sphear.engine.cache import compiled, inlined

NODE_SPACING = 4.0  # of the nodes along a wall, in particle spacings

reflection = register_jitable(Mirror.behind)
continued = register_jitable(Parabola.behind)


@inlined
def wall_nodes(lower, upper, kinds, axis, spacing):  # type: ignore[no-untyped-def]
    """The axis along which the continuation varies on the walls of an axis, -1 if none, and the number of nodes."""
    for along in range(len(kinds)):
        if along != axis and kinds[along] != 0:
            return along, 2 + int((upper[along] - lower[along]) / (NODE_SPACING * spacing))
    return -1, 1


@compiled
def mirror_velocities(  # type: ignore[no-untyped-def]
    v, positions, source, wall, lower, upper, kinds, axis, velocities, spacing, a, b, reflected, velocity
):
    """Write the velocities of the entries that were reflected at the walls of one axis alone, and of those on them.

    An image in a corner, reflected twice, has the velocity of its particle: what reflecting it at one wall after the
    other gives, in the mean of both orders. At a wall that fluid slips along only the velocity across it is reflected.

    Args:
        v: (N, d), of the particles.
        positions: (E, d), of all entries.
        source: (E,), the particle that each is an image of.
        wall: (E,), the walls it was reflected at.
        lower: the lower corner of the box.
        upper: its upper corner.
        kinds: of its sides.
        axis: whose walls are meant.
        velocities: (2, d + 1), of these walls, and whether fluid slips along them.
        spacing: of the particles.
        a: (nodes, 2, d), slopes along the walls.
        b: (nodes, 2, d), curvatures.
        reflected: whether the velocity along the wall is reflected too, instead of continued by a and b.
        velocity: (E, d), written.
    """
    dimension = v.shape[1]
    along, nodes = wall_nodes(lower, upper, kinds, axis, spacing)
    slips = (velocities[0, dimension] > 0.5, velocities[1, dimension] > 0.5)
    for e in range(len(source)):
        bits = wall[e]
        for side in range(2):
            alone = np.uint8(1 << (2 * axis + side))
            if bits & ON_WALL and bits & alone:
                for k in range(dimension):
                    velocity[e, k] = velocities[side, k]
            elif bits == alone:
                i = source[e]
                if slips[side]:
                    for k in range(dimension):
                        velocity[e, k] = -v[i, k] if k == axis else v[i, k]
                    continue
                depth = positions[e, axis] - upper[axis] if side else lower[axis] - positions[e, axis]
                node, share = node_along(positions[e], along, lower, upper, nodes)
                after = node + 1 if share > 0.0 else node
                for k in range(dimension):
                    if reflected or k == axis:
                        velocity[e, k] = reflection(velocities[side, k], v[i, k])
                    else:
                        slope = (1.0 - share) * a[node, side, k] + share * a[after, side, k]
                        bend = (1.0 - share) * b[node, side, k] + share * b[after, side, k]
                        velocity[e, k] = continued(velocities[side, k], (slope, bend), depth)
            elif slips[side] and bits & alone:  # a corner: the other wall reflects the rest
                for k in range(dimension):
                    if k != axis:
                        velocity[e, k] = -velocity[e, k]
