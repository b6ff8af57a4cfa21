"""Any viscous term in a step: as the operators compute it, and where there are few particles."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear import CORRECTIONS, VISCOSITY, Domain, Particles, WendlandC2
from sphear.corrections import NoCorrection
from sphear.schemes.incompressible.flow import IncompressibleFlow
from sphear.schemes.incompressible.particle_sums import ParticleSums
from sphear.schemes.incompressible.viscous import Viscous
from tests.schemes.incompressible.flows import Array, case, in_a_box, vortices

KERNEL = WendlandC2(1.57)


def of_operators(flow: IncompressibleFlow, term: str, correction: str) -> Array:
    """The viscous acceleration of the fluid among its walls, by the operator of all particles."""
    x, u, domain = flow.positions, flow.velocities, None
    walls = flow.discretisation.walls
    if walls is not None:
        u = flow.discretisation.at(x).continued(u)
        x = np.concatenate((x, walls.dummies.positions))
    else:
        domain = Domain((0.0, 0.0), (1.0, 1.0))
    cloud = Particles.read(x, domain=domain, kernel=flow.kernel, volumes=np.full(len(x), flow.problem.spacing**2))
    one = np.ones(len(x))
    nu = flow.problem.kinematic_viscosity * one
    found = cloud.viscous_acceleration(u, nu, one, VISCOSITY[term], CORRECTIONS[correction])
    return np.asarray(found)[: flow.count]


@pytest.mark.parametrize("name", ["box", "cavity"])
@pytest.mark.parametrize(
    ("term", "correction"),
    [("two_pass", "none"), ("two_pass", "bonet_lok"), ("least_squares", "none"), ("monaghan", "none"),
     ("takeda", "shepard"), ("fatehi_manzari", "none"), ("violeau", "none")],
)  # fmt: skip
def test_it_is_the_operators(name: str, term: str, correction: str) -> None:
    changes: dict[str, Any] = {"viscosity": term, "correction": correction, "h_over_dx": 1.57}
    if name == "box":
        flow = in_a_box(vortices, **changes)
    else:
        found = case("cavity", resolution=12, **changes).flow
        assert isinstance(found, IncompressibleFlow)
        flow = found
        generator = np.random.default_rng(0)
        flow.x += 0.02 * generator.random(flow.x.shape)
        flow.u[:] = generator.normal(size=flow.u.shape)
    expected = of_operators(flow, term, correction)
    np.testing.assert_allclose(
        flow.discretisation.at(flow.x).viscous(flow.u), expected, rtol=0, atol=1e-11 * np.abs(expected).max()
    )


CLUSTERS = {
    "one": [(0.0, 0.0)],
    "two": [(0.0, 0.0), (1.0, 0.1)],
    "three": [(0.0, 0.0), (1.0, 0.1), (0.3, 0.9)],
    "four": [(0.0, 0.0), (1.0, 0.1), (0.3, 0.9), (1.2, 1.1)],
    "in line": [(-2.0, 0.0), (-1.0, 0.0), (0.0, 0.0), (1.0, 0.0), (2.0, 0.0)],
}


@pytest.mark.parametrize("cluster", CLUSTERS)
@pytest.mark.parametrize("term", ["fatehi_manzari", "oger", "least_squares"])
def test_spray_feels_no_more_than_the_uncorrected_term(cluster: str, term: str) -> None:
    """A correction of so few neighbours would be anything."""
    x = np.array(CLUSTERS[cluster])
    places = ParticleSums(x, len(x), KERNEL, np.ones(len(x)), None, 1)
    u = np.random.default_rng(len(x)).normal(size=x.shape)
    found, plain = (
        Viscous(VISCOSITY[name], NoCorrection(), KERNEL, 1.0).acceleration(places, u, len(x))
        for name in (term, "morris")
    )
    few = len(x) < 3 or cluster == "in line"
    if few or term != "oger":  # oger needs two directions only
        np.testing.assert_allclose(found, plain, rtol=1e-12, atol=1e-14)
    assert np.abs(found).max() <= 10 * np.abs(plain).max()


def test_spray_beside_fluid_that_is_corrected() -> None:
    """Only where neighbours are too few is the correction left out."""
    fluid = np.stack(np.meshgrid(np.arange(6.0), np.arange(6.0)), axis=-1).reshape(-1, 2)
    x = np.concatenate((fluid, [(20.0, 0.0), (20.9, 0.0)]))
    u = np.stack((x[:, 0] ** 2 + x[:, 1] ** 2, x[:, 1]), axis=1)
    places = ParticleSums(x, len(x), KERNEL, np.ones(len(x)), None, 1)
    found = Viscous(VISCOSITY["fatehi_manzari"], NoCorrection(), KERNEL, 1.0).acceleration(places, u, len(x))
    np.testing.assert_allclose(found[:36], np.tile([4.0, 0.0], (36, 1)), atol=1e-9)
    preparation = VISCOSITY["fatehi_manzari"].preparation(KERNEL, NoCorrection())
    assert preparation is not None
    assert places.deficient(preparation).tolist() == [36, 37]


@pytest.mark.parametrize("term", list(VISCOSITY))
@pytest.mark.parametrize("name", ["cavity", "cavity-cylinder"])
def test_any_viscous_term_makes_a_step(name: str, term: str) -> None:
    """From rest: the lid takes the fluid below it along, and that far below is slow."""
    changes = {} if name == "cavity" else {"diameter": 0.4}
    flow = case(name, viscosity=term, resolution=24, reynolds=100.0, h_over_dx=1.57, **changes).flow
    flow.advance(1)
    top = flow.positions[:, 1] > 1.0 - 1.0 / 24
    assert 0.05 < flow.velocities[top, 0].mean() < 0.4
    assert np.abs(flow.velocities[flow.positions[:, 1] < 0.5]).max() < 0.05
