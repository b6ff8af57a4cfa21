"""Runs the sweeps of an operator chunk by chunk: what is prepared for a particle is used while it is in the cache."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from sphear.engine.formula import Interaction
from sphear.engine.preparation import Preparation
from sphear.engine.preparing import PreparationSweep, deficient
from sphear.engine.sweep import Sweep
from sphear.engine.threads import on_threads
from sphear.neighbours import Chunk, Neighbours

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class Operation:
    """The sweeps of an operator.

    Attributes:
        stages: interactions, each knowing the result of the one before as the field `before`.
        preparation: the interaction whose result they know as `own.prepared`; None if they need none.
    """

    stages: Sequence[Interaction]
    preparation: Preparation | None = None


@dataclass(frozen=True)
class Outcome:
    """The result of all particles, (N, numbers), and the particles whose preparation was too nearly singular."""

    values: Array
    deficient: Array


def _unprepared(
    operation: Operation, neighbours: Neighbours, fields: dict[str, Array], each_pair_once: bool, dtype: str
) -> Outcome:
    for stage in operation.stages:
        result = Sweep(stage, neighbours, fields, each_pair_once=each_pair_once, dtype=dtype).everywhere()
        fields = {**fields, "before": result}
    return Outcome(result, np.empty(0, np.int64))


def run(
    operation: Operation,
    neighbours: Neighbours,
    fields: dict[str, Array],
    *,
    plain: Operation | None = None,
    each_pair_once: bool = False,
    dtype: str = "float64",
) -> Outcome:
    """The stages of an operation one after the other.

    Args:
        operation: what is summed.
        neighbours: the pairs.
        fields: arrays (N,) or (N, k), by name; with `volume`.
        plain: stands in for each stage at deficient particles, so that the next stage meets numbers there; it needs
            no preparation and has as many stages.
        each_pair_once: compute both sides of a pair together where nothing is prepared for either.
        dtype: "float64" or "float32".
    """
    if operation.preparation is None:
        return _unprepared(operation, neighbours, fields, each_pair_once, dtype)
    preparation = operation.preparation
    prepared = PreparationSweep(preparation, neighbours, {"volume": fields["volume"]}, dtype)
    deficient_ones: list[Array] = []
    lacking = np.empty(0, np.int64)
    result = np.empty((neighbours.count, 0))
    for number, stage in enumerate(operation.stages):
        known = fields if number == 0 else {**fields, "before": result}
        sweep = Sweep(stage, neighbours, known, own=prepared.template, dtype=dtype)
        out = np.empty((neighbours.count, sweep.outputs), dtype)

        def job(chunk: Chunk, sweep: Sweep = sweep, out: Array = out, first: bool = number == 0) -> None:
            own = prepared.over(chunk)
            if first and len(lacking := deficient(preparation, own)):
                deficient_ones.append(neighbours.particles(chunk)[lacking])
            sweep.over(chunk, out, neighbours.particles(chunk), own)

        on_threads(job, neighbours.chunks, neighbours.threads)
        lacking = np.sort(np.concatenate(deficient_ones)) if deficient_ones else np.empty(0, np.int64)
        if plain is not None and len(lacking):
            out[lacking] = Sweep(plain.stages[number], neighbours, known, dtype=dtype).everywhere()[lacking]
        result = out
    return Outcome(result, lacking)
