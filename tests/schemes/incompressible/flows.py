"""Small incompressible flows: in a periodic box, in a closed tank, and those of the cases."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from sphear.boundaries import Box
from sphear.boundaries.shapes import Shape
from sphear.cases.flow import FLOWS, CaseRun
from sphear.schemes.incompressible.flow import IncompressibleFlow
from sphear.schemes.incompressible.settings import IncompressibleSettings
from sphear.schemes.problem import Problem
from tests.particles import jittered

Array = np.ndarray[Any, Any]
Field = Callable[[Array], Array]

WHOLE = 2.0 * np.pi


def at_rest(x: Array) -> Array:
    return np.zeros_like(x)


def vortices(x: Array) -> Array:
    """Those of Taylor and Green."""
    along, across = WHOLE * x[:, 0], WHOLE * x[:, 1]
    return np.stack((-np.cos(along) * np.sin(across), np.sin(along) * np.cos(across)), axis=1)


def in_a_box(velocity: Field, count: int = 12, disorder: float = 0.3, **changes: Any) -> IncompressibleFlow:
    """In a unit square that is periodic both ways; Re = 100."""
    dx = 1.0 / count
    x = jittered((count, count), disorder, seed=0, dx=dx)
    box = Box((0.0, 0.0), (1.0, 1.0), ("periodic", "periodic"))
    problem = Problem(x, velocity(x), box, (0.0, 0.0), dx, 1.0, 0.01, 1.0, 1.0)
    settings = {"tolerance": 1e-11, "time_step": 0.004, "preconditioner": "jacobi", **changes}
    return IncompressibleFlow(problem, IncompressibleSettings.model_validate(settings))


def in_a_tank(
    count: int = 10, disorder: float = 0.0, shape: Shape | None = None, at: Array | None = None, **changes: Any
) -> IncompressibleFlow:
    """Under gravity between the walls of a unit square, or of another shape in it."""
    settings = IncompressibleSettings.model_validate({"tolerance": 1e-12, "time_step": 0.004, "alpha": 0.0, **changes})
    dx = 1.0 / count
    if at is None:
        at = jittered((count, count), disorder, seed=0, dx=dx)
    box = Box((0.0, 0.0), (1.0, 1.0), ("walls", "walls"))
    return IncompressibleFlow(
        Problem(at, np.zeros_like(at), box, (0.0, -1.0), dx, 1.0, 0.01, 1.0, 1.0, shape=shape), settings
    )


def case(name: str, **changes: Any) -> CaseRun:
    chosen = FLOWS[name]
    return CaseRun(chosen, chosen.settings(**{"scheme": "incompressible", **changes}))
