"""Walls of any shape in the plane: regions of fluid by signed distance, and the particles in them and behind them."""

from sphear.boundaries.shapes.base import Foot, Primitive, Shape
from sphear.boundaries.shapes.circle import Circle
from sphear.boundaries.shapes.compound import Complement, Difference, Intersection, Union
from sphear.boundaries.shapes.fastest import fastest
from sphear.boundaries.shapes.fluid import fitted, fluid_lattice
from sphear.boundaries.shapes.half_plane import HalfPlane
from sphear.boundaries.shapes.polygon import Polygon
from sphear.boundaries.shapes.rectangle import Rectangle
from sphear.boundaries.shapes.repeated import Repeated, repeated
from sphear.boundaries.shapes.room import check_room
from sphear.boundaries.shapes.wall_dummies import Dummies, dummies
from sphear.boundaries.shapes.written import written

__all__ = [
    "Circle",
    "Complement",
    "Difference",
    "Dummies",
    "Foot",
    "HalfPlane",
    "Intersection",
    "Polygon",
    "Primitive",
    "Rectangle",
    "Repeated",
    "Shape",
    "Union",
    "check_room",
    "dummies",
    "fastest",
    "fitted",
    "fluid_lattice",
    "repeated",
    "written",
]
