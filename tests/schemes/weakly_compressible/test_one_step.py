"""One time step, or a few, of each combination of settings against another program, `plain`."""

from __future__ import annotations

from itertools import combinations, product
from typing import Any

import numpy as np
import pytest

from sphear.boundaries import Box
from sphear.schemes.presets import PRESETS
from sphear.schemes.problem import Problem
from sphear.schemes.weakly_compressible.flow import WeaklyCompressibleFlow
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings
from tests.particles import jittered
from tests.schemes.weakly_compressible.plain import Array, Plain

COUNT, LID = 8, 0.7
FORCE = (3.0, -2.0)
CHOICES = {
    "viscosity": ("takeda", "two_pass", "violeau", "cleary", "morris"),
    "correction": ("none", "shepard", "bonet_lok"),
    "equation_of_state": ("batchelor_tait", "ideal_gas"),
    "density": ("summation", "continuity"),
}
STATES = {"tait": "batchelor_tait", "gas": "ideal_gas", "linear": "linear"}

# viscosity, correction, equation of state, density and what else is set; every pair of `CHOICES` occurs
COMBINATIONS: list[tuple[str, dict[str, Any]]] = [
    ("takeda none tait summation", {}),
    ("takeda shepard gas continuity", {"continuation": "quadratic"}),
    ("takeda bonet_lok tait continuity", {"pressure_reduction": "none", "integrator": "kick_drift_kick"}),
    ("two_pass none gas summation", {"pressure_reduction": "hydrostatic"}),
    ("two_pass shepard tait summation", {"walls": "fixed"}),
    ("two_pass bonet_lok gas continuity", {"wall_particles": True, "continuation": "quadratic"}),
    ("violeau none tait summation", {"cavity": True, "pressure_reduction": "none"}),
    (
        "violeau shepard gas summation",
        {"pressure_reduction": "hydrostatic", "continuation": "mirror", "integrator": "kick_drift_kick"},
    ),
    ("violeau bonet_lok tait continuity", {"walls": "adami"}),
    ("cleary none tait continuity", {"density_diffusion": 0.1, "integrator": "kick_drift_kick"}),
    ("cleary shepard tait summation", {"transport": "transport_velocity"}),
    (
        "cleary bonet_lok gas summation",
        {"pressure_reduction": "none", "continuation": "global_quadratic", "wall_particles": True},
    ),
    ("morris none gas continuity", {"walls": "fixed", "pressure_reduction": "hydrostatic"}),
    ("morris shepard tait summation", {"walls": "fixed", "cavity": True}),
    ("morris bonet_lok gas summation", {"cavity": True, "continuation": "quadratic"}),
    ("morris none linear summation", {"transport": "shifting"}),
    ("morris shepard linear continuity", {"transport": "shifting", "density_diffusion": 0.1, "cavity": True}),
    ("morris none tait summation", {"transport": "transport_velocity", "integrator": "kick_drift_kick"}),
    ("morris none tait continuity", {"walls": "fixed", "continuation": "quadratic", "integrator": "kick_drift_kick"}),
    ("violeau none tait summation", {"walls": "adami", "transport": "transport_velocity"}),
    ("cleary_4.24 none gas continuity", {"walls": "adami", "pressure_reduction": "none"}),
    ("oger shepard tait summation", {}),
    ("least_squares shepard tait continuity", {"pressure_reduction": "none"}),
]


def settings(names: str, changes: dict[str, Any]) -> WeaklyCompressibleSettings:
    viscosity, correction, state, density = names.split()
    others = {name: value for name, value in changes.items() if name != "cavity"}
    chosen = {
        "viscosity": viscosity, "correction": correction, "equation_of_state": STATES[state], "density": density,
        "h_over_dx": 1.57, "time_step": 0.002, "sound_speed": None if state == "gas" else 12.0,
        "initial_pressure": 20.0, "resolution": COUNT, "shifting_strength": 0.6, "background_pressure": 0.3,
    }  # fmt: skip
    return WeaklyCompressibleSettings.model_validate({**PRESETS["basa2009"], **chosen, **others})


def problem(cavity: bool) -> Problem:
    """Jittered particles with random velocities, so that no term vanishes."""
    positions = jittered((COUNT, COUNT), 0.4, seed=0, dx=1 / COUNT) - np.array([0.0, 0.5])
    return Problem(
        positions=positions,
        velocities=np.random.default_rng(1).normal(size=positions.shape),
        box=Box(
            (0.0, -0.5), (1.0, 0.5), ("walls" if cavity else "periodic", "walls"),
            lower_velocity=(0.0, 0.0) if cavity else (-0.3, 0.0), upper_velocity=(LID, 0.0),
        ),
        body_force=FORCE,
        spacing=1 / COUNT,
        density=1.3,
        kinematic_viscosity=0.8,
        speed=1.0,
        length=0.5,
    )  # fmt: skip


def close(found: Array, expected: Array) -> None:
    np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-10 * np.abs(expected).max())


@pytest.mark.parametrize(("names", "changes"), COMBINATIONS, ids=lambda x: "" if x == {} else str(x))
def test_steps(names: str, changes: dict[str, Any]) -> None:
    """One step of the midpoint rule; two where the rates or the drift of the step before matter."""
    chosen, start = settings(names, changes), problem(changes.get("cavity", False))
    flow, plain = WeaklyCompressibleFlow(start, chosen), Plain(start, chosen)
    steps = 1 if chosen.integrator == "midpoint" and chosen.transport == "none" else 2
    generator = np.random.default_rng(2)
    state = {name: values.copy() for name, values in flow.state().items()}
    for name in {"density", "energy"} & state.keys():
        state[name][: flow.count] *= generator.uniform(0.95, 1.05, len(state[name][: flow.count]))
    flow.restore(state)
    energy = state["energy"][: flow.count] if chosen.gas else np.zeros(flow.count)
    expected, last = plain.advance(
        plain.start(start.positions, start.velocities, state["density"][: flow.count], energy), steps
    )
    flow.advance(steps)
    count = flow.count
    assert flow.steps == steps
    assert flow.time == pytest.approx(steps * flow.time_step)
    close(flow.velocities, expected.v[:count])
    close(flow.positions, expected.x[:count])
    close(flow.density, (last.density if chosen.density == "summation" else expected.rho)[:count])
    close(flow.acceleration, last.v)
    if chosen.equation_of_state == "ideal_gas":
        close(flow.energy, expected.e[:count])
    if chosen.transport != "none":
        close(flow.drift, expected.w[:count])
        assert np.abs(expected.w).max() > 1e-3
    if chosen.integrator == "midpoint":
        close(flow.pressure, last.pressure[:count])
    assert np.abs(expected.v[:count] - start.velocities).max() > 0.01


def test_every_pair_of_choices_occurs() -> None:
    """Of viscosity, correction, equation of state and density."""
    found = [settings(names, changes) for names, changes in COMBINATIONS]
    for (one, of_one), (other, of_other) in combinations(CHOICES.items(), 2):
        pairs = {(getattr(chosen, one), getattr(chosen, other)) for chosen in found}
        assert set(product(of_one, of_other)) <= pairs
