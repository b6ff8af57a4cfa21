"""The walls of the explicit scheme around fluid in a region of any form."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np

from sphear.boundaries.shapes import Shape, repeated
from sphear.errors import SphearError
from sphear.schemes.problem import Problem
from sphear.schemes.weakly_compressible.settings import WeaklyCompressible

Array = np.ndarray[Any, Any]
Settings = TypeVar("Settings", bound=WeaklyCompressible)

THROUGH = 0.5  # spacings behind a wall: the place of the first fixed particles


def with_possible_walls(problem: Problem, settings: Settings) -> Settings:
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


def region_of(problem: Problem) -> Shape | None:
    """The region of fluid in all periods; None where its walls are those of the box alone."""
    return None if problem.shape is None else repeated(problem.shape, problem.window)


def gone_through(region: Shape | None, problem: Problem, positions: Array) -> int:
    """The particle that has gone furthest through a wall of the region, -1 if none has.

    Args:
        region: of fluid; None where no other walls than those of the box are.
        problem: the flow.
        positions: (N, d).
    """
    if region is None:
        return -1
    distance = region.distance(problem.window.wrapped(positions))
    worst = int(np.argmin(distance))
    return worst if distance[worst] < -THROUGH * problem.spacing else -1
