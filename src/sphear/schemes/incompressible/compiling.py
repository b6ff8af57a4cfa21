"""The parts of a step whose code other processes compile, while this one makes its first step."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from sphear.neighbours import Chunk
from sphear.pressure import PressureSystem, solve
from sphear.pressure.pair_rows import PairRows, WallRows
from sphear.schemes.incompressible.differential_operators import DifferentialOperators

if TYPE_CHECKING:
    from sphear.schemes.incompressible.flow import IncompressibleFlow

COUNT = 16  # particles in the row that stands for a flow


def parts(flow: IncompressibleFlow) -> list[Callable[[], object]]:
    """The solve of a small pressure equation, which needs no neighbours, and the sums of a step."""
    return [partial(small_solve, flow), partial(sums, flow)]


def small_solve(flow: IncompressibleFlow) -> None:
    """Solve the pressure equation of a row of particles by the means of a flow.

    Its numbers mean nothing; what it compiles is the same for any number of particles.
    """
    periodic = tuple(map(bool, flow.problem.periodic))
    first = np.arange(0, 2 * COUNT + 1, 2, dtype=np.int64)
    neighbour = np.repeat(np.arange(COUNT, dtype=np.int32), 2)
    neighbour[::2] -= 1
    neighbour[1::2] += 1
    ends = np.zeros(1, np.int32)
    rows = PairRows(
        [Chunk(0, COUNT, first, neighbour % COUNT)],
        [np.ones(2 * COUNT)],
        np.arange(COUNT, dtype=np.int32),
        WallRows(ends, ends[:0], np.zeros(0)),
        np.zeros(0),
        np.zeros(COUNT, np.bool_),
        np.full(COUNT, 1.0 if flow.problem.free_surface else 0.0),
        threads=flow.threads,
    )
    positions = np.full((COUNT, len(periodic)), 0.5)
    positions[:, 0] += np.arange(COUNT)
    upper = (float(COUNT), *[1.0] * (len(periodic) - 1))
    system = PressureSystem(
        rows, positions, (0.0,) * len(periodic), upper, periodic, 1.0, flow.pressures.assembly.symmetric,
        not flow.problem.free_surface,
    )  # fmt: skip
    solve(system, np.sin(np.arange(COUNT)), np.zeros(COUNT), flow.pressures.preconditioner)


def sums(flow: IncompressibleFlow) -> None:
    """Sum what a step sums once walls have fields, the last first: meanwhile the step itself finds these."""
    how, laplacian = flow.discretisation, flow.pressures.assembly
    distance = None if how.region is None else how.region.distance(flow.x)
    particles = how.particles(flow.x, distance, flow.together)
    operators = DifferentialOperators(how, particles, None)
    fields = np.zeros((particles.total, flow.x.shape[1]))
    operators.pressure_gradient(fields[:, 0].copy())
    operators.slopes(fields)
    particles.weights(laplacian.weights, laplacian.preparation)
    if not how.viscous.of_all:
        how.viscous.acceleration(particles, fields, how.count, None)
