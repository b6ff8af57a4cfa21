"""A list of stages, compiled for the processor."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from sphear.engine.backends.cpu import sizes
from sphear.engine.backends.cpu.compiling import Compiler
from sphear.engine.backends.cpu.driver import advance
from sphear.engine.backends.cpu.memory import Memory
from sphear.engine.backends.cpu.particle_text import Field
from sphear.engine.backends.cpu.views import address_of
from sphear.engine.cache import compiled_beside
from sphear.engine.stages import Stage

Array = np.ndarray[Any, Any]


class Space(NamedTuple):
    """The box and the fineness of a flow.

    lower, upper: its corners, (d,).
    kinds: of its sides, (d,), see `sphear.boundaries.box`.
    wall_velocities: of its walls, (d, 2, d + 1).
    spacing: of the particles.
    support: the radius of the kernel.
    """

    lower: Array
    upper: Array
    kinds: Array
    wall_velocities: Array
    spacing: float
    support: float


class Ended(NamedTuple):
    """The end of a run of stages.

    steps: made.
    cause: of a failure, a key of `sphear.engine.stages.CAUSES`; 0 if there was none.
    particle: that it failed at.
    stage: the number of the one that failed.
    """

    steps: int
    cause: int
    particle: int
    stage: int


class Program:
    """Stages of a step, each compiled by itself, and run one after the other without Python in between.

    Args:
        stages: of a step.
        fields: arrays of the particles, those of the fluid first: (N + M,) or (N + M, k); they are written in place.
        uniform: arrays (k,) that are the same for all particles.
        space: the box.
        fluid: N.
        threads: that it runs on.
    """

    def __init__(
        self,
        stages: Sequence[Stage],
        fields: dict[str, Array],
        uniform: dict[str, Array],
        space: Space,
        fluid: int,
        threads: int,
    ) -> None:
        total, dimension = fields["position"].shape
        self._memory = Memory(fields | uniform, space._asdict(), fluid, total, dimension, threads)
        known = {name: Field(array.shape[1] if array.ndim == 2 else 0) for name, array in fields.items()}
        known |= {name: Field(len(array), "") for name, array in uniform.items()}
        compiler = Compiler(self._memory, known, threads > 1)
        self._first = []  # the first call of each stage
        for stage in stages:
            self._first.append(len(compiler.calls))
            compiler.add(stage)
        self._calls = compiler.calls
        self._first.append(len(self._calls))
        self._addresses = np.empty(0, np.int64)  # of the compiled stages; none before they are

    def compile(self) -> None:
        """Compile what is not compiled yet; the first run does, too."""
        if not len(self._addresses):
            codes = [call.code for call in self._calls]
            with compiled_beside([partial(address_of, code) for code in reversed(codes)]):
                self._addresses = np.array([address_of(code) for code in codes])
            self._tables = self._addressed()
            advance(self._addresses, self._tables, self._memory.sizes, 0, 0, 0, 0)

    def run(self, steps: int, begin: int = 0, end: int | None = None) -> Ended:
        """Run the stages begin ... end - 1, all by default, for each of so many steps."""
        self.compile()
        first, last = self._first[begin], self._first[-1 if end is None else end]
        at, made, numbers = first, 0, self._memory.sizes
        while made < steps:
            done, at, status = advance(self._addresses, self._tables, numbers, first, last, at, steps - made)
            made += done
            if status > 0:
                failed = int(np.searchsorted(self._first, at, "right")) - 1
                return Ended(made, status, int(numbers[sizes.WORST]), failed)
            if status < 0:
                self._memory.grow(status)
                self._tables = self._addressed()
        return Ended(made, 0, -1, -1)

    def _addressed(self) -> Array:
        """The addresses of the arrays of all calls."""
        table = np.zeros((len(self._calls), max(len(call.arrays) for call in self._calls)), np.int64)
        for row, call in enumerate(self._calls):
            table[row, : len(call.arrays)] = [self._memory.address(name) for name in call.arrays]
        return table
