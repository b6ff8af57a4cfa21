"""Source text of a sweep: a traced formula put into the loop over the pair list."""

from __future__ import annotations

from sphear.engine.flags import lane_count, options_text
from sphear.engine.formula import TracedFormula

_HEAD = '''
"""{title}"""

from sphear.engine.cache import njit
from sphear.engine.lanes import exp, first_lanes, lane_zeros, lanes_sum, positive_part, sqrt, where_less
from sphear.engine.records import record_adder, record_loader

load = record_loader({width}, {loaded})
zeros = lane_zeros({dtype!r}, {width})
'''

_PAIRS_OF_ROW = """
    {parameters}
    for row in range(begin, end):
        i = entry[row]
        {own}
        {zeros}
        stop = first[row - origin + 1]
        for k in range(first[row - origin], stop, {width}):
            {other}= load(records, neighbour, k)
            {differences}
            r2 = {square}
            {pair}
            {accumulate}
"""

_SWEEP = f'''{_HEAD}

@njit({{options}})
def sweep(parameters, far, records, private, own, out, target, entry, first, neighbour, begin, end, origin):
    """out[target[row - origin]] = finish(sum over the neighbours of row), for the rows begin ... end of a chunk."""
    {_PAIRS_OF_ROW.strip()}
        {{total}}
        {{finish}}
        {{store}}
'''

_WEIGHTS = f'''{_HEAD}
from sphear.engine.weights import lane_storer

store = lane_storer({{width}}, {{outputs}})


@njit({{options}})
def weights(parameters, far, records, private, own, values, entry, first, neighbour, begin, end, origin):
    """values[c, k] = what the pair k of the list gives, for the rows begin ... end of a chunk."""
    {_PAIRS_OF_ROW.strip()}
'''

_BOTH_SIDES = f'''{_HEAD}
add = record_adder({{width}}, {{sums}})


@njit({{options}})
def sweep(parameters, far, records, private, sums, entry, first, neighbour, begin, end, origin):
    """Add to sums[i] and sums[j] what each listed pair (i, j) contributes to either."""
    {_PAIRS_OF_ROW.strip()}
            add(sums, neighbour, k, ({{reverse}}))
        {{own_sums}}


@njit({{options}})
def finish(parameters, records, private, sums, out, target, entry, begin, end, origin):
    """out[target[row - origin]] = finish(sums[i]), for the rows begin ... end of a chunk."""
    {{parameters}}
    for row in range(begin, end):
        i = entry[row]
        {{own}}
        {{total}}
        {{finish}}
        {{store}}
'''


def _block(lines: list[str], indent: int) -> str:
    return ("\n" + " " * indent).join(lines) if lines else "pass"


def _in_lanes(outputs: tuple[str, ...]) -> list[str]:
    """Outputs as lanes, also those that are the same for every neighbour."""
    return [f"{x} + zeros()" for x in outputs]


def sweep_text(formula: TracedFormula, title: str, dimension: int, dtype: str) -> str:
    """The module of one sweep on the CPU, `lane_count` neighbours at a time.

    Lanes beyond a particle's last neighbour are put at a distance `far` outside the support, where every kernel is
    zero, so that the loop needs no remainder.
    """
    template = _BOTH_SIDES if formula.reverse_outputs else _SWEEP
    return template.format(**_parts(formula, title, dimension, dtype))


def weights_text(formula: TracedFormula, title: str, dimension: int, dtype: str) -> str:
    """The module that keeps what each pair gives, instead of the sum."""
    kept = f"store(values, k, ({''.join(f'{x}, ' for x in _in_lanes(formula.pair_outputs))}))"
    parts = {**_parts(formula, title, dimension, dtype), "zeros": "pass", "accumulate": kept}
    return _WEIGHTS.format(**parts)


def _parts(formula: TracedFormula, title: str, dimension: int, dtype: str) -> dict[str, object]:
    """The pieces of text that the templates are filled with."""
    axes = range(dimension)
    width = lane_count(dtype)
    others = [f"x{axis}" for axis in axes] + [f"other_{f}_{k}" for f, k in formula.columns]
    own = [f"own_x{axis} = records[i, {axis}]" for axis in axes]
    own += [f"own_{f}_{k} = records[i, {dimension + column}]" for column, (f, k) in enumerate(formula.columns)]
    own += [f"own_{f}_{k} = private[i, {column}]" for column, (f, k) in enumerate(formula.private)]
    own += [
        f"{name} = own[row - origin, {column}]"
        for name, column in zip(formula.own_names, formula.own_columns, strict=True)
    ]
    sums = range(len(formula.pair_outputs))
    both = bool(formula.reverse_outputs)
    return {
        "sums": len(sums),
        "outputs": len(sums),
        "reverse": "".join(f"{x}, " for x in _in_lanes(formula.reverse_outputs)),
        "own_sums": _block([f"sums[i, {k}] += lanes_sum(sum{k})" for k in sums], 8),
        "title": title,
        "width": width,
        "loaded": len(others),
        "dtype": dtype,
        "options": options_text(),
        "parameters": _block([f"p{k} = parameters[{k}]" for k in range(formula.parameter_count)], 4),
        "own": _block(own, 8),
        "zeros": _block([f"sum{k} = zeros()" for k in sums], 8),
        "other": "".join(f"{name}, " for name in others),
        "differences": _block(
            ["d0 = first_lanes(own_x0 - x0, stop - k, far)", *(f"d{a} = own_x{a} - x{a}" for a in axes if a)], 12
        ),
        "square": " + ".join(f"d{a} * d{a}" for a in axes),
        "pair": _block(list(formula.pair_lines), 12),
        "accumulate": _block([f"sum{k} = sum{k} + {x}" for k, x in enumerate(formula.pair_outputs)], 12),
        "total": _block([f"total{k} = sums[i, {k}]" if both else f"total{k} = lanes_sum(sum{k})" for k in sums], 8),
        "finish": _block(list(formula.finish_lines), 8),
        "store": _block([f"out[target[row - origin], {k}] = {x}" for k, x in enumerate(formula.finish_outputs)], 8),
    }
