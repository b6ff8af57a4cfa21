"""The stage that lists pairs."""

from __future__ import annotations

from sphear.engine.backends.cpu.sizes import MORE_PAIRS, WANTED
from sphear.engine.backends.cpu.written import WrittenStage
from sphear.engine.selection import WIDTH
from sphear.neighbours.cells import PADDING, REACH
from sphear.neighbours.pair_list import SLACK, list_module


def list_pairs(dimension: int) -> WrittenStage:
    """List the neighbours of the rows of each part; called again with more room where a part has not enough.

    Args:
        dimension: 2 or 3.
    """
    stage = WrittenStage("the pair list")
    stage.imports = ["import numpy as np", f"from {list_module(dimension).__name__} import build"]
    stage.view("radius", "support", "floats", 1)
    stage.view("selection", "selection", "octet_table", 2**WIDTH, WIDTH)
    stage.view("coordinates", "coordinates", "float_table", dimension, f"ENTRY_ROOM + {PADDING}")
    stage.view("cell", "cell", "short_integers", "ENTRIES")
    stage.view("start", "start", "integers", "CELLS + 1")
    stage.view("offsets", "offsets", "integers", "OFFSETS")
    stage.view("entry", "entry", "short_integers", "LISTED")
    stage.view("bounds", "bounds", "integers", "PARTS + 1")
    stage.view("first", "first", "integer_table", "PARTS", "SHARE")
    stage.view("neighbour", "neighbour", "short_integer_table", "PARTS", "PAIR_ROOM")
    stage.view("enough", "enough", "integers", "PARTS")
    for name, size in (("parts", "PARTS"), ("cells", "CELLS"), ("room", "PAIR_ROOM")):
        stage.size(name, size)
    row = 2 * REACH + 1
    axes = ", ".join(f"coordinates[{axis}]" for axis in range(dimension))
    stage.body = [
        "support = radius[0]",
        "image = np.zeros(1, np.bool_)",
        "run = 0",
        f"for number in range({row}, cells + 1):",
        f"    run = max(run, start[number] - start[number - {row}])",
        f"most = run * len(offsets) + {SLACK}",
        "for part in prange(parts):",
        "    origin, end = bounds[part], bounds[part + 1]",
        "    first[part, 0] = 0",
        "    enough[part] = 1",
        "    if end > origin:",
        f"        listed, pairs, near = build({axes}, image, start, offsets, cell, entry, first[part],",
        "                                    neighbour[part], 0, (1e-9 * support) ** 2, support**2, selection, origin,",
        "                                    origin, end, most)",
        "        enough[part] = 1 if listed == end else 0",
        "        if listed == end:",
        f"            for k in range(pairs, pairs + {SLACK}):",
        "                neighbour[part, k] = entry[end - 1]  # lanes without a neighbour stay near",
        "for part in range(parts):",
        "    if enough[part] == 0:",
        f"        sizes[{WANTED}] = room + room // 2 + most",
        f"        return {MORE_PAIRS}",
    ]
    return stage
