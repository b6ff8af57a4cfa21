"""A flow to be computed: fluid, box, forces and scales."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from sphear.boundaries import Box
from sphear.boundaries.box import LARGEST_LENGTH, LEAST_LENGTH
from sphear.boundaries.shapes import Shape
from sphear.checked import number, numbers, real_array
from sphear.errors import SphearError, quoted
from sphear.neighbours import Domain

Array = np.ndarray[Any, Any]

DENSITY_VARIATION = 0.01
CORNER_VARIATION = 0.1  # of the density, where walls meet
MOST_MOVED = 0.63  # spacings a step, at the expected speed: as far as the CFL condition allows at the usual h / dx
LENGTHS, SIZES = (LEAST_LENGTH, LARGEST_LENGTH), (1e-150, 1e150)


@dataclass(frozen=True)
class Problem:
    """A flow to be computed.

    Attributes:
        positions: (N, d), at the start, of particles `spacing` apart that fill the box, or the fluid in it.
        velocities: (N, d), at the start.
        box: its sides.
        body_force: on a unit of mass, (d,).
        spacing: of the particles.
        density: at rest.
        kinematic_viscosity: of the fluid.
        speed: the largest speed that is expected.
        length: the length that the Reynolds number is made with.
        shape: the region of fluid, where its walls are not those of the box alone.
        free_surface: whether the fluid ends at its own surface too; for incompressible flow.
        force: on a unit of mass, beside the body force, (N, d) at places (N, d) and a time; for incompressible flow. No
            time-step limit knows of it.
    """

    positions: Array
    velocities: Array
    box: Box
    body_force: tuple[float, ...]
    spacing: float
    density: float
    kinematic_viscosity: float
    speed: float
    length: float
    shape: Shape | None = None
    free_surface: bool = False
    force: Callable[[Array, float], Array] | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "positions", _vectors("positions", self.positions))
        object.__setattr__(self, "velocities", _vectors("velocities", self.velocities))
        if self.positions.shape != self.velocities.shape:
            raise SphearError(
                f"a problem has a velocity for each position, and these are {self.velocities.shape} and"
                f" {self.positions.shape}"
            )
        if not isinstance(self.box, Box):
            raise SphearError(f"the box of a problem is a Box, not {quoted(self.box)}")
        if self.positions.shape[1] != len(self.box.lower):
            raise SphearError(
                f"the positions of a problem have {self.positions.shape[1]} coordinates and its box has"
                f" {len(self.box.lower)}"
            )
        if len(force := numbers(self.body_force)) != len(self.box.lower):
            raise SphearError(
                f"the body force of a problem has {len(self.box.lower)} finite numbers, not {quoted(self.body_force)}"
            )
        object.__setattr__(self, "body_force", force)
        for name in ("spacing", "density", "kinematic_viscosity", "speed", "length"):
            given, least = getattr(self, name), name == "kinematic_viscosity"
            value, said = number(given), f"the {name.replace('_', ' ')} of a problem"
            if isinstance(given, bool) or (not isinstance(given, int | float) and math.isnan(value)):
                raise SphearError(f"{said} is one finite number, not {quoted(given)}")
            if not (value >= 0 if least else value > 0):
                must = "not be negative" if least else "be positive"
                raise SphearError(f"{said} must {must}, not {quoted(given) if math.isnan(value) else value}")
            low, high = LENGTHS if name in ("spacing", "length") else SIZES
            if value and not low <= value <= high:
                raise SphearError(
                    f"{said} is from {low:g} to {high:g}, or powers of it vanish or overflow, not {value:g}"
                )
            object.__setattr__(self, name, value)
        if not (self.shape is None or isinstance(self.shape, Shape)):
            raise SphearError(
                f"the shape of a problem is a shape of sphear.boundaries.shapes, not {quoted(self.shape)}"
            )
        if not (self.force is None or callable(self.force)):
            raise SphearError(f"the force of a problem is a function of places and a time, not {quoted(self.force)}")
        if not isinstance(self.free_surface, bool | np.bool_):
            raise SphearError(f"the free surface of a problem is True or False, not {quoted(self.free_surface)}")

    @property
    def periodic(self) -> tuple[bool, ...]:
        """True for each axis along which the flow repeats, (d,)."""
        return self.box.periodic

    @property
    def window(self) -> Domain:
        """The box with its periodic axes."""
        return Domain(self.box.lower, self.box.upper, self.periodic)

    @property
    def walled(self) -> bool:
        """True if there are walls."""
        return self.shape is not None or not all(self.periodic)

    @property
    def straight(self) -> bool:
        """True if walls are those of a straight channel, without corners, in which flow can be parallel to them."""
        return self.shape is None and self.walled and any(self.periodic)

    def time_step_limits(self, h: float, sound_speed: float, radial: bool = False) -> dict[str, float]:
        """The time steps that the CFL, viscous and body-force conditions allow (Morris, Fox & Zhu 1997).

        Beside them no particle moves more than `MOST_MOVED` spacings a step, which matters where smoothing lengths
        are long.

        Args:
            h: the smoothing length.
            sound_speed: at rest.
            radial: whether the viscous term acts along the line of centres: it contains the gradient of the
                divergence, so that waves along their own direction feel up to three times the viscosity.
        """
        force, nu = math.hypot(*self.body_force), self.kinematic_viscosity
        return {
            "cfl": 0.25 * h / (sound_speed + self.speed),
            "spacing": MOST_MOVED * self.spacing / self.speed,
            "viscous": (1 / 12 if radial else 1 / 8) * h**2 / nu if nu > 0 else math.inf,
            "body_force": 0.25 * math.sqrt(h / force) if force > 0 else math.inf,
        }


def _vectors(what: str, given: Any) -> Array:
    """The places or velocities of particles as an array (N, d)."""
    found = real_array(given)
    if found is None:
        raise SphearError(
            f"the {what} of a problem are numbers of shape (N, d), real and none of them masked, which this"
            f" {type(given).__name__}{_kind(given)} is not"
        )
    if found.ndim != 2:
        raise SphearError(f"the {what} of a problem are numbers of shape (N, d), not of shape {found.shape}")
    return found


def _kind(given: Any) -> str:
    """The type of the numbers of an array."""
    return f" of {given.dtype}" if isinstance(given, np.ndarray) else ""


def morris_sound_speed(problem: Problem) -> float:
    """c0^2 = max(U0^2, nu U0 / L, F L) / delta with delta = 0.01 (Morris, Fox & Zhu 1997, eq. 21)."""
    force = math.hypot(*problem.body_force)
    return math.sqrt(
        max(
            problem.speed**2,
            problem.kinematic_viscosity * problem.speed / problem.length,
            force * problem.length,
        )
        / DENSITY_VARIATION
    )


def corner_sound_speed(problem: Problem) -> float:
    """c0^2 = nu U0 / (0.1 dx) where walls meet, else 0.

    Between walls that slide past each other at a corner the pressure of a slow flow is nu U0 over the distance from it,
    nu U0 / dx at the nearest particles, whatever the size of the flow. By Morris's rule alone, of the whole flow, their
    density would change by tens of percent. At a Courant number of 0.25 such sound is never what limits the step.
    """
    if problem.straight or not problem.walled:
        return 0.0
    return math.sqrt(problem.kinematic_viscosity * problem.speed / problem.spacing / CORNER_VARIATION)
