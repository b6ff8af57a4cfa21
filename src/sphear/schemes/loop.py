"""Source text of a time loop: every sweep of a step, compiled with the loop around them.

A run of a few hundred particles makes hundreds of thousands of steps; Python sees it only between outputs. A large one
is the same text, with its loops over particles shared out to threads.
"""

from __future__ import annotations

from types import ModuleType

from sphear.engine.cache import generated_module
from sphear.engine.flags import options_text
from sphear.interactions import FluidBeforeWall, VelocityBeforeWall
from sphear.neighbours.pair_list import list_module
from sphear.schemes.formulas import Formulas
from sphear.schemes.integrators import integrator_text
from sphear.schemes.passages import mirror_text, preparations_text, pressure_text, result_text, wall_text
from sphear.schemes.sweeps import Sweeps, block

_RATES = '''
"""{title}"""

import numpy as np
from numba import prange
from {list_module} import build
{imports}
from sphear.boundaries.box import with_images
from sphear.boundaries.mirror import mirror_velocities, wall_nodes
from sphear.boundaries.continuation import {continuation} as fit
from sphear.engine.cache import njit
from sphear.engine.dense import solve_normal_equations
from sphear.neighbours.cells import sorted_cells
from sphear.schemes.state import Change, Fields
{functions}

@njit({options}{parallel})
def list_rows(coordinates, start, cells, cell, entry, low, high, table, bounds, most, first, neighbour):
    """The pair list of each part; the number of pairs that a part had no room for is told as False."""
    image = np.zeros(1, np.bool_)
    enough = np.ones(len(bounds) - 1, np.bool_)
    for part in prange(len(bounds) - 1):
        origin, end = bounds[part], bounds[part + 1]
        first[part, 0] = 0
        row, pairs, near = build({axes}, image, start, cells, cell, entry, first[part], neighbour[part], 0, low,
                                 high, table, origin, origin, end, most)
        enough[part] = row == end
        if row == end and end > origin:
            neighbour[part, pairs : pairs + 16] = entry[end - 1]  # lanes without a neighbour stay near
    return enough.all()


@njit({options})
def rates(x, v, f, change, count, parts, space, numbers_of, constants):
    """Pressure, density where it is summed, and the rates of change.

    Returns -1, or the particle whose correction cannot be computed.
    """
    total, dimension = x.shape
    lower, upper, kinds, velocities = space
    force, spacing, support, state, wall_state, table, moments, right = numbers_of
    positions, source, wall = with_images(x, lower, upper, kinds, {layers} * support, {on_wall})
    entries = len(source)
    coordinates, order, cell, start, cells = sorted_cells(positions, support)

    # rows of the pair list: the fluid's particles, those of walls, then images where they are summed for too
    entry, target = np.empty({rows}, np.int32), np.empty({rows}, np.int32)
    fluid_rows, wall_rows, image_rows = 0, count, total
    for s in range(entries):
        e = order[s]
        if e < count:
            entry[fluid_rows], target[fluid_rows] = s, e
            fluid_rows += 1
        elif e < total:
            entry[wall_rows], target[wall_rows] = s, e
            wall_rows += 1
        elif {layers} > 1:
            entry[image_rows], target[image_rows] = s, e
            image_rows += 1
    bounds = np.empty(parts + 1, np.int64)
    for part in range(parts + 1):
        bounds[part] = len(entry) * part // parts

    most = 16
    run = 0
    for number in range(5, len(start)):
        run = max(run, start[number] - start[number - 5])
    most += run * len(cells)
    share = len(entry) // parts + 1
    ball = np.pi if dimension == 2 else 4.0 / 3.0 * np.pi
    room = int(1.05 * share * ball * (support / spacing) ** dimension) + most
    first = np.empty((parts, share + 1), np.int64)
    while True:
        neighbour = np.empty((parts, room), np.int32)
        if list_rows(coordinates, start, cells, cell, entry, (1e-9 * support) ** 2, support**2, table, bounds, most,
                     first, neighbour):
            break
        room += room // 2

    far = 1.001 * support
    nothing = np.empty((0, 0))
    before = nothing
    {velocities}
    {density}
    for i in range({of_equation}):
        {equation_of_state}
    {wall}
    {preparations}
    {stages}
    {result}
    return -1

'''


def loop_module(
    dimension: int,
    formulas: Formulas,
    *,
    integrator: str,
    walls: bool,
    mirrored: bool,
    continuation: str,
    wall_particles: bool,
    parallel: bool,
) -> ModuleType:
    """The compiled time loop of one combination of formulas.

    Args:
        dimension: 2 or 3.
        formulas: of a step.
        integrator: a name of `integrators`.
        walls: whether the box has any.
        mirrored: whether they are mirrors; else there are fixed particles behind them.
        continuation: a name of `CONTINUATIONS`.
        wall_particles: whether particles stand on mirroring walls.
        parallel: whether loops over particles are shared out to threads.
    """
    options = options_text()
    sweeps = Sweeps(dimension, walls and mirrored, options, ", parallel=True" if parallel else "")
    # first derivatives at images need their neighbours, which lie twice as deep
    layers = len(formulas.stages)
    every_row, of_fluid, of_walls = ("0", "len(entry)"), ("0", "count"), ("count", "total")
    integrated_walls = formulas.density is None and isinstance(formulas.wall, VelocityBeforeWall)
    last = ("0", "total") if integrated_walls else of_fluid

    density = []
    if formulas.density is not None:
        # those that stand on a wall are within it, and would be counted twice
        sweeps.columns["mass"] = "(0.0 if wall[e] & 64 else f.mass[i])" if wall_particles else "f.mass[i]"
        density = [
            *sweeps.text(formulas.density, "summed", ("0", "total"), size="total"),
            "for i in range(total):",
            "    f.density[i] = summed[i, 0]",
        ]
        sweeps.columns["mass"] = "f.mass[i]"
    sweeps.before = ()
    wall = wall_text(sweeps, formulas, of_walls)
    sweeps.before = ()
    preparations, own = preparations_text(sweeps, formulas, every_row if layers > 1 else last)
    sweeps.before = ()
    stages: list[str] = []
    for number, stage in enumerate(formulas.stages):
        end = number == len(formulas.stages) - 1
        rows, size = (last, "total") if end else (every_row, "len(entry)")
        stages += sweeps.text(
            stage, f"stage{number}", rows, own=own, prepared="prepared" if own else "nothing", size=size
        )
        stages += [f"before = stage{number}"]
    text = _RATES.format(
        title=f"flow: {', '.join(type(part).__name__ for part in formulas.rates.parts)}",
        list_module=list_module(dimension).__name__,
        imports="\n".join(sweeps.imports),
        functions="".join(sweeps.functions),
        continuation=continuation,
        options=options,
        parallel=sweeps.parallel,
        layers=layers,
        on_wall="spacing" if wall_particles else "0.0",
        rows="total" if layers == 1 else "entries",
        axes=", ".join(f"coordinates[{axis}]" for axis in range(dimension)),
        velocities=block(mirror_text(continuation) if walls and mirrored else [], 4),
        density=block(density, 4),
        of_equation="count" if isinstance(formulas.wall, FluidBeforeWall) else "total",
        equation_of_state=block(pressure_text(formulas.equation_of_state), 8),
        wall=block(wall, 4),
        preparations=block(preparations, 4),
        stages=block(stages, 4),
        result=block(result_text(formulas, dimension, integrated_walls), 4),
    )
    return generated_module(text + integrator_text(integrator, formulas.rates.roles))
