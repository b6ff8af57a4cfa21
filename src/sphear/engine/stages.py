"""A time step as data: the stages that it is made of, which a backend compiles.

A scheme lists stages: entries, neighbours, sums over pairs, formulas of a particle, checks, moves. They name the arrays
that they read and write; a backend (`sphear.engine.backends.cpu`) turns each into code, and keeps whatever lies between
them: cells, pair lists, images' order, threads.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from typing import Any, Protocol

from sphear.engine.formula import Interaction
from sphear.engine.preparation import Preparation


class Rows(Enum):
    """The particles that a stage is about: the fluid's, those of walls, both; or all entries, images among them."""

    FLUID = "fluid"
    WALLS = "walls"
    PARTICLES = "particles"
    ENTRIES = "entries"


class AtImages(Enum):
    """The value of a particle's column at its images beyond a wall.

    SAME: its own. CONTINUED: the velocity of the image itself, see `ImageVelocities`. REFLECTED: mirrored, its
    component across the wall changes sign. STANDING: mirrored, and zero at images that stand on the wall. ABSENT: its
    own, and zero at images that stand on the wall.
    """

    SAME = "same"
    CONTINUED = "continued"
    REFLECTED = "reflected"
    STANDING = "standing"
    ABSENT = "absent"


@dataclass(frozen=True)
class Column:
    """A value of each entry that formulas of pairs know by a name.

    Attributes:
        value: of a particle, from its fields as attributes: a number or, of a vector, a tuple.
        at_images: its value at images of the particle.
    """

    value: Callable[[Any], Any]
    at_images: AtImages = AtImages.SAME


Columns = tuple[tuple[str, Column], ...]


class PointFormula(Protocol):
    """New values of a particle's fields, from its fields."""

    def at(self, own: Any) -> dict[str, Any]:
        """The values by the names of the fields; those of `own` are attributes, numbers or tuples of them."""


@dataclass(frozen=True)
class Images:
    """Find the entries: the particles, and their images beyond the sides of the box.

    Attributes:
        supports: radii of the kernel within which images are wanted.
        on_walls: whether each particle near a wall has an image on the wall too.
    """

    supports: int
    on_walls: bool


@dataclass(frozen=True)
class ImageVelocities:
    """Continue the velocity through mirroring walls to the images.

    Attributes:
        continuation: a name of `sphear.boundaries.CONTINUATIONS`.
    """

    continuation: str


@dataclass(frozen=True)
class Neighbours:
    """List the neighbours of particles, and of images where these are summed for too."""

    of_images: bool


@dataclass(frozen=True)
class PairSum:
    """Sum an interaction over the neighbours of each particle.

    Attributes:
        result: the name of the array that has the sums, a row for each entry.
        interaction: summed.
        rows: the particles that it is summed for.
        columns: that it may use.
        before: the sum before it, which it knows as `before`; "" for none.
        preparations: that it may use, of `Prepare`, the name that it knows each by.
    """

    result: str
    interaction: Interaction
    rows: Rows
    columns: Columns
    before: str = ""
    preparations: tuple[tuple[str, Prepare], ...] = ()


@dataclass(frozen=True)
class Prepare:
    """Sum what later sums need of each particle's surroundings, such as a corrected kernel's coefficients.

    A step fails where a particle of the fluid has too few neighbours for it.

    Attributes:
        result: the name of its array.
        preparation: the interaction; one of `NormalEquations` is solved for each particle.
        rows: the particles that it is prepared for.
        columns: that it may use.
    """

    result: str
    preparation: Preparation
    rows: Rows
    columns: Columns


@dataclass(frozen=True)
class PerParticle:
    """Compute fields of each particle from its own fields.

    Attributes:
        formula: with its numbers.
        rows: the particles it is computed for.
        nearest: fields that are read at the particle that `nearest` names, instead of the particle itself.
    """

    formula: PointFormula
    rows: Rows
    nearest: tuple[str, ...] = ()


@dataclass(frozen=True)
class CheckFinite:
    """Fail where a vector of the fluid is not finite."""

    field: str


@dataclass(frozen=True)
class CheckPositive:
    """Fail where a number of a particle is not positive."""

    field: str


@dataclass(frozen=True)
class EnterBox:
    """Put particles back into the box along its periodic axes, and check speeds and places.

    A particle that steps through a mirror changes places with its image. Before fixed particles it may stand between
    the wall and their first layer for a while.

    Attributes:
        fastest: the speed at which the step fails.
    """

    fastest: float


Stage = Images | ImageVelocities | Neighbours | PairSum | Prepare | PerParticle | CheckFinite | CheckPositive | EnterBox

# the statuses of stages that fail, and what went wrong
TOO_FEW_NEIGHBOURS, NOT_FINITE, TOO_FAST, THROUGH_A_WALL, NOT_POSITIVE = 1, 2, 3, 4, 5
CAUSES = {
    TOO_FEW_NEIGHBOURS: "too few neighbours for a correction or a fit",
    NOT_FINITE: "an acceleration that is not a number; the time step may be too large, or the particles unstable",
    TOO_FAST: "a speed above the speed of sound, where the flow is no longer weakly compressible",
    THROUGH_A_WALL: (
        "a particle went through a wall, as when the time step is too long or particles have lost their order"
    ),
    NOT_POSITIVE: "a density or an energy that is not positive, as when particles run apart",
}
