"""The arrays that a flow starts from: of the fluid, and behind it of the fixed particles of walls."""

from __future__ import annotations

from typing import Any

import numpy as np

from sphear.kernels import Kernel
from sphear.schemes.problem import Problem
from sphear.schemes.weakly_compressible.evaluation import integrated_walls
from sphear.schemes.weakly_compressible.formulas import Formulas
from sphear.schemes.weakly_compressible.integrators import Integrated, Integrator
from sphear.schemes.weakly_compressible.settings import WeaklyCompressible

Array = np.ndarray[Any, Any]


def integrated(formulas: Formulas) -> Integrated:
    """The variables that a flow by these formulas integrates in time."""
    roles = formulas.rates.roles
    return Integrated(
        scalars=tuple(role for role in ("density", "energy") if role in roles),
        of_walls=("density",) if integrated_walls(formulas) else (),
        drifting="drift" in roles,
    )


def fields_at_start(
    settings: WeaklyCompressible,
    problem: Problem,
    formulas: Formulas,
    kernel: Kernel,
    integrator: Integrator,
    energy_at_rest: float,
) -> dict[str, Array]:
    """The fields of all particles by name, (N + M,) or (N + M, d): those of the fluid, then those of walls.

    position, velocity; mass; dynamic_viscosity; density; pressure; energy of a unit of mass, of a gas; drift, of
    particles against the fluid, and density_gradient where they are computed; of walls fluid (1 of the fluid's
    particles, else 0), normal, depth, wall_velocity, and nearest, the particle of the wall's first layer before each;
    acceleration, density_rate and energy_rate, the rates that are integrated; and ..._before, which the integrator
    keeps.

    Args:
        settings: chosen.
        problem: the flow.
        formulas: of a step.
        kernel: with its smoothing length.
        integrator: of the flow.
        energy_at_rest: of a unit of mass, where there is an ideal gas.
    """
    count, dimension = problem.positions.shape
    model = settings.wall_model
    depth = model.depth(kernel.radius, len(formulas.stages), settings.density == "summation")
    behind = model.particles(problem.box, problem.shape, problem.spacing, depth)
    total = count + len(behind.positions)

    def both(of_fluid: Array, of_walls: Array) -> Array:
        return np.ascontiguousarray(np.concatenate((of_fluid, of_walls)), np.float64)

    fields = {
        "position": both(problem.positions, behind.positions),
        "velocity": both(problem.velocities, behind.velocities),
        "mass": np.full(total, problem.density * problem.spacing**dimension),
        "dynamic_viscosity": np.full(total, problem.density * problem.kinematic_viscosity),
        "density": np.full(total, problem.density),
        "pressure": np.full(total, settings.initial_pressure if settings.gas else 0.0),
        "acceleration": np.zeros((total, dimension)),
    }
    if settings.gas:
        fields["energy"] = np.full(total, energy_at_rest)
    for role in ("drift", "density_gradient"):
        if role in formulas.rates.roles:
            fields[role] = np.zeros((total, dimension))
    if formulas.walls is not None:
        nothing = np.zeros((count, dimension))
        fields |= {
            "fluid": both(np.ones(count), np.zeros(total - count)),
            "normal": both(nothing, behind.normals),
            "depth": both(nothing[:, 0], behind.depths),
            "wall_velocity": both(nothing, behind.velocities),
            "nearest": np.concatenate((np.arange(count), count + behind.nearest)),
        }
    of = integrated(formulas)
    fields |= {f"{name}_rate": np.zeros(total) for name in of.scalars}
    return fields | {f"{name}_before": fields[name].copy() for name in integrator.kept(of)}
