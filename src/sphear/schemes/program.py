"""Source text of a weakly compressible time loop: every sweep of a step, compiled with the loop around them.

A run of a few hundred particles makes hundreds of thousands of steps; Python sees it only between outputs.
"""

from __future__ import annotations

from itertools import count
from types import ModuleType
from typing import Any

from sphear.engine.cache import generated_module
from sphear.engine.flags import options_text
from sphear.engine.formula import Interaction, Shape, TracedFormula, traced
from sphear.engine.program import sweep_text
from sphear.engine.structure import with_symbols
from sphear.engine.trace import Trace
from sphear.neighbours.pair_list import list_module

# what a record's column holds for entry e, an image of particle i
_COLUMNS = {
    "mass": "mass[i]",
    "dynamic_viscosity": "viscosity[i]",
    "density": "density[i]",
    "volume": "mass[i] / density[i]",
    "pressure": "pressure[i]",
    "pressure_over_density2": "pressure[i] / (density[i] * density[i])",
    "inverse_density2": "1.0 / (density[i] * density[i])",
    "velocity": "velocity[e, {k}]",
    "before": "before[e, {k}]",
}

_LOOP = '''
"""{title}"""

import numpy as np
from numba import njit
from {list_module} import build
{imports}
from sphear.boundaries.box import with_images
from sphear.boundaries.wall_velocity import {wall_velocity} as fit
from sphear.engine.dense import solve_normal_equations
from sphear.neighbours.cells import sorted_cells


@njit({options})
def rates(x, v, mass, viscosity, force, lower, upper, kinds, axis, velocities, spacing, support, state, constants,
          table, index, right, density, pressure, acceleration):
    """Density, pressure and acceleration of the particles; -1, or the particle whose correction cannot be computed."""
    count, dimension = x.shape
    positions, source, wall, depth = with_images(x, lower, upper, kinds, {layers} * support)
    entries = len(source)
    coordinates, order, cell, start, rows = sorted_cells(positions, support)

    entry = np.empty({rows}, np.int32)
    target = np.empty(len(entry), np.int32)
    listed = 0
    for s in range(entries):
        if order[s] < len(entry):
            entry[listed], target[listed] = s, order[s]
            listed += 1
    most = 16
    run = 0
    for number in range(5, len(start)):
        run = max(run, start[number] - start[number - 5])
    most += run * len(rows)
    neighbour = np.empty(40 * len(entry) + most, np.int32)
    first = np.zeros(len(entry) + 1, np.int64)
    image = np.zeros(1, np.bool_)
    row, pairs = 0, 0
    while True:
        row, pairs, near = build({axes}, image, start, rows, cell, entry, first, neighbour, pairs,
                                 (1e-9 * support) ** 2, support**2, table, row, 0, len(entry), most)
        if row == len(entry):
            break
        larger = np.empty(2 * len(neighbour), np.int32)
        larger[:pairs] = neighbour[:pairs]
        neighbour = larger
    neighbour[pairs : pairs + 16] = entry[len(entry) - 1]

    a, b = np.zeros((2, dimension)), np.zeros((2, dimension))
    velocity = np.empty((entries, dimension))
    if axis >= 0:
        fit(x, v, lower, upper, axis, velocities, spacing, a, b)
    for e in range(entries):
        i = source[e]
        for k in range(dimension):
            velocity[e, k] = v[i, k]
        if wall[e]:
            side = wall[e] - 1
            for k in range(dimension):
                if {mirrored} or k == axis:
                    velocity[e, k] = 2.0 * velocities[side, k] - v[i, k]
                else:
                    velocity[e, k] = velocities[side, k] - a[side, k] * depth[e] + b[side, k] * depth[e] ** 2

    far = 1.001 * support
    nothing = np.empty((0, 0))
    {density}
    for i in range(count):
        {equation_of_state}
    prepared = nothing
    {preparation}
    {stages}
    for i in range(count):
        for k in range(dimension):
            acceleration[i, k] = result[i, k] + force[k]
    return -1


@njit({strict})
def not_a_number(vectors):
    """The first particle whose vector is not finite, else -1."""
    for i in range(len(vectors)):
        for k in range(vectors.shape[1]):
            if not abs(vectors[i, k]) < np.inf:
                return i
    return -1


@njit({strict})
def advance(x, v, dt, steps, fastest, mass, viscosity, force, lower, upper, kinds, axis, velocities, spacing, support,
            state, constants, table, index, right, density, pressure):
    """Steps of the midpoint rule; the number made, what failed (a key of CAUSES, else 0) and at which particle."""
    count, dimension = x.shape
    acceleration, x_half, v_half = np.empty_like(x), np.empty_like(x), np.empty_like(x)
    for step in range(steps):
        for i in range(count):
            for k in range(dimension):
                x_half[i, k], v_half[i, k] = x[i, k], v[i, k]
        for half in range(2):  # one call: a second would be compiled a second time
            failed = rates(x_half, v_half, mass, viscosity, force, lower, upper, kinds, axis, velocities, spacing,
                           support, state, constants, table, index, right, density, pressure, acceleration)
            if failed >= 0:
                return step, 1, failed
            failed = not_a_number(acceleration)
            if failed >= 0:
                return step, 2, failed
            if half == 0:
                for i in range(count):
                    for k in range(dimension):
                        x_half[i, k] = x[i, k] + 0.5 * dt * v[i, k]
                        v_half[i, k] = v[i, k] + 0.5 * dt * acceleration[i, k]
        square = 0.0
        fast, outside = 0, -1
        for i in range(count):
            speed = 0.0
            for k in range(dimension):
                x[i, k] += dt * v_half[i, k]
                v[i, k] += dt * acceleration[i, k]
                if kinds[k] == 0:
                    x[i, k] = lower[k] + (x[i, k] - lower[k]) % (upper[k] - lower[k])
                elif not lower[k] < x[i, k] < upper[k]:
                    outside = i
                speed += v[i, k] * v[i, k]
            if speed > square:
                square, fast = speed, i
        if outside >= 0:
            return step + 1, 4, outside
        if square > fastest * fastest:
            return step + 1, 3, fast
    return steps, 0, -1
'''


