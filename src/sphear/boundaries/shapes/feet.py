"""The nearest walls of compound shapes behind them, where the least of the parts' distances is only a bound."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from sphear.boundaries.shapes.base import Array, Foot, Shape, slowest
from sphear.neighbours.domain import Domain

STEP = 0.05  # spacings between the points on the walls that are searched
TINY = 1e-6  # spacings: nearer to a wall is on it
ASIDE = 1e-3  # spacings from a wall at which its fluid is looked for
DIRECTIONS = np.array([(np.cos(a), np.sin(a)) for a in 2 * np.pi * np.arange(32) / 32])


def wetted(whole: Shape, places: Array, spacing: float) -> Array:
    """True for places (N, 2) on walls with fluid at them, not where one solid lies against or in another."""
    foot = whole.foot(places)
    on = np.abs(foot.distance) <= TINY * spacing
    fluid = whole.distance(places + ASIDE * spacing * foot.normal) > TINY * spacing
    doubtful = on & ~fluid  # at corners the normal may lead into a solid
    around = places[doubtful][:, None] + ASIDE * spacing * DIRECTIONS
    beside = whole.distance(around.reshape(-1, 2)) > TINY * spacing
    fluid[doubtful] = beside.reshape(-1, len(DIRECTIONS)).any(axis=1)
    return np.asarray(on & fluid)


def wetted_walls(shape: Shape, whole: Shape, spacing: float, box: Domain) -> Array:
    """Points on the walls that have fluid at them, and their periodic images half a period beside the window."""
    outlines = [primitive.outline(STEP * spacing, box) for primitive, _ in shape.primitives()]
    places = np.concatenate((np.empty((0, 2)), *outlines))
    places = places[wetted(whole, places, spacing)]
    reach = max((box.upper[axis] - box.lower[axis] for axis in box.periodic_axes), default=0.0)
    return np.asarray(box.with_images(places, 0.5 * reach)[0])


def true_feet(shape: Shape, whole: Shape, places: Array, spacing: float, box: Domain) -> Foot:
    """The feet of places in the solid, on walls that have fluid at them.

    A foot that the whole shape gives is kept where it is on such a wall; else it is the nearest of points on them, at
    most a twentieth of a spacing apart. Behind no such wall at all the distance is infinite.

    Args:
        shape: as it was given.
        whole: the same, repeated along the periodic axes.
        places: (N, 2), in the solid.
        spacing: of the particles.
        box: the window of interest.
    """
    foot = whole.foot(places)
    if not shape.parts:
        return foot
    at = places - foot.distance[:, None] * foot.normal
    wrong = np.flatnonzero(~wetted(whole, at, spacing))
    if not len(wrong):
        return foot
    walls = wetted_walls(shape, whole, spacing, box)
    distance, normal, velocity = (array.copy() for array in foot)
    if not len(walls):
        distance[wrong] = -np.inf
        return Foot(distance, normal, velocity)
    depth, nearest = cKDTree(walls).query(places[wrong])
    distance[wrong] = -np.asarray(depth)
    normal[wrong] = (walls[nearest] - places[wrong]) / np.asarray(depth)[:, None]
    along = STEP * spacing * np.column_stack((-normal[wrong, 1], normal[wrong, 0]))
    ends = [whole.wall_velocity(walls[nearest] + side * along) for side in (-1.0, 0.0, 1.0)]
    velocity[wrong] = slowest(np.ones((len(wrong), 3), bool), np.stack(ends, axis=1))  # at a corner of both its walls
    return Foot(distance, normal, velocity)
