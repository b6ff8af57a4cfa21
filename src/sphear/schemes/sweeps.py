"""The text that packs the records of a step's sweeps and calls them."""

from __future__ import annotations

from sphear.engine.cache import generated_module
from sphear.engine.formula import Interaction, Shape, TracedFormula, traced
from sphear.engine.program import sweep_text

# what a record's column holds for entry e, an image of particle i
COLUMNS = {
    "mass": "f.mass[i]",
    "dynamic_viscosity": "f.viscosity[i]",
    "density": "f.density[i]",
    "volume": "f.mass[i] / f.density[i]",
    "pressure": "f.pressure[i]",
    "pressure_over_density2": "f.pressure[i] / (f.density[i] * f.density[i])",
    "inverse_density2": "1.0 / (f.density[i] * f.density[i])",
    "depth": "f.depth[i]",
    "fluid": "1.0 if i < count else 0.0",
    "velocity": "v[i, {k}]",
    "slip_velocity": "(-u[i, {k}] if (wall[e] >> (2 * {k})) & 3 else u[i, {k}])",
    "normal": "f.normal[i, {k}]",
    "wall_velocity": "f.wall_velocity[i, {k}]",
    "body_force": "force[{k}]",
    # an image has it reflected across its walls, and one on a wall stays there
    **{
        name: f"(0.0 if wall[e] & 64 else f.{name}[i, {{k}}] * (-1.0 if (wall[e] >> (2 * {{k}})) & 3 else 1.0))"
        for name in ("drift", "density_gradient")
    },
    "before": "before[e, {k}]",
}
VECTORS = ("velocity", "slip_velocity", "normal", "wall_velocity", "body_force", "drift", "density_gradient")

_PACK = '''
@njit({options}{parallel})
def pack{number}(parts, order, source, wall, positions, v, u, f, count, force, before, records, private):
    """The records of sweep {number}, in the order of the cells."""
    entries = len(order)
    for part in prange(parts):
        for s in range(entries * part // parts, entries * (part + 1) // parts):
            e = order[s]
            i = source[e]
            {lines}


@njit({options}{parallel})
def rows{number}(parameters, far, records, private, own, out, target, entry, first, neighbour, bounds, low, high):
    """Sweep {number} over the rows low ... high."""
    for part in prange(len(bounds) - 1):
        origin = bounds[part]
        begin, end = max(low, origin), min(high, bounds[part + 1])
        if begin < end:
            sweep{number}(parameters, far, records, private, own[origin:], out, target[origin:], entry, first[part],
                          neighbour[part], begin, end, origin)
'''


def block(lines: list[str], indent: int) -> str:
    """Lines at a place of a text that is indented so far."""
    return ("\n" + " " * indent).join(lines) if lines else "pass"


class Sweeps:
    """The sweeps of a step, numbered in the order of their calls.

    Args:
        dimension: 2 or 3.
        images_move: whether images have velocities of their own, in the array `velocity` of the entries.
        options: of the compiler.
        parallel: further ones, of loops over parts.
    """

    def __init__(self, dimension: int, images_move: bool, options: str, parallel: str) -> None:
        self.dimension = dimension
        self.columns = COLUMNS | ({"velocity": "v[e, {k}]"} if images_move else {})
        self.velocity = "velocity" if images_move else "v"
        self.options, self.parallel = options, parallel
        self.imports: list[str] = []
        self.functions: list[str] = []
        self.before: tuple[Shape, ...] = ()

    def text(
        self,
        interaction: Interaction,
        result: str,
        rows: tuple[str, str],
        *,
        own: tuple[Shape, ...] = (),
        prepared: str = "nothing",
        size: str = "len(entry)",
        by_row: bool = False,
    ) -> list[str]:
        """Pack, sweep and keep the result.

        Args:
            interaction: what is summed.
            result: the name of the array that it is kept in.
            rows: the first row and the one after the last, as text.
            own: the form of what has been prepared.
            prepared: the array that holds it.
            size: the rows of the result.
            by_row: keep the result by the row of the list, instead of by the entry that it is of.
        """
        number = len(self.imports)
        formula = self.formula(interaction, own)
        module = generated_module(sweep_text(formula, type(interaction).__name__, self.dimension, "float64"))
        self.imports.append(f"from {module.__name__} import sweep as sweep{number}")
        columns = [f"positions[e, {axis}]" for axis in range(self.dimension)]
        columns += [self.columns[name].format(k=k) for name, k in formula.columns]
        private = [self.columns[name].format(k=k) for name, k in formula.private]
        lines = [f"records[s, {column}] = {value}" for column, value in enumerate(columns)]
        lines += [f"private[s, {column}] = {value}" for column, value in enumerate(private)]
        self.functions.append(
            _PACK.format(number=number, options=self.options, parallel=self.parallel, lines=block(lines, 12))
        )
        self.before = (("before", (0.0,) * len(formula.finish_outputs)),)
        target = "numbers" if by_row else "target"
        return [
            f"records{number} = np.empty((entries, {-(-len(columns) // 4) * 4}))",
            f"private{number} = np.empty((entries, {len(private)}))",
            f"pack{number}(parts, order, source, wall, positions, {self.velocity}, v, f, count,"
            f" force, before, records{number}, private{number})",
            f"{result} = np.empty(({size}, {len(formula.finish_outputs)}))",
            f"rows{number}(constants[{number}], far, records{number}, private{number}, {prepared}, {result}, {target},"
            f" entry, first, neighbour, bounds, {rows[0]}, {rows[1]})",
        ]

    def formula(self, interaction: Interaction, own: tuple[Shape, ...] = ()) -> TracedFormula:
        """The interaction, traced with the columns as its fields."""
        zeros = (0.0,) * self.dimension
        scalars = tuple((name, 0.0) for name in COLUMNS if name not in (*VECTORS, "before"))
        vectors = tuple((name, zeros) for name in VECTORS)
        return traced(interaction, self.dimension, (*scalars, *vectors, *self.before), own)
