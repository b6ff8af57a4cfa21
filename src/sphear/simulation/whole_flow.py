"""Numbers of a whole flow."""

from __future__ import annotations

from sphear.schemes import energy
from sphear.schemes.base import Flow


def kinetic_energy(flow: Flow) -> float:
    """(m / 2) sum_i u_i^2 with m = rho dx^d, a mass by a speed squared; in the plane of a unit of depth."""
    mass = flow.problem.density * flow.problem.spacing ** flow.velocities.shape[1]
    return energy.kinetic_energy(mass, flow.velocities)


def greatest_speed(flow: Flow) -> float:
    """max_i |u_i|, a length over a time."""
    return energy.greatest_speed(flow.velocities)
