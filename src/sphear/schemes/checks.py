"""Checks of every scheme on the particles of a problem, before the first step."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from sphear.boundaries.shapes import repeated
from sphear.boundaries.shapes.rows import grid, window_ticks
from sphear.errors import SphearError

if TYPE_CHECKING:
    from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]

SLACK = 1e-9  # spacings behind a wall, of rounding
APART = 1e-3  # spacings: nearer are at one place
STRETCHED = 1.25  # the mean spacing of particles over the given one, at most and inverted at least
NEAREST = (0.6, 1.4)  # the distance of the nearest, of particles with a free surface; disordered ones have 0.8
SAMPLES = 10_000  # places at least that tell the area of a shape
LINKED = 1.6  # spacings: as far is the first attempt at going from particle to particle


def check_places(problem: Problem) -> None:
    """Refuse particles behind walls, at one place, or of another spacing than the problem's.

    Whether they fill a shape is asked by `check_shape`, when there is known to be room in it.

    Raises:
        SphearError: there are such particles.
    """
    _check_walls(problem)
    tree = tree_of(problem)
    if problem.free_surface:
        _check_nearest(problem, tree)
    elif problem.shape is None:
        _check_volume(problem)
    pairs = tree.query_pairs(APART * problem.spacing, output_type="ndarray")
    if len(pairs):
        first, second = min(map(tuple, pairs.tolist()))
        raise SphearError(
            f"particles {first} and {second} are both at ({place_text(problem.positions[first])}) at the start"
        )


def check_connected(problem: Problem, reach: float) -> None:
    """Refuse incompressible fluid that walls cut into parts: the pressure would have a constant in each.

    Args:
        problem: with a shape, and without a free surface, where the pressure is known.
        reach: of the kernel.

    Raises:
        SphearError: it is cut.
    """
    tree, count = tree_of(problem), len(problem.positions)
    for way in sorted((min(LINKED * problem.spacing, reach), reach)):
        pairs = tree.query_pairs(way, output_type="ndarray")
        links = coo_array((np.ones(len(pairs), bool), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
        parts, part = connected_components(links, directed=False)
        if parts == 1:
            return
    check_shape(problem)  # particles in a wall, or too few of them, are parts as well
    sizes = np.bincount(part)
    first = int(np.flatnonzero(part == np.argmin(sizes))[0])
    raise SphearError(
        f"the fluid falls into {parts} parts without a common neighbour, the smallest with {sizes.min()} of {count}"
        f" particles at ({place_text(problem.positions[first])}), and in {parts - 1} of them nothing fixes the"
        " pressure: compute them one by one"
    )


def tree_of(problem: Problem, positions: Array | None = None) -> Any:
    """The particles, at the start or at positions (N, d), to be asked for neighbours, over periodic sides too."""
    window = problem.window
    x = np.asarray(problem.positions if positions is None else positions, np.float64)
    places = window.wrapped(x) - np.array(window.lower)
    periods = np.zeros(places.shape[1])
    for axis in window.periodic_axes:
        periods[axis] = window.upper[axis] - window.lower[axis]
        places[:, axis] = np.where(places[:, axis] >= periods[axis], 0.0, places[:, axis])  # rounding
    return cKDTree(places, boxsize=periods)


def check_shape(problem: Problem) -> None:
    """Refuse particles behind the walls of the problem's shape, and those that do not fill it.

    Raises:
        SphearError: there are such particles; or the spacing is not theirs.
    """
    if problem.shape is None:
        return
    distance = repeated(problem.shape, problem.window).distance(problem.positions)
    _refuse_behind(problem, distance < -SLACK * problem.spacing)
    if not problem.free_surface:
        _check_volume(problem)


def _check_walls(problem: Problem) -> None:
    x, slack = problem.positions, SLACK * problem.spacing
    behind = np.zeros(len(x), bool)
    for axis in problem.box.wall_axes:
        behind |= (x[:, axis] < problem.box.lower[axis] - slack) | (x[:, axis] > problem.box.upper[axis] + slack)
    _refuse_behind(problem, behind)


def _refuse_behind(problem: Problem, behind: Array) -> None:
    if behind.any():
        first = int(np.argmax(behind))
        raise SphearError(f"particle {first} at ({place_text(problem.positions[first])}) starts behind a wall")


def _check_volume(problem: Problem) -> None:
    """Compare the volume of all particles with that of the region that they fill."""
    count, dimension = problem.positions.shape
    mean = (_volume(problem) / count) ** (1 / dimension)
    if mean > STRETCHED * problem.spacing and problem.shape is None:  # a drop in an empty box
        _check_nearest(problem, tree_of(problem))
    elif not 1 / STRETCHED <= mean / problem.spacing <= STRETCHED:
        raise SphearError(
            f"the spacing of a problem belongs to its particles, which fill the {_region(problem)}: {count} of them"
            f" there are {mean:.4g} apart, not {problem.spacing:.4g}"
        )


def _volume(problem: Problem) -> float:
    """The volume of the box or of the shape in it."""
    window, (count, dimension) = problem.window, problem.positions.shape
    whole = float(np.prod(np.subtract(window.upper, window.lower)))
    if problem.shape is None:
        return whole
    step = (whole / max(SAMPLES, count)) ** (1 / dimension)
    ticks = [window_ticks(window, axis, step) for axis in range(2)]
    share = np.mean(repeated(problem.shape, window).distance(grid(*ticks)) > 0)
    return float(share) * whole


def _check_nearest(problem: Problem, tree: Any) -> None:
    """Compare the distance of neighbours with the spacing, where the fluid fills no known region."""
    if len(problem.positions) < 2:
        return
    nearest = float(np.median(tree.query(tree.data, k=2)[0][:, 1]))
    if not NEAREST[0] <= nearest / problem.spacing <= NEAREST[1]:
        raise SphearError(
            f"the spacing of a problem belongs to its particles: these have their nearest neighbours at {nearest:.4g},"
            f" not at {problem.spacing:.4g}"
        )


def _region(problem: Problem) -> str:
    return "box" if problem.shape is None else "shape"


def place_text(place: Array) -> str:
    """The coordinates (d,) of a place, as messages give them."""
    return ", ".join(f"{x:.6g}" for x in place)
