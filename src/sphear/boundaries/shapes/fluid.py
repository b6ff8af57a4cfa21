"""The particles of the fluid at the beginning: the lattice of a window, as far as there is fluid."""

from __future__ import annotations

import numpy as np

from sphear.boundaries.shapes.base import Array, Shape, number, text
from sphear.boundaries.shapes.repeated import repeated
from sphear.boundaries.shapes.rows import SLACK, grid, window_ticks
from sphear.errors import SphearError
from sphear.neighbours.domain import Domain

NEAREST = 0.25  # spacings between a particle and a wall, at least


def fluid_lattice(shape: Shape, spacing: float, box: Domain) -> Array:
    """The cell centres (N, 2) of a window that lie in the fluid, at (k + 1/2) spacing from its lower corner.

    All of them count, so that the particles have the area of the fluid; those nearer to a wall than a quarter of the
    spacing are moved along its normal to that distance. Beside cylinders of many sizes, places and spacings this gives
    a mean density sum of 1.000 and no pair nearer than 0.75 spacing. To leave out all that are nearer than 0.25 (0.35)
    spacing instead gives 0.975 (0.968): a strip along the wall is missing.

    Args:
        shape: the region of fluid.
        spacing: of the particles, dx; along a periodic axis a whole number of them fits a period.
        box: the window.

    Raises:
        SphearError: the spacing is not positive, the shape cannot repeat as the window does, or there is no fluid.
    """
    if number("the spacing of particles", spacing) <= 0:
        raise SphearError(f"the spacing of particles is positive, not {spacing:g}")
    whole = repeated(shape, box)
    places = grid(*(window_ticks(box, axis, spacing) for axis in range(2)))
    found = box.wrapped(fitted(places, whole, spacing)[0])
    if not len(found):
        raise SphearError(
            f"the walls leave no fluid for particles {spacing:g} apart in the window from {text(box.lower)} to"
            f" {text(box.upper)}"
        )
    return found


def fitted(places: Array, shape: Shape, spacing: float) -> tuple[Array, Array]:
    """Choose the places (N, 2) in the fluid and move them away from walls nearer than a quarter of the spacing.

    Returns:
        The places, and which of the N they are.
    """
    least, slack = NEAREST * spacing, SLACK * spacing
    distance = shape.distance(places)
    kept = np.flatnonzero(distance > slack)
    found, distance = places[kept], distance[kept]
    for _ in range(2):  # away from one wall, then from another that it leads to in a corner
        near = distance < least - slack
        found[near] += (least - distance[near])[:, None] * shape.normal(found[near])
        distance[near] = shape.distance(found[near])
    far = distance >= least - slack
    return found[far], kept[far]