def loop_module(
    dimension: int,
    density: Interaction,
    equation_of_state: Any,
    preparation: Any,
    stages: tuple[Interaction, ...],
    wall_velocity: str,
) -> ModuleType:
    """The compiled time loop of one combination of formulas.

    Args:
        dimension: 2 or 3.
        density: the interaction that gives the density from the fields `mass`.
        equation_of_state: gives the pressure from the density.
        preparation: what the stages know as `own.prepared`, or None.
        stages: the interactions whose last gives the acceleration; each knows the one before as `before`.
        wall_velocity: a name of `WALL_VELOCITIES`.
    """
    sweeps = _Sweeps(dimension)
    density_text = [
        *sweeps.text(density, (), "nothing", "found"),
        "for i in range(count):",
        "    density[i] = found[i, 0]",
    ]
    preparation_text, own = sweeps.preparation(preparation)
    stage_text: list[str] = []
    for number, stage in enumerate(stages):
        stage_text += sweeps.text(stage, own, "prepared", f"stage{number}")
        stage_text += [f"before = result = stage{number}"]
    text = _LOOP.format(
        title=f"weakly compressible flow: {type(stages[-1]).__name__}",
        list_module=list_module(dimension).__name__,
        imports="\n".join(sweeps.imports),
        wall_velocity=wall_velocity,
        options=options_text(),
        strict=options_text(strict=True),  # finds numbers that are not finite
        # first derivatives at mirror particles need their neighbours, which lie twice as deep
        layers=len(stages),
        rows="count" if len(stages) == 1 else "entries",
        axes=", ".join(f"coordinates[{axis}]" for axis in range(dimension)),
        mirrored=wall_velocity == "mirror",
        density=_block(density_text, 4),
        equation_of_state=_block(_equation_of_state(equation_of_state), 8),
        preparation=_block(preparation_text, 4),
        stages=_block(stage_text, 4),
    )
    return generated_module(text)


