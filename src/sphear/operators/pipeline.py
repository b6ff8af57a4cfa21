"""Runs the sweeps of an operator chunk by chunk: what is prepared for a particle is used while it is in the cache."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from sphear.engine.formula import Interaction
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
    preparation: Any = None


@dataclass(frozen=True)
class Outcome:
    """The result of all particles, (N, numbers), and the particles whose preparation was too nearly singular."""

    values: Array
    deficient: Array


class Preparation:
    """Sums for each particle of a chunk that an interaction needs before its own sweep.

    Args:
        interaction: a preparation; `quality` is the first number of its result.
        neighbours: the pairs.
        volumes: (N,).
        dtype: of the sums.
    """

    def __init__(self, interaction: Any, neighbours: Neighbours, volumes: Array, dtype: str) -> None:
        self.interaction = interaction
        self.sweep = Sweep(interaction, neighbours, {"volume": volumes}, dtype=dtype)
        solved = hasattr(interaction, "solve")
        self.dimension = neighbours.dimension
        result = interaction.template(self.dimension) if solved else self.sweep.formula.result
        self.template = (("prepared", result),)

    def over(self, chunk: Chunk) -> tuple[Array, Array]:
        """The prepared numbers of the chunk's rows, in their order, and which of these rows are deficient."""
        rows = chunk.end - chunk.begin
        out = np.empty((rows, self.sweep.outputs), self.sweep.dtype)
        self.sweep.over(chunk, out, np.arange(rows, dtype=np.int32))
        if hasattr(self.interaction, "solve"):
            out = self.interaction.solve(out, self.dimension).astype(self.sweep.dtype, copy=False)
        # the first number is the quality, of which rounding of the sums leaves some digits; a NaN is deficient too
        least = max(self.interaction.least_quality, 100 * float(np.finfo(self.sweep.dtype).eps))
        return out, np.flatnonzero(~(out[:, 0] > least))


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
    prepared = Preparation(operation.preparation, neighbours, fields["volume"], dtype)
    deficient: list[Array] = []
    lacking = np.empty(0, np.int64)
    result = np.empty((neighbours.count, 0))
    for number, stage in enumerate(operation.stages):
        known = fields if number == 0 else {**fields, "before": result}
        sweep = Sweep(stage, neighbours, known, own=prepared.template, dtype=dtype)
        out = np.empty((neighbours.count, sweep.outputs), dtype)

        def job(chunk: Chunk, sweep: Sweep = sweep, out: Array = out, first: bool = number == 0) -> None:
            own, lacking = prepared.over(chunk)
            if first and len(lacking):
                deficient.append(neighbours.particles(chunk)[lacking])
            sweep.over(chunk, out, neighbours.particles(chunk), own)

        on_threads(job, neighbours.chunks, neighbours.threads)
        lacking = np.sort(np.concatenate(deficient)) if deficient else np.empty(0, np.int64)
        if plain is not None and len(lacking):
            out[lacking] = Sweep(plain.stages[number], neighbours, known, dtype=dtype).everywhere()[lacking]
        result = out
    return Outcome(result, lacking)
