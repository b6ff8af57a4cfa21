"""The arrays that a time loop starts from: of the fluid, and behind it of the fixed particles of walls."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from sphear.boundaries import wall_particles
from sphear.engine.structure import parameters
from sphear.kernels import Kernel
from sphear.neighbours.pair_list import selection_table_once
from sphear.schemes.formulas import Formulas
from sphear.schemes.problem import Problem
from sphear.schemes.settings import WeaklyCompressible
from sphear.schemes.state import Change, Fields, Numbers, Space

Array = np.ndarray[Any, Any]


class Arrays(NamedTuple):
    """What the compiled loop is given.

    x, v: (N + M, d), of the fluid and of the walls' particles.
    fields, change, space, numbers: see `sphear.schemes.state`.
    constants: the numbers of each sweep.
    """

    x: Array
    v: Array
    fields: Fields
    change: Change
    space: Space
    numbers: Numbers
    constants: tuple[Array, ...]


def arrays(
    settings: WeaklyCompressible, problem: Problem, formulas: Formulas, kernel: Kernel, energy_at_rest: float
) -> Arrays:
    """The start of a flow.

    Args:
        settings: what is chosen.
        problem: the flow.
        formulas: of a step.
        kernel: with its smoothing length.
        energy_at_rest: of a unit of mass, where there is an ideal gas.
    """
    count, dimension = problem.positions.shape
    fixed = settings.walls != "mirror" and bool(problem.box.wall_axes)
    # densities that are summed need all their neighbours too
    depth = kernel.radius * (len(formulas.stages) + (settings.density == "summation"))
    behind = wall_particles(problem.box, problem.spacing, math.ceil(depth / problem.spacing) if fixed else 0)
    total = count + len(behind.positions)

    def of_walls(values: Array) -> Array:
        before = np.zeros((count, *values.shape[1:]))
        return np.concatenate((before, values)) if fixed else np.zeros((1, *values.shape[1:]))

    roles, gas = formulas.rates.roles, settings.gas
    fields = Fields(
        mass=np.full(total, problem.density * problem.spacing**dimension),
        viscosity=np.full(total, problem.density * problem.kinematic_viscosity),
        density=np.full(total, problem.density),
        pressure=np.full(total, settings.initial_pressure if gas else 0.0),
        energy=np.full(total if gas else 1, energy_at_rest),
        drift=np.zeros((total if "drift" in roles else 1, dimension)),
        density_gradient=np.zeros((total if "density_gradient" in roles else 1, dimension)),
        normal=of_walls(behind.normals),
        depth=of_walls(behind.depths),
        wall_velocity=of_walls(behind.velocities),
        nearest=count + behind.nearest,
    )
    change = Change(
        velocity=np.zeros((count, dimension)),
        density=np.zeros(total if "density" in roles else 1),
        energy=np.zeros(total if "energy" in roles else 1),
    )
    return Arrays(
        x=np.ascontiguousarray(np.concatenate((problem.positions, behind.positions)), np.float64),
        v=np.ascontiguousarray(np.concatenate((problem.velocities, behind.velocities)), np.float64),
        fields=fields,
        change=change,
        space=Space(*problem.box.arrays(settings.walls == "mirror")),
        numbers=_numbers(problem, formulas, kernel),
        constants=tuple(np.array(numbers or [0.0]) for numbers in formulas.parameters()),
    )


def _numbers(problem: Problem, formulas: Formulas, kernel: Kernel) -> Numbers:
    moments, right = np.zeros((0, 0), np.int64), np.zeros(0)
    for _, preparation in formulas.preparations:
        if hasattr(preparation, "normal_equations"):
            moments, right = preparation.normal_equations(problem.positions.shape[1])
    return Numbers(
        force=np.array(problem.body_force, np.float64),
        spacing=float(problem.spacing),
        support=float(kernel.radius),
        state=np.array(parameters(formulas.equation_of_state)),
        wall_state=np.array(parameters(formulas.wall_state)),
        table=selection_table_once(),
        moments=moments,
        right=right,
    )
