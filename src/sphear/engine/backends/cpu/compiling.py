"""The calls that the stages of a step become."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from sphear.engine.backends.cpu import checks, entries, preparing, sizes
from sphear.engine.backends.cpu.image_velocities import image_velocities
from sphear.engine.backends.cpu.memory import Memory
from sphear.engine.backends.cpu.pair_list import list_pairs
from sphear.engine.backends.cpu.pair_sum import Sum, pair_sum
from sphear.engine.backends.cpu.particle_text import Field
from sphear.engine.backends.cpu.per_particle import per_particle
from sphear.engine.backends.cpu.written import WrittenStage
from sphear.engine.cache import generated_module
from sphear.engine.formula import Shape
from sphear.engine.preparation import NormalEquations, form_of
from sphear.engine.stages import (
    CheckFinite,
    CheckPositive,
    EnterBox,
    Images,
    ImageVelocities,
    Neighbours,
    PairSum,
    PerParticle,
    Prepare,
    Rows,
    Stage,
)
from sphear.engine.structure import parameters

Array = np.ndarray[Any, Any]

SIZES = {Rows.FLUID: sizes.FLUID, Rows.PARTICLES: sizes.PARTICLES, Rows.ENTRIES: sizes.LISTED}
BOTH = "both"  # the array of what two preparations have prepared


@dataclass(frozen=True)
class Call:
    """Compiled code, the names of the arrays in its table, and the stage that it belongs to."""

    code: Any
    arrays: tuple[str, ...]
    stage: Stage


class Compiler:
    """Turns stages into calls, and has memory keep the arrays between them.

    Args:
        memory: of the program.
        fields: of the particles.
        parallel: whether loops over parts are shared out to threads.

    Attributes:
        calls: of the stages so far.
    """

    def __init__(self, memory: Memory, fields: dict[str, Field], parallel: bool) -> None:
        self.calls: list[Call] = []
        self._memory, self._fields, self._parallel = memory, fields, parallel
        self._dimension = int(memory.sizes[sizes.DIMENSION])
        self._continued = False  # whether images have velocities of their own
        self._prepared: dict[str, tuple[int, Shape]] = {}  # the width and form of each preparation
        self._joined = False  # whether what two have prepared stands side by side

    def add(self, stage: Stage) -> None:
        """Append the calls of a stage."""
        match stage:
            case Images():
                reach = stage.supports * self._memory.number("support")
                on_walls = self._memory.number("spacing") if stage.on_walls else 0.0
                self._call(stage, entries.images, (self._constant([reach, on_walls]), *entries.IMAGES[1:]))
            case ImageVelocities():
                self._continued = True
                self._memory.for_entries("image_velocity", self._dimension)
                self._write(stage, image_velocities(self._dimension, stage.continuation))
            case Neighbours():
                of_images = self._constant([1.0 if stage.of_images else 0.0])
                self._call(stage, entries.sort, entries.SORT)
                self._call(stage, entries.choose_rows, (of_images, *entries.CHOOSE_ROWS[1:]))
                self._write(stage, list_pairs(self._dimension))
            case PairSum():
                self._pair_sum(stage)
            case Prepare():
                self._prepare(stage)
            case PerParticle():
                self._write(stage, per_particle(stage, self._fields, self._constant(parameters(stage.formula))))
            case CheckFinite():
                self._call(stage, checks.check_finite, (stage.field,))
            case CheckPositive():
                self._call(stage, checks.check_positive, (stage.field,))
            case EnterBox():
                limits = self._constant([self._memory.number("spacing"), stage.fastest])
                self._call(stage, checks.enter_box, (limits, *checks.ENTER_BOX[1:]))

    def _call(self, stage: Stage, code: Any, arrays: Sequence[str]) -> None:
        self.calls.append(Call(code, tuple(arrays), stage))

    def _write(self, stage: Stage, written: WrittenStage) -> None:
        self._call(stage, generated_module(written.text(self._parallel)).stage, written.arrays)

    def _constant(self, values: Sequence[float] | Array, dtype: Any = np.float64) -> str:
        """The name of an array of numbers."""
        return self._memory.add_numbers(np.array(values if len(values) else [0.0], dtype))

    def _sum(self, stage: Stage, summed: Sum) -> int:
        """Append a sum; the width of its result."""
        written, widths = pair_sum(
            summed, self._fields, self._dimension, self._continued, self._constant(parameters(summed.interaction))
        )
        for name, width in widths.items():
            self._memory.for_entries(name, width)
        self._write(stage, written)
        return widths[summed.result]

    def _pair_sum(self, stage: PairSum) -> None:
        own = tuple((name, self._prepared[prepare.result][1]) for name, prepare in stage.preparations)
        results = [prepare.result for _, prepare in stage.preparations]
        widths = [self._prepared[result][0] for result in results]
        if len(results) == 2 and not self._joined:
            self._memory.for_entries(BOTH, sum(widths))
            self._call(stage, preparing.join, (self._constant(widths, np.int64), *results, BOTH))
            self._joined = True
        prepared = (results[0] if len(results) == 1 else BOTH, sum(widths)) if results else ("", 0)
        before = (stage.before, self._fields[stage.before].components) if stage.before else ("", 0)
        width = self._sum(
            stage, Sum(stage.interaction, stage.rows, stage.columns, stage.result, False, before, prepared, own)
        )
        self._fields[stage.result] = Field(width, "ENTRIES")

    def _prepare(self, stage: Prepare) -> None:
        self._joined = False
        preparation = stage.preparation
        of_sums = f"sums of {stage.result}" if isinstance(preparation, NormalEquations) else stage.result
        summed = Sum(preparation, stage.rows, stage.columns, of_sums, by_row=True)
        width = self._sum(stage, summed)
        if isinstance(preparation, NormalEquations):
            width = self._solve(stage, preparation, of_sums, width)
        form = form_of(preparation, self._dimension, summed.traced(self._fields, self._dimension).result)
        self._prepared[stage.result] = (width, form)
        limits = self._constant([preparation.least_quality, width])
        self._call(stage, preparing.test, (limits, stage.result, "target"))

    def _solve(self, stage: Prepare, equations: NormalEquations, of_sums: str, width: int) -> int:
        """Append the solution of equations whose sums are so wide; the width of its result."""
        moments, right = equations.normal_equations(self._dimension)
        unknowns = len(right)
        self._memory.for_entries(stage.result, 1 + unknowns)
        self._call(stage, preparing.solve, (
            self._constant([width, unknowns, SIZES[stage.rows]], np.int64), of_sums,
            self._constant(moments, np.int64), self._constant(right), stage.result,
        ))  # fmt: skip
        return 1 + unknowns
