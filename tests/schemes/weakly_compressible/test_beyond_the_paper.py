"""The options beyond the papers: what each of them leaves exactly as it is."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear import Particles, WendlandC2
from sphear.boundaries import Box
from sphear.errors import SphearError
from sphear.interactions import DensityDiffusion, Rates
from sphear.operators.pipeline import Operation, run
from sphear.schemes.presets import PRESETS
from sphear.schemes.problem import Problem
from sphear.schemes.weakly_compressible.flow import WeaklyCompressibleFlow
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings
from tests.particles import jittered

COUNT = 8


def channel(velocity: tuple[float, float]) -> Problem:
    """Disordered particles that all move alike, between two walls at rest."""
    spacing = 1 / COUNT
    positions = jittered((COUNT, COUNT), 0.3, seed=1)
    positions = spacing * (positions - positions.min(axis=0) + 0.3)
    inside = np.clip(positions, 0.02, 0.98)
    return Problem(
        positions=inside,
        velocities=np.tile(velocity, (len(inside), 1)),
        box=Box((0.0, 0.0), (1.0, 1.0), ("periodic", "walls")),
        body_force=(0.0, 0.0),
        spacing=spacing,
        density=1.0,
        kinematic_viscosity=0.1,
        speed=1.0,
        length=1.0,
    )


def density_rates(**changes: Any) -> np.ndarray[Any, Any]:
    settings = WeaklyCompressibleSettings(
        **{**PRESETS["basa2009"], "density": "continuity", "integrator": "kick_drift_kick", **changes}
    )
    flow = WeaklyCompressibleFlow(channel((1.0, 0.0)), settings)
    flow.advance(0)  # evaluates the rates
    return flow.state()["density_rate"]


def test_a_stream_along_walls_has_no_divergence_where_its_images_slip() -> None:
    np.testing.assert_allclose(density_rates(wall_divergence="slipping"), 0.0, atol=1e-12)


def test_images_that_are_continued_behind_the_wall_show_a_divergence() -> None:
    assert np.abs(density_rates(wall_divergence="continued")).max() > 0.01


def diffusion(gradients: bool) -> np.ndarray[Any, Any]:
    """The diffusion of a density that varies linearly, its gradients known."""
    positions = jittered((9, 9), 0.4, seed=2)
    slope = np.array([0.3, -0.2])
    kernel = WendlandC2(1.6)
    cloud = Particles.read(positions, kernel=kernel, volumes=np.ones(len(positions)))
    fields = {
        "density": 10.0 + positions @ slope,
        "volume": np.ones(len(positions)),
        "density_gradient": np.tile(slope, (len(positions), 1)),
    }
    part = DensityDiffusion(kernel, 0.1, 10.0, gradients)
    return run(Operation((Rates((part,)),), None), cloud.neighbours, fields).values


def test_diffusion_with_gradients_leaves_linear_densities_alone() -> None:
    np.testing.assert_allclose(diffusion(gradients=True), 0.0, atol=1e-12)


def test_diffusion_without_gradients_does_not_at_edges() -> None:
    assert np.abs(diffusion(gradients=False)).max() > 0.01


@pytest.mark.parametrize(("term", "share"), [("morris", 8), ("violeau", 12), ("cleary_4.96333", 12)])
def test_terms_along_the_line_of_centres_take_shorter_viscous_steps(term: str, share: int) -> None:
    flow = WeaklyCompressibleFlow(
        channel((0.0, 0.0)), WeaklyCompressibleSettings(**{**PRESETS["basa2009"], "viscosity": term})
    )
    assert flow.limits["viscous"] == pytest.approx(flow.kernel.h**2 / (share * 0.1))


def test_cleary_with_the_strongest_coefficient_is_stable_at_its_own_time_step() -> None:
    from sphear.cases.flow import FLOWS, CaseRun

    case = FLOWS["poiseuille"]
    done = CaseRun(
        case, case.settings(**{**PRESETS["basa2009"], "viscosity": "cleary_4.96333"}, reynolds=0.3, until=1.5)
    ).run()
    assert done.end == "time"


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"wall_divergence": "slipping", "density": "summation"}, ("slip", "density=summation")),
        (
            {"density": "continuity", "density_diffusion": 0.1, "diffusion_form": "antuono", "walls": "adami"},
            ("diffusion_form=antuono", "walls=adami"),
        ),
    ],
)
def test_contradictions_name_both_settings(changes: dict[str, Any], named: tuple[str, str]) -> None:
    from sphear.checked import checked

    with pytest.raises(SphearError) as caught, checked():
        WeaklyCompressibleSettings(**changes)
    assert all(name in str(caught.value) for name in named)
