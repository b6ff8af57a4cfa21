"""The stage that continues velocities through mirroring walls to the images."""

from __future__ import annotations

from sphear.engine.backends.cpu.written import WrittenStage


def image_velocities(dimension: int, continuation: str) -> WrittenStage:
    """Write the velocities of all entries, those of images as `continuation` continues them.

    Args:
        dimension: 2 or 3.
        continuation: a name of `sphear.boundaries.CONTINUATIONS`.
    """
    stage = WrittenStage(f"velocities of images, {continuation}")
    stage.imports = [
        "import numpy as np",
        f"from sphear.boundaries.side_fits import {continuation} as fit",
        "from sphear.boundaries.mirror import mirror_velocities, wall_nodes",
    ]
    stage.view("x", "position", "float_table", "FLUID", dimension)
    stage.view("v", "velocity", "float_table", "PARTICLES", dimension)
    stage.view("positions", "positions", "float_table", "ENTRIES", dimension)
    stage.view("source", "source", "short_integers", "ENTRIES")
    stage.view("wall", "wall", "octets", "ENTRIES")
    stage.view("lower", "lower", "floats", dimension)
    stage.view("upper", "upper", "floats", dimension)
    stage.view("kinds", "kinds", "integers", dimension)
    stage.view("wall_velocities", "wall_velocities", "float_table", 2 * dimension, dimension + 1)
    stage.view("spacing", "spacing", "floats", 1)
    stage.view("velocity", "image_velocity", "float_table", "ENTRIES", dimension)
    stage.size("entries", "ENTRIES")
    stage.body = [
        "for e in range(entries):",
        f"    for k in range({dimension}):",
        "        velocity[e, k] = v[source[e], k]",
        f"for axis in range({dimension}):",
        "    if kinds[axis] == 1:",
        "        along, nodes = wall_nodes(lower, upper, kinds, axis, spacing[0])",
        f"        a, b = np.zeros((nodes, 2, {dimension})), np.zeros((nodes, 2, {dimension}))",
        "        of_walls = wall_velocities[2 * axis : 2 * axis + 2]",
        "        fit(x, v, lower, upper, axis, along, of_walls, spacing[0], a, b)",
        "        mirror_velocities(v, positions, source, wall, lower, upper, kinds, axis, of_walls, spacing[0], a, b,",
        f"                          {continuation == 'mirror'}, velocity)",
    ]
    return stage
