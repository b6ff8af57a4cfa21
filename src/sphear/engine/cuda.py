"""The same traced formulas as a CUDA kernel: one thread a particle. Needs the extra `cuda`.

This writes and compiles the sweep; it needs the compiler but no GPU. The particles, their order and the pair list are
those of the CPU.
"""

from __future__ import annotations

from sphear.engine.cache import generated_module
from sphear.engine.formula import Interaction, Shape, TracedFormula, traced

_SWEEP = '''
"""{title}"""

from math import exp, sqrt
from numba import cuda


def sweep(parameters, records, private, own, out, target, entry, first, neighbour):
    """out[target[row]] = finish(sum over the neighbours of row), one thread a row."""
    row = cuda.grid(1)
    if row >= len(entry):
        return
    i = entry[row]
    {parameters}
    {own}
    {zeros}
    for k in range(first[row], first[row + 1]):
        j = neighbour[k]
        {other}
        {differences}
        r2 = {square}
        {pair}
        {accumulate}
    {finish}
    {store}
'''


def _without_functions(line: str) -> str:
    """An assignment with the functions of `sphear.algebra` that CUDA lacks written out; their operands are names."""
    target, _, call = line.partition(" = ")
    function, _, inside = call.rstrip(")").partition("(")
    operands = inside.split(", ")
    if function == "positive_part":
        return f"{target} = max({operands[0]}, 0.0)"
    if function == "where_less":
        a, b, yes, no = operands
        return f"{target} = {yes} if {a} < {b} else {no}"
    return line


def _block(lines: list[str], indent: int) -> str:
    return ("\n" + " " * indent).join(lines) if lines else "pass"


def cuda_text(formula: TracedFormula, title: str, dimension: int) -> str:
    """The module of one sweep on a GPU: scalars where the CPU has lanes."""
    axes = range(dimension)
    columns = list(enumerate(formula.columns, dimension))
    own = [f"own_x{axis} = records[i, {axis}]" for axis in axes]
    own += [f"own_{f}_{k} = records[i, {column}]" for column, (f, k) in columns]
    own += [f"own_{f}_{k} = private[i, {column}]" for column, (f, k) in enumerate(formula.private)]
    own += [f"{name} = own[row, {column}]" for name, column in zip(formula.own_names, formula.own_columns, strict=True)]
    sums = range(len(formula.pair_outputs))
    return _SWEEP.format(
        title=title,
        parameters=_block([f"p{k} = parameters[{k}]" for k in range(formula.parameter_count)], 4),
        own=_block(own, 4),
        zeros=_block([f"total{k} = 0.0" for k in sums], 4),
        other=_block([f"other_{f}_{k} = records[j, {column}]" for column, (f, k) in columns], 8),
        differences=_block([f"d{axis} = own_x{axis} - records[j, {axis}]" for axis in axes], 8),
        square=" + ".join(f"d{axis} * d{axis}" for axis in axes),
        pair=_block([_without_functions(line) for line in formula.pair_lines], 8),
        accumulate=_block([f"total{k} += {x}" for k, x in enumerate(formula.pair_outputs)], 8),
        finish=_block([_without_functions(line) for line in formula.finish_lines], 4),
        store=_block([f"out[target[row], {k}] = {x}" for k, x in enumerate(formula.finish_outputs)], 4),
    )


def ptx(
    interaction: Interaction,
    dimension: int,
    shared: tuple[Shape, ...],
    own_only: tuple[Shape, ...] = (),
    *,
    dtype: str = "float64",
    compute_capability: tuple[int, int] = (9, 0),
) -> str:
    """The machine code (PTX) of an interaction's sweep for a GPU that need not be there.

    Args:
        interaction, dimension, shared, own_only: as `sphear.engine.formula.traced` takes them.
        dtype: "float64" or "float32".
        compute_capability: of the GPU.
    """
    from numba import cuda, types

    formula = traced(interaction, dimension, shared, own_only)
    module = generated_module(cuda_text(formula, type(interaction).__name__, dimension))
    scalar = getattr(types, dtype)
    table, numbers = types.Array(scalar, 2, "C"), types.Array(types.int32, 1, "C")
    firsts = types.Array(types.int64, 1, "C")
    signature = types.void(types.Array(scalar, 1, "C"), table, table, table, table, numbers, numbers, firsts, numbers)
    text, _ = cuda.compile_ptx(module.sweep, signature, cc=compute_capability, fastmath=True)
    return str(text)
