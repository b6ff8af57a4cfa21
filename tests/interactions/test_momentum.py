"""The right-hand side of the momentum equation: pressure and viscosity in one sweep, the particle itself included."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear import CORRECTIONS, VISCOSITY, CubicSpline, Particles
from sphear.interactions import PressureForce, Rates, ViscousForce
from sphear.operators.pipeline import Operation, run
from tests.particles import Array, all_pairs, jittered, summed

KERNEL = CubicSpline(1.5)
TERMS = ("takeda", "violeau", "cleary", "morris", "monaghan")


def particles() -> tuple[Particles, dict[str, Any]]:
    positions = jittered((8, 8), 0.4, seed=0)
    generator = np.random.default_rng(1)
    count = len(positions)
    volumes, density = generator.uniform(0.8, 1.2, count), generator.uniform(0.5, 2.0, count)
    fields = {
        "volume": volumes, "density": density, "mass": volumes * density, "velocity": generator.random((count, 2)),
        "dynamic_viscosity": generator.uniform(0.5, 2.0, count), "pressure_over_density2": generator.random(count),
    }  # fmt: skip
    return Particles.read(positions, kernel=KERNEL, volumes=volumes), fields


def momentum(viscosity: str, correction: str, fields: dict[str, Any]) -> Array:
    term, chosen = VISCOSITY[viscosity], CORRECTIONS[correction]
    forces = ViscousForce(term, KERNEL, chosen), PressureForce(KERNEL, chosen, "squares", reduced=False)
    operation = Operation((Rates(forces),), term.preparation(KERNEL, chosen))
    return run(operation, particles()[0].neighbours, fields).values


@pytest.mark.parametrize("viscosity", TERMS)
@pytest.mark.parametrize("correction", ["none", "shepard"])
def test_without_pressure_it_is_the_viscous_acceleration(viscosity: str, correction: str) -> None:
    cloud, fields = particles()
    fields["pressure_over_density2"] = np.zeros(len(cloud.positions))
    if viscosity == "takeda":  # which is refused where the viscosity varies
        fields["dynamic_viscosity"] = np.full(len(cloud.positions), 1.3)
    expected = cloud.viscous_acceleration(
        fields["velocity"],
        fields["dynamic_viscosity"],
        fields["density"],
        VISCOSITY[viscosity],
        CORRECTIONS[correction],
    )
    np.testing.assert_allclose(momentum(viscosity, correction, fields), expected, rtol=1e-10, atol=1e-12)


def test_without_viscosity_it_is_the_symmetric_pressure_gradient() -> None:
    cloud, fields = particles()
    fields["velocity"] = np.zeros(cloud.positions.shape)
    i, j, d = all_pairs(cloud.positions, KERNEL.radius)
    grad_w = KERNEL.gradient_factor((d**2).sum(axis=1), 2)[:, None] * d
    p = fields["pressure_over_density2"]
    expected = summed(i, -(fields["mass"][j] * (p[i] + p[j]))[:, None] * grad_w, len(p))
    np.testing.assert_allclose(momentum("morris", "none", fields), expected, rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize("correction", ["shepard", "bonet_lok"])
def test_a_uniform_pressure_does_not_push_where_the_correction_is_of_order_zero(correction: str) -> None:
    """Only if the particle itself is part of the sum: then sum_j V_j grad W~_ij vanishes."""
    cloud, fields = particles()
    fields |= {"velocity": np.zeros(cloud.positions.shape), "pressure_over_density2": np.ones(len(cloud.positions))}
    fields |= {"mass": fields["volume"], "density": np.ones(len(cloud.positions))}
    np.testing.assert_allclose(momentum("morris", correction, fields), 0.0, atol=1e-12)
    assert np.abs(momentum("morris", "none", fields)).max() > 0.1
