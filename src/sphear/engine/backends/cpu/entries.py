"""Stages that find the entries, sort them into cells and choose the rows of the pair list."""

from __future__ import annotations

from sphear.boundaries.box import fill_images
from sphear.engine.backends.cpu.sizes import (
    CELL_ROOM,
    CELLS,
    DIMENSION,
    ENTRIES,
    ENTRY_ROOM,
    FLUID,
    LISTED,
    MORE_CELLS,
    MORE_ENTRIES,
    OFFSETS,
    PARTICLES,
    PARTS,
    SHARE,
    WANTED,
)
from sphear.engine.backends.cpu.views import (
    float_table,
    floats,
    integers,
    octets,
    short_integers,
)
from sphear.engine.cache import compiled
from sphear.neighbours.cells import PADDING, cell_total, fill_cells, fill_offsets, grid

IMAGES = ("reach", "position", "lower", "upper", "kinds", "positions", "source", "wall")
SORT = ("support", "positions", "coordinates", "order", "cell", "start", "unsorted", "following", "offsets")
CHOOSE_ROWS = ("images", "order", "entry", "target", "numbers", "bounds")


@compiled
def images(table, sizes):  # type: ignore[no-untyped-def]
    """Write the entries; the arrays are those of `IMAGES`, the first how far images reach and from where on walls."""
    dimension, room = sizes[DIMENSION], sizes[ENTRY_ROOM]
    reach = floats(table[0], 2)
    found = fill_images(
        float_table(table[1], sizes[PARTICLES], dimension), floats(table[2], dimension), floats(table[3], dimension),
        integers(table[4], dimension), reach[0], reach[1], float_table(table[5], room, dimension),
        short_integers(table[6], room), octets(table[7], room),
    )  # fmt: skip
    if found < 0:
        sizes[WANTED] = 2 * room
        return MORE_ENTRIES
    sizes[ENTRIES] = found
    return 0


@compiled
def sort(table, sizes):  # type: ignore[no-untyped-def]
    """Sort the entries into cells; the arrays are those of `SORT`, the first the radius of the kernel."""
    dimension, entries, room = sizes[DIMENSION], sizes[ENTRIES], sizes[ENTRY_ROOM]
    positions = float_table(table[1], entries, dimension)
    lower, extent, inverse, counts = grid(positions, floats(table[0], 1)[0])
    cells = cell_total(counts)
    if cells > sizes[CELL_ROOM]:
        sizes[WANTED] = cells + cells // 4
        return MORE_CELLS
    sizes[CELLS] = cells
    fill_cells(
        positions, lower, extent, inverse, counts, float_table(table[2], dimension, room + PADDING),
        short_integers(table[3], entries), short_integers(table[4], entries), integers(table[5], cells + 1),
        short_integers(table[6], entries), integers(table[7], cells),
    )  # fmt: skip
    fill_offsets(counts, integers(table[8], sizes[OFFSETS]))
    return 0


@compiled
def choose_rows(table, sizes):  # type: ignore[no-untyped-def]
    """List the rows: the fluid's particles, those of walls, then images where they are summed for too.

    The arrays are those of `CHOOSE_ROWS`; the first has 1 where images are. `entry` has the place of each row's entry
    in the order of the cells, `target` its number, `numbers` the row's own; `bounds` has the first row of each part.
    """
    count, total, entries, parts = sizes[FLUID], sizes[PARTICLES], sizes[ENTRIES], sizes[PARTS]
    of_images = floats(table[0], 1)[0] > 0.0
    listed = entries if of_images else total
    order, entry = short_integers(table[1], entries), short_integers(table[2], listed)
    target, numbers = short_integers(table[3], listed), short_integers(table[4], listed)
    fluid, walls, images = 0, count, total
    for s in range(entries):
        e = order[s]
        if e < count:
            row, fluid = fluid, fluid + 1
        elif e < total:
            row, walls = walls, walls + 1
        elif of_images:
            row, images = images, images + 1
        else:
            continue
        entry[row], target[row] = s, e
    for row in range(listed):
        numbers[row] = row
    bounds = integers(table[5], parts + 1)
    for part in range(parts + 1):
        bounds[part] = listed * part // parts
    sizes[LISTED], sizes[SHARE] = listed, listed // parts + 2
    return 0
