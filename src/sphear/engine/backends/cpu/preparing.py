"""Stages that turn sums over a particle's surroundings into coefficients, and test them."""

from __future__ import annotations

from sphear.engine.backends.cpu.sizes import FLUID, LISTED, WORST
from sphear.engine.backends.cpu.views import float_table, floats, integer_table, integers, short_integers
from sphear.engine.cache import compiled
from sphear.engine.dense import solve_normal_equations
from sphear.engine.stages import TOO_FEW_NEIGHBOURS

SOLVE = ("equations", "sums", "moments", "right", "solved")
TEST = ("test", "solved", "target")
JOIN = ("widths", "one", "other", "both")


@compiled
def solve(table, sizes):  # type: ignore[no-untyped-def]
    """Solve the normal equations of each row; the arrays are those of `SOLVE`.

    The first has the sizes of the sums, of the equations, and the row after the last.
    """
    equations = integers(table[0], 3)
    width, unknowns, rows = equations[0], equations[1], equations[2]
    rows = sizes[rows]
    solved = float_table(table[4], rows, 1 + unknowns)
    solve_normal_equations(
        float_table(table[1], rows, width), integer_table(table[2], unknowns, unknowns), floats(table[3], unknowns),
        solved[:, 0], solved[:, 1:],
    )  # fmt: skip
    return 0


@compiled
def test(table, sizes):  # type: ignore[no-untyped-def]
    """Fail at the first particle of the fluid whose quality, in the first column, is too low; arrays of `TEST`.

    The first has the least quality and the width of the rows.
    """
    limits = floats(table[0], 2)
    least, width = limits[0], int(limits[1])
    rows = float_table(table[1], sizes[LISTED], width)
    target = short_integers(table[2], sizes[LISTED])
    for row in range(sizes[FLUID]):  # the rows of the fluid are the first
        if not rows[row, 0] > least:
            sizes[WORST] = target[row]
            return TOO_FEW_NEIGHBOURS
    return 0


@compiled
def join(table, sizes):  # type: ignore[no-untyped-def]
    """Put the rows of two tables side by side; the arrays are those of `JOIN`, the first their widths."""
    widths = integers(table[0], 2)
    rows, first, second = sizes[LISTED], widths[0], widths[1]
    one, other = float_table(table[1], rows, first), float_table(table[2], rows, second)
    both = float_table(table[3], rows, first + second)
    for row in range(rows):
        for k in range(first):
            both[row, k] = one[row, k]
        for k in range(second):
            both[row, first + k] = other[row, k]
    return 0
