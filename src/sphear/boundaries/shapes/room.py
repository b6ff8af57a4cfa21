"""Check that walls leave room for particles: no overlap, some fluid, no gap too narrow."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import numpy as np

from sphear.boundaries.shapes.base import Array, Shape, Vector, number, text
from sphear.boundaries.shapes.compound import Complement, Difference
from sphear.boundaries.shapes.feet import wetted
from sphear.boundaries.shapes.fluid import fluid_lattice
from sphear.boundaries.shapes.repeated import repeated
from sphear.boundaries.shapes.rows import grid, window_ticks
from sphear.errors import SphearError
from sphear.neighbours.domain import Domain

FINE = 0.25  # spacings between the points on walls that are looked at
STEP = 0.125  # spacings between the points on the way across a gap
THICK = 1.5  # depths of the rows: half of it, and half a spacing before the wall, is where the kernel is almost zero
BARELY = 1e-6  # spacings that count as none
INSCRIBED = 0.95  # of the half of a gap, free around its middle: narrower is a corner of less than 36 degrees


def check_room(shape: Shape, spacing: float, depth: float, box: Domain, support: float) -> None:
    """Refuse walls that particles cannot stand between or behind.

    A gap is where the line from a wall along its normal meets a wall again after a way w < support, and the circle
    about its middle with w as its diameter is fluid; a corner between two walls is none. A solid is measured likewise:
    where it is thinner than 1.5 times the depth of its rows, the fluid on one side sees those of the other.

    Args:
        shape: the region of fluid.
        spacing: of the particles.
        depth: of the rows behind the walls.
        box: the window of interest.
        support: the radius of the kernel: a gap of fluid is at least as wide.

    Raises:
        SphearError: solids of a difference overlap, a shape is too small for a particle behind its walls, no fluid is
            left, a gap is too narrow or a solid too thin; also what `fluid_lattice` and `dummies` refuse.
    """
    lengths = {"the spacing of particles": spacing, "the depth of walls": depth, "the support of the kernel": support}
    for name, length in lengths.items():
        if number(name, length) <= 0:
            raise SphearError(f"{name} is positive, not {length:g}")
    repeated(shape, box)
    for difference in _differences(shape):
        _check_overlaps(difference, spacing, box)
    for primitive, inverted in shape.primitives():
        if inverted and not sum(map(len, primitive.rows(spacing, depth, box, inverted))):
            raise SphearError(f"the {primitive} is too small for any wall particle, {spacing:g} apart, behind its wall")
    fluid_lattice(shape, spacing, box)
    if thin := narrowest_gap(Complement(shape), spacing, box, THICK * depth):
        width, place = thin
        raise SphearError(
            f"the solid at {text(place)} is {width:.3g} thick: fluid on its two sides would feel each other through"
            f" what is thinner than {THICK * depth:.3g}; a finer spacing or a thicker solid is needed"
        )
    if gap := narrowest_gap(shape, spacing, box, support):
        width, place = gap
        raise SphearError(
            f"the fluid between the walls at {text(place)} is {width:.3g} wide, narrower than the support of the"
            f" kernel, {support:.3g}: a finer spacing, a wider gap or none at all is needed"
        )


def narrowest_gap(shape: Shape, spacing: float, box: Domain, support: float) -> tuple[float, Vector] | None:
    """The width and the middle of the narrowest gap, if any is narrower than the support."""
    whole = repeated(shape, box)
    walls = _walls(shape, spacing, box)
    walls = walls[wetted(whole, walls, spacing)]
    normals = whole.normal(walls)
    free = np.full(len(walls), BARELY * spacing * 10)
    width = np.full(len(walls), np.inf)
    going = whole.distance(walls + free[:, None] * normals) > 0  # else a corner, or the place where two walls touch
    for way in np.arange(STEP * spacing, support + STEP * spacing, STEP * spacing):
        met = going & (whole.distance(walls + way * normals) <= 0)
        if met.any():
            width[met] = _first_wall(whole, walls[met], normals[met], free[met], way)
            going &= ~met
        free[going] = way
    near = np.flatnonzero(width < support * (1.0 - BARELY))
    middles = walls[near] + 0.5 * width[near, None] * normals[near]
    inscribed = whole.distance(middles) >= 0.5 * INSCRIBED * width[near] - BARELY * spacing
    near, middles = near[inscribed], middles[inscribed]
    if not len(near):
        return None
    first = int(np.argmin(width[near]))
    return float(width[near][first]), (float(middles[first, 0]), float(middles[first, 1]))


def _first_wall(whole: Shape, walls: Array, normals: Array, free: Array, end: float) -> Array:
    """The way from walls along their normals to the next wall, between ways that are free and one that is not."""
    low, high = free.copy(), np.full(len(free), end)
    for _ in range(40):
        middle = 0.5 * (low + high)
        fluid = whole.distance(walls + middle[:, None] * normals) > 0
        low, high = np.where(fluid, middle, low), np.where(fluid, high, middle)
    return high


def _check_overlaps(difference: Difference, spacing: float, box: Domain) -> None:
    """Refuse solids of a difference that have a point in common."""
    first, *others = difference.parts
    solids = [(first, repeated(Complement(first), box)), *((part, repeated(part, box)) for part in others)]
    points = grid(*(window_ticks(box, axis, spacing) for axis in range(2)))
    points = np.concatenate((points, *(_walls(part, spacing, box) for part, _ in solids)))
    inside = [solid.distance(points) for _, solid in solids]
    for a, b in combinations(range(len(solids)), 2):
        common = np.minimum(inside[a], inside[b])
        deepest = int(np.argmax(common))
        tiny = BARELY * spacing
        # a point on one's wall and within the other is enough
        if common[deepest] > tiny or ((common >= -tiny * 1e-3) & (np.maximum(inside[a], inside[b]) > tiny)).any():
            where = points[np.argmax(np.where(common >= -tiny * 1e-3, np.maximum(inside[a], inside[b]), -np.inf))]
            what = f"the walls of the {solids[a][0]}" if a == 0 else f"the {solids[a][0]}"
            raise SphearError(
                f"shapes overlap: {what} and the {solids[b][0]}, at {text((float(where[0]), float(where[1])))}; bodies"
                " that are meant to overlap are joined first, with |"
            )


def _differences(shape: Shape) -> Iterator[Difference]:
    """All differences in a shape."""
    if isinstance(shape, Difference):
        yield shape
    for part in shape.parts:
        yield from _differences(part)


def _walls(shape: Shape, spacing: float, box: Domain) -> Array:
    """Points on all walls of a shape."""
    outlines = [primitive.outline(FINE * spacing, box) for primitive, _ in shape.primitives()]
    return np.concatenate((np.empty((0, 2)), *outlines))
