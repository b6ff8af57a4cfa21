"""Checks that end a flow, and keep its particles before the walls."""

from __future__ import annotations

from typing import Any, NoReturn

import numpy as np

from sphear.boundaries.shapes import Shape
from sphear.schemes.base import FlowFailure
from sphear.schemes.checks import check_shape, place_text
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]

FASTEST = 10.0  # times the expected speed, from which on a flow has failed
CLOSEST = 0.1  # spacings from a wall, to which a particle is put back
BEYOND = 1.0  # spacings behind a wall, from which on a flow has failed


class FailureChecks:
    """Watches the particles of a flow.

    Args:
        problem: what is computed.
        region: of fluid; None without walls.

    Raises:
        SphearError: the particles are behind walls, or do not fill the region.
    """

    def __init__(self, problem: Problem, region: Shape | None) -> None:
        self.problem, self.region = problem, region
        check_shape(problem)

    def check_speed(self, time: float, x: Array, velocities: Array) -> None:
        """End a flow that is far too fast.

        Raises:
            FlowFailure: it is.
        """
        if np.abs(velocities).max(initial=0.0) <= FASTEST * self.problem.speed:
            return  # in one pass: NumPy is slow along short axes
        speed = np.abs(velocities).max(axis=1)
        wrong = np.flatnonzero(~(speed <= FASTEST * self.problem.speed))
        first = int(wrong[0])
        what = f"a speed of {speed[first]:.3g} is more than {FASTEST:g} times the {self.problem.speed:.3g} expected"
        what = what if np.isfinite(speed[first]) else "a velocity is not a number"
        self._fail(time, x, first, f"{what}, as when the time step is too long")

    def put_back(self, time: float, x: Array, u: Array) -> Array | None:
        """Put particles back that have come too near to a wall, and give all distances from walls, (N,), if there are.

        Raises:
            FlowFailure: one went through a wall, or a place is not a number.
        """
        if not np.isfinite(x).all():
            lost = np.flatnonzero(~np.isfinite(x).all(axis=1))
            self._fail(time, x, int(lost[0]), "its place is not a number, as when the time step is too long")
        if self.region is None:
            return None
        distance = self.region.distance(x)
        dx = self.problem.spacing
        near = np.flatnonzero(distance < CLOSEST * dx)
        if len(near):
            deepest = near[np.argmin(distance[near])]
            if distance[deepest] < -BEYOND * dx:
                self._fail(time, x, int(deepest), "a particle went through a wall, as when the time step is too long")
            normal = self.region.normal(x[near])
            x[near] += (CLOSEST * dx - distance[near])[:, None] * normal
            if self.problem.free_surface:  # one that falls on a dry wall has no pressure yet to stop it
                towards = np.minimum((u[near] * normal).sum(axis=1), 0.0)
                u[near] -= towards[:, None] * normal
            distance[near] = self.region.distance(x[near])
        return distance

    def _fail(self, time: float, x: Array, particle: int, why: str) -> NoReturn:
        raise FlowFailure(f"the flow failed at t = {time:g}, particle {particle} at ({place_text(x[particle])}): {why}")
