"""The passages of a time loop's text: velocities of images, pressure, walls, preparations, and the rates."""

from __future__ import annotations

from itertools import count

from sphear.engine.formula import Shape
from sphear.engine.structure import with_symbols
from sphear.engine.trace import Trace
from sphear.equations_of_state import EquationOfState
from sphear.interactions import VelocityBeforeWall
from sphear.schemes.formulas import Formulas
from sphear.schemes.sweeps import Sweeps


def mirror_text(continuation: str) -> list[str]:
    """Velocities of all entries, those of images as `continuation` continues them."""
    return [
        "velocity = np.empty((entries, dimension))",
        "for e in range(entries):",
        "    for k in range(dimension):",
        "        velocity[e, k] = v[source[e], k]",
        "for axis in range(dimension):",
        "    if kinds[axis] == 1:",
        "        along, nodes = wall_nodes(lower, upper, kinds, axis, spacing)",
        "        a, b = np.zeros((nodes, 2, dimension)), np.zeros((nodes, 2, dimension))",
        "        fit(x[:count], v, lower, upper, axis, along, velocities[axis], spacing, a, b)",
        "        mirror_velocities(v, positions, source, wall, lower, upper, kinds, axis, velocities[axis], spacing,",
        f"                          a, b, {continuation == 'mirror'}, velocity)",
    ]


def pressure_text(equation: EquationOfState) -> list[str]:
    """The pressure of particle i, from its density and energy."""
    trace, numbers = Trace(), count()
    formula = with_symbols(equation, lambda: trace.input(f"state[{next(numbers)}]"))
    result = formula.pressure(trace.input("rho"), trace.input("energy"))
    lines, _ = trace.code([result])
    energy = ["energy = f.energy[i]"] if equation.uses_energy else []
    return ["rho = f.density[i]", *energy, *lines, f"f.pressure[i] = {result}"]


def wall_text(sweeps: Sweeps, formulas: Formulas, rows: tuple[str, str]) -> list[str]:
    """What wall particles take from the fluid: their velocity, and of Adami's their pressure and density."""
    if formulas.wall is None:
        return []
    lines = sweeps.text(formulas.wall, "before_wall", rows, size="total")
    if isinstance(formulas.wall, VelocityBeforeWall):
        return [
            *lines,
            "for i in range(count, total):",
            "    nearest = f.nearest[i - count]",
            "    for k in range(dimension):",
            "        bend = before_wall[nearest, dimension + k] * f.depth[i] ** 2",
            "        straight = abs(f.normal[i, k]) < 0.5 and f.depth[i] > 0.0",
            "        v[i, k] = f.wall_velocity[i, k]",
            "        if straight:  # along the wall; through it the particle does not move",
            "            v[i, k] += bend - before_wall[nearest, k] * f.depth[i]",
        ]
    trace, numbers = Trace(), count()
    state = with_symbols(formulas.wall_state, lambda: trace.input(f"wall_state[{next(numbers)}]"))
    density = state.density(trace.input("pressure"), trace.input("energy"))
    code, _ = trace.code([density])
    present = f"{density} if pressure > 0.0 else f.density[i]" if formulas.wall_state.uses_energy else density
    return [
        *lines,
        "for i in range(count, total):",
        "    for k in range(dimension):",
        "        v[i, k] = before_wall[i, k]",
        "    pressure = f.pressure[i] = before_wall[i, dimension]",
        *(["    energy = f.energy[i]"] if formulas.wall_state.uses_energy else []),
        *(f"    {line}" for line in code),
        # summed densities are those of the particles' places, as the fluid's are; out of its reach gas has no pressure
        *([f"    f.density[i] = {present}"] if formulas.density is None else []),
    ]


def preparations_text(sweeps: Sweeps, formulas: Formulas, rows: tuple[str, str]) -> tuple[list[str], tuple[Shape, ...]]:
    """The text of the preparations, with their tests, and the form of what is prepared."""
    if not formulas.preparations:
        return [], ()
    lines = ["numbers = np.arange(len(entry)).astype(np.int32)"]
    own: list[Shape] = []
    for number, (name, interaction) in enumerate(formulas.preparations):
        found = f"prepared{number}"
        lines += sweeps.text(interaction, found, rows, by_row=True)
        sweeps.before = ()
        if hasattr(interaction, "solve"):
            lines += [
                "solved = np.empty((len(entry), 1 + len(right)))",
                f"solve_normal_equations({found}[:{rows[1]}], moments, right, solved[:{rows[1]}, 0],",
                f"                       solved[:{rows[1]}, 1:])",
                f"{found} = solved",
            ]
            form = interaction.template(sweeps.dimension)
        else:
            form = sweeps.formula(interaction).result
        lines += [
            f"for row in range({rows[1]}):",
            f"    if target[row] < count and not {found}[row, 0] > {interaction.least_quality!r}:",
            "        return target[row]",
        ]
        own.append((name, form))
    if len(own) == 1:
        return [*lines, "prepared = prepared0"], tuple(own)
    return [*lines, "prepared = np.hstack((prepared0, prepared1))"], tuple(own)


def result_text(formulas: Formulas, dimension: int, integrated_walls: bool) -> list[str]:
    """The rates, out of the columns of the last stage."""
    lines = ["for i in range(count):", "    for k in range(dimension):"]
    lines += [f"        change.velocity[i, k] = stage{len(formulas.stages) - 1}[i, k] + force[k]"]
    column = dimension
    last = f"stage{len(formulas.stages) - 1}"
    for role in formulas.rates.roles[1:]:
        if role in ("drift", "density_gradient"):
            rows = "total" if role == "density_gradient" and integrated_walls else "count"
            lines += [f"for i in range({rows}):", "    for k in range(dimension):"]
            lines += [f"        f.{role}[i, k] = {last}[i, {column} + k]"]
            column += dimension
        else:
            rows = "total" if role == "density" and integrated_walls else "count"
            lines += [f"for i in range({rows}):", f"    change.{role}[i] = {last}[i, {column}]"]
            column += 1
    return lines