def _block(lines: list[str], indent: int) -> str:
    return ("\n" + " " * indent).join(lines) if lines else "pass"


def _equation_of_state(equation: Any) -> list[str]:
    trace, numbers = Trace(), count()
    formula = with_symbols(equation, lambda: trace.input(f"state[{next(numbers)}]"))
    result = formula.pressure(trace.input("rho"))
    lines, _ = trace.code([result])
    return ["rho = density[i]", *lines, f"pressure[i] = {result}"]


class _Sweeps:
    """The sweeps of a step: their modules, and the text that packs their records and calls them."""

    def __init__(self, dimension: int) -> None:
        self.dimension = dimension
        self.imports: list[str] = []
        self.before: tuple[Shape, ...] = ()

    def text(self, interaction: Interaction, own: tuple[Shape, ...], prepared: str, result: str) -> list[str]:
        """Pack, sweep and keep the result, one row for each particle (or image) in the order of `target`."""
        number = len(self.imports)
        formula = self._formula(interaction, own)
        module = generated_module(sweep_text(formula, type(interaction).__name__, self.dimension, "float64"))
        self.imports.append(f"from {module.__name__} import sweep as sweep{number}")
        columns = [f"positions[e, {axis}]" for axis in range(self.dimension)]
        columns += [_COLUMNS[name].format(k=k) for name, k in formula.columns]
        private = [_COLUMNS[name].format(k=k) for name, k in formula.private]
        self.before = (("before", (0.0,) * len(formula.finish_outputs)),)
        return [
            f"records{number} = np.empty((entries, {-(-len(columns) // 4) * 4}))",
            f"private{number} = np.empty((entries, {len(private)}))",
            "for s in range(entries):",
            "    e = order[s]",
            "    i = source[e]",
            *(f"    records{number}[s, {column}] = {value}" for column, value in enumerate(columns)),
            *(f"    private{number}[s, {column}] = {value}" for column, value in enumerate(private)),
            f"{result} = np.empty((len(entry), {len(formula.finish_outputs)}))",
            f"sweep{number}(constants[{number}], far, records{number}, private{number}, {prepared}, {result}, "
            f"{'numbers' if result == 'prepared' else 'target'}, entry, first, neighbour, 0, len(entry), 0)",
        ]

    def preparation(self, interaction: Any) -> tuple[list[str], tuple[Shape, ...]]:
        """The text of a preparation, with its test, and the form of what is prepared."""
        if interaction is None:
            return [], ()
        lines = ["numbers = np.arange(len(entry)).astype(np.int32)", *self.text(interaction, (), "nothing", "prepared")]
        if hasattr(interaction, "solve"):
            lines += [
                "solved = np.empty((len(entry), 1 + len(right)))",
                "solve_normal_equations(prepared, index, right, solved[:, 0], solved[:, 1:])",
                "prepared = solved",
            ]
            form = interaction.template(self.dimension)
        else:
            form = self._formula(interaction, ()).result
        lines += [
            "for row in range(len(entry)):",
            f"    if target[row] < count and not prepared[row, 0] > {interaction.least_quality!r}:",
            "        return target[row]",
        ]
        return lines, (("prepared", form),)

    def _formula(self, interaction: Interaction, own: tuple[Shape, ...]) -> TracedFormula:
        zeros = (0.0,) * self.dimension
        scalars = tuple((name, 0.0) for name in _COLUMNS if name not in ("velocity", "before"))
        return traced(interaction, self.dimension, (*scalars, ("velocity", zeros), *self.before), own)
