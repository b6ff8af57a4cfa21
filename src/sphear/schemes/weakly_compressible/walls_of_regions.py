"""The walls of the explicit scheme around fluid in a region of any form."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np

from sphear.boundaries.shapes import check_room, repeated
from sphear.errors import SphearError
from sphear.kernels import Kernel
from sphear.schemes.checks import check_shape
from sphear.schemes.problem import Problem
from sphear.schemes.weakly_compressible.settings import WeaklyCompressible

Array = np.ndarray[Any, Any]
Chosen = TypeVar("Chosen", bound=WeaklyCompressible)

THROUGH = 0.5  # spacings behind a wall: the place of the first fixed particles


def chosen_for(problem: Problem, settings: Chosen) -> Chosen:
    """The settings, with fixed particles where nobody chose and mirrors cannot be.

    Raises:
        SphearError: mirrors were chosen for walls that are no sides of a box.
    """
    if problem.shape is None or not settings.wall_model.mirrors:
        return settings
    if "walls" in settings.model_fields_set:
        raise SphearError(
            f"walls=mirror reflect particles at the sides of a box, and the walls of {problem.shape} are no such: take"
            " walls=fixed or walls=adami"
        )
    named = {name: getattr(settings, name) for name in settings.model_fields_set}
    return type(settings)(**named, walls="fixed")


def check_region(problem: Problem, kernel: Kernel, supports: int) -> None:
    """Refuse walls that leave no room for the fluid, or none for the particles behind them.

    Raises:
        SphearError: a gap or a solid is too thin, or particles stand in a wall.
    """
    if problem.shape is not None:
        check_room(problem.shape, problem.spacing, supports * kernel.radius, problem.window, kernel.radius)
        check_shape(problem)


def gone_through(problem: Problem, positions: Array) -> int:
    """The particle that has gone furthest through a wall of the region, -1 if none has.

    Args:
        problem: the flow.
        positions: (N, d).
    """
    if problem.shape is None:
        return -1
    distance = repeated(problem.shape, problem.window).distance(problem.window.wrapped(positions))
    worst = int(np.argmin(distance))
    return worst if distance[worst] < -THROUGH * problem.spacing else -1
