"""Room for the particles of an explicit flow and for all that its sums reach."""

from __future__ import annotations

from sphear.boundaries import shapes
from sphear.errors import SphearError
from sphear.kernels import Kernel
from sphear.schemes.base import check_kernel, fineness
from sphear.schemes.checks import check_shape
from sphear.schemes.objects import text
from sphear.schemes.problem import Problem
from sphear.schemes.weakly_compressible.settings import WeaklyCompressible


def check_room(problem: Problem, settings: WeaklyCompressible, kernel: Kernel, stages: int) -> None:
    """Refuse walls that leave no room for the fluid, or none for the particles behind them.

    Args:
        problem: the flow.
        settings: of the scheme.
        kernel: with its smoothing length.
        stages: of the rates, each a sum over neighbours that knows the one before.

    Raises:
        SphearError: walls, a gap or a period are too narrow, a solid is too thin, or particles stand in a wall.
    """
    reach = stages * kernel.radius
    if problem.shape is None:
        _check_width(problem, settings, reach, stages)
    check_kernel(problem, kernel, settings, connected=False)
    if problem.shape is not None:
        shapes.check_room(problem.shape, problem.spacing, reach, problem.window, kernel.radius)
        check_shape(problem)


def _check_width(problem: Problem, settings: WeaklyCompressible, reach: float, stages: int) -> None:
    """Refuse walls of the box that sums reach across."""
    supports = "the kernel's support of {}" if stages == 1 else f"{stages} supports of the kernel of {{}}"
    reaches = f"{supports.format(f'{reach:g}')} {'reaches' if stages == 1 else 'reach'} beyond"
    for axis in problem.box.wall_axes:
        width = problem.box.upper[axis] - problem.box.lower[axis]
        if reach > width:
            raise SphearError(
                f"{fineness(problem, settings)} is too coarse for walls={text(settings.walls)}: {reaches} the width of"
                f" {width:g} between the walls"
            )
