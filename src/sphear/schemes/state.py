"""What the compiled time loop is given: arrays, by name."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

Array = np.ndarray[Any, Any]


class Fields(NamedTuple):
    """Arrays of the N fluid particles, followed by those of M fixed wall particles.

    mass, viscosity: (N + M,), dynamic viscosity.
    density, pressure: (N + M,).
    energy: (N + M,), of a unit of mass; (1,) where the equation of state has none.
    drift: (N + M, d), of the particles against the fluid; (1, d) where nothing moves them.
    density_gradient: (N + M, d), of the last evaluation; (1, d) where nothing needs it.
    normal, depth, wall_velocity: (N + M, d), (N + M,) and (N + M, d), of wall particles; (1, ...) where there are none.
    nearest: (M,), the particle of the wall's first layer before each.
    """

    mass: Array
    viscosity: Array
    density: Array
    pressure: Array
    energy: Array
    drift: Array
    density_gradient: Array
    normal: Array
    depth: Array
    wall_velocity: Array
    nearest: Array


class Space(NamedTuple):
    """The box: its corners (d,), the kinds of its sides (d,), the velocities of its walls (d, 2, d)."""

    lower: Array
    upper: Array
    kinds: Array
    velocities: Array


class Change(NamedTuple):
    """Rates of change of the fluid's velocity (N, d) and, where they are integrated, density and energy (N + M,)."""

    velocity: Array
    density: Array
    energy: Array


class Numbers(NamedTuple):
    """What the formulas are given at run time.

    force: (d,), on a unit of mass.
    spacing: of the particles.
    support: the radius of the kernel.
    state: parameters of the equation of state.
    wall_state: those of the one that gives wall particles their density.
    table: for selecting neighbours.
    moments, right: of a preparation's normal equations.
    """

    force: Array
    spacing: float
    support: float
    state: Array
    wall_state: Array
    table: Array
    moments: Array
    right: Array
