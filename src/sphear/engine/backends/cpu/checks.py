"""Stages that check the state of a flow and keep its particles in the box."""

from __future__ import annotations

from sphear.engine.backends.cpu.sizes import DIMENSION, FLUID, PARTICLES, WORST
from sphear.engine.backends.cpu.views import float_table, floats, integers
from sphear.engine.cache import compiled
from sphear.engine.stages import NOT_FINITE, NOT_POSITIVE, THROUGH_A_WALL, TOO_FAST

ENTER_BOX = ("limits", "position", "velocity", "lower", "upper", "kinds", "wall_velocities")


@compiled
def check_finite(table, sizes):  # type: ignore[no-untyped-def]
    """Fail at the first particle of the fluid whose vector is not finite; the array is that of the vectors."""
    count, dimension = sizes[FLUID], sizes[DIMENSION]
    vectors = float_table(table[0], count, dimension)
    for i in range(count):
        for k in range(dimension):
            if not abs(vectors[i, k]) < float("inf"):
                sizes[WORST] = i
                return NOT_FINITE
    return 0


@compiled
def check_positive(table, sizes):  # type: ignore[no-untyped-def]
    """Fail at the first particle whose number is not positive; the array is that of the numbers."""
    numbers = floats(table[0], sizes[PARTICLES])
    for i in range(len(numbers)):
        if not numbers[i] > 0.0:
            sizes[WORST] = i
            return NOT_POSITIVE
    return 0


@compiled
def enter_box(table, sizes):  # type: ignore[no-untyped-def]
    """Put particles back into the box; the arrays are those of `ENTER_BOX`, the first the spacing and fastest speed."""
    dimension, count = sizes[DIMENSION], sizes[FLUID]
    limits = floats(table[0], 2)
    x, v = float_table(table[1], count, dimension), float_table(table[2], count, dimension)
    lower, upper = floats(table[3], dimension), floats(table[4], dimension)
    kinds, velocities = integers(table[5], dimension), floats(table[6], dimension * 2 * (dimension + 1))
    spacing, fastest = limits[0], limits[1]
    square, fast, outside = 0.0, 0, -1
    for i in range(count):
        speed = 0.0
        for k in range(dimension):
            if not lower[k] <= x[i, k] < upper[k]:
                side = 1 if x[i, k] > lower[k] else 0
                wall = upper[k] if side else lower[k]
                if kinds[k] == 0:
                    x[i, k] = lower[k] + (x[i, k] - lower[k]) % (upper[k] - lower[k])
                elif not abs(x[i, k] - wall) < (1.0 if kinds[k] == 1 else 0.5) * spacing:
                    outside = i
                elif kinds[k] == 1:
                    x[i, k] = 2.0 * wall - x[i, k]
                    v[i, k] = 2.0 * velocities[(2 * k + side) * (dimension + 1) + k] - v[i, k]
            speed += v[i, k] * v[i, k]
        if speed > square:
            square, fast = speed, i
    sizes[WORST] = outside if outside >= 0 else fast
    if outside >= 0:
        return THROUGH_A_WALL
    return TOO_FAST if square > fastest * fastest else 0
