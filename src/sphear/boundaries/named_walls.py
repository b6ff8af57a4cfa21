"""Walls of a region by their names, and conditions put on them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import inf
from typing import Any

from sphear.boundaries.conditions import FreeSlip, NoSlip, WallCondition
from sphear.boundaries.shapes import Circle, HalfPlane, Polygon, Rectangle, Shape
from sphear.boundaries.shapes.base import Primitive
from sphear.boundaries.shapes.compound import Compound
from sphear.boundaries.shapes.rectangle import SIDES
from sphear.errors import SphearError
from sphear.names import unknown

KINDS: dict[type, str] = {Circle: "circle", HalfPlane: "half_plane", Polygon: "polygon"}
Wall = tuple[Primitive, str | int]  # a primitive, and which of its walls; "" of one that has a single wall


def walls_by_name(region: Shape) -> dict[str, Wall]:
    """The walls of a region.

    A side of a rectangle is "left", "right", "lower" or "upper", or "box.left" where the rectangle is named "box"; edge
    2 of a polygon is "polygon.2"; a circle and a half-plane have one wall of their own name. A shape without a name is
    called by its kind, as "circle".

    Raises:
        SphearError: two walls have one name.
    """
    found: dict[str, Wall] = {}
    for primitive, _ in region.primitives():
        for name, side in _names(primitive):
            if name in found and found[name][0] is not primitive:
                raise SphearError(
                    f"two shapes have walls named {name!r}: give each shape a name of its own, as in name='hole'"
                )
            found[name] = (primitive, side)
    return found


def _names(primitive: Primitive) -> list[tuple[str, str | int]]:
    own = getattr(primitive, "name", "")
    if isinstance(primitive, Rectangle):
        ends = (*zip(primitive.lower, primitive.upper, strict=True),)
        finite = {side: abs(ends[number // 2][number % 2]) < inf for number, side in enumerate(SIDES)}
        return [(f"{own}.{side}" if own else side, side) for side in SIDES if finite[side]]
    kind = {Circle: "circle", HalfPlane: "half_plane", Polygon: "polygon"}.get(
        type(primitive), type(primitive).__name__
    )
    if isinstance(primitive, Polygon):
        return [(f"{own or kind}.{edge}", edge) for edge in range(len(primitive.vertices))]
    return [(own or kind, "")]


def with_conditions(region: Shape, conditions: Mapping[str, WallCondition]) -> Shape:
    """The region with walls that move as conditions say.

    Raises:
        SphearError: there is no wall of a name, or a wall cannot move so.
    """
    walls = walls_by_name(region)
    moved: dict[int, Primitive] = {}
    for name, condition in conditions.items():
        if name not in walls:
            raise unknown("wall", name, walls)
        primitive, side = walls[name]
        if isinstance(condition, FreeSlip):
            moved[id(primitive)] = _slipping(moved.get(id(primitive), primitive), side)
        elif condition.moving:
            moved[id(primitive)] = _moving(moved.get(id(primitive), primitive), side, name, condition)
    return _rebuilt(region, moved)


def _slipping(primitive: Primitive, side: str | int) -> Primitive:
    """A primitive with a wall that fluid slips along."""
    shape: Any = primitive
    if not hasattr(shape, "slips"):
        raise SphearError(f"fluid sticks to the walls of a {type(primitive).__name__}: they cannot have FreeSlip()")
    changed: Primitive = replace(shape, slips=True if side == "" else (*shape.slips, side))
    return changed


def _moving(primitive: Primitive, side: str | int, name: str, condition: NoSlip) -> Primitive:
    """A primitive with a wall that moves."""
    if isinstance(primitive, Circle):
        if any(condition.velocity):
            raise SphearError(f"the wall {name!r} is a circle, which turns with a spin: {condition!r} would move it")
        return replace(primitive, spin=condition.spin)
    if condition.spin:
        raise SphearError(f"the wall {name!r} is straight and slides with a velocity: only circles have a spin")
    velocity: Any = condition.velocity
    if isinstance(primitive, HalfPlane):
        return replace(primitive, velocity=velocity)
    if isinstance(primitive, Rectangle | Polygon):
        straight: Any = primitive
        changed: Primitive = replace(straight, velocities={**dict(straight.velocities), side: velocity})
        return changed
    raise SphearError(f"the walls of a {type(primitive).__name__} stay at rest: {name!r} cannot have {condition!r}")


def _rebuilt(shape: Shape, moved: Mapping[int, Primitive]) -> Shape:
    """A shape with some of its primitives exchanged."""
    if not moved:
        return shape
    if id(shape) in moved:
        return moved[id(shape)]
    return type(shape)(*(_rebuilt(part, moved) for part in shape.parts)) if isinstance(shape, Compound) else shape


def unbounded(region: Shape, axes: tuple[int, ...], lower: tuple[float, ...], upper: tuple[float, ...]) -> Shape:
    """The region without the sides of rectangles that are the ends of periods along some axes."""
    moved: dict[int, Primitive] = {}
    for primitive, inverted in region.primitives():
        if isinstance(primitive, Rectangle) and not inverted:
            ends: Any = [list(primitive.lower), list(primitive.upper)]
            for axis in axes:
                if (ends[0][axis], ends[1][axis]) == (lower[axis], upper[axis]):
                    ends[0][axis], ends[1][axis] = -inf, inf
            moved[id(primitive)] = replace(primitive, lower=tuple(ends[0]), upper=tuple(ends[1]))
    return _rebuilt(region, moved)
