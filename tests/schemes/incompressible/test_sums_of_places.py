"""Sums that are made together are those that are made alone."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear import CORRECTIONS, VISCOSITY, Lind, WendlandC2
from sphear.corrections import NoCorrection
from sphear.engine import sweep
from sphear.engine.uniform import WithUniform
from sphear.interactions import Gradient, Rates
from sphear.interactions.concentration import Concentration
from sphear.interactions.joined import Joined
from sphear.neighbours import Domain
from sphear.schemes.incompressible.flow import IncompressibleFlow
from sphear.schemes.incompressible.particle_sums import ParticleSums
from tests.particles import jittered
from tests.schemes.incompressible.flows import in_a_box, in_a_tank, vortices

SIZE = 24
KERNEL = WendlandC2(1.57 / SIZE)
RENORMALISED = CORRECTIONS["renormalised"]
PREPARATIONS: tuple[Any, ...] = (
    VISCOSITY["least_squares"].preparation(KERNEL, NoCorrection()),  # solved after it is summed
    RENORMALISED.preparation(KERNEL),
)
DRIFT = Rates((Lind().drift(KERNEL, 1.0, 1.0 / SIZE),))
TOGETHER = (*PREPARATIONS, Concentration(KERNEL), DRIFT)


def places(together: tuple[Any, ...] = (), threads: int = 1) -> ParticleSums:
    positions = jittered((SIZE, SIZE), 0.3, seed=4, dx=1.0 / SIZE)
    domain = Domain((0.0, 0.0), (1.0, 1.0))
    volume = np.random.default_rng(2).uniform(0.8, 1.2, len(positions)) / SIZE**2
    return ParticleSums(positions, 500, KERNEL, volume, domain, threads, together=together)


@pytest.mark.parametrize("threads", [1, 2])
def test_sums_made_together_are_those_made_alone(threads: int) -> None:
    interaction: Any
    alone, together = places(threads=threads), places(TOGETHER, threads)
    for interaction in (DRIFT, Concentration(KERNEL)):
        np.testing.assert_allclose(together.sum(interaction), alone.sum(interaction), rtol=1e-11, atol=1e-13)
    for interaction in PREPARATIONS:
        found, expected = together.prepared(interaction), alone.prepared(interaction)
        assert found.own[-1] == expected.own[-1]
        size = expected.chunks[0].shape[1]
        numbers = np.concatenate(found.chunks)[:, found.column : found.column + size]
        np.testing.assert_allclose(numbers, np.concatenate(expected.chunks), rtol=1e-9, atol=1e-12)


def test_a_field_that_changes_is_packed_anew_and_one_that_stays_is_not_lost() -> None:
    sums = places(TOGETHER)
    fields = np.random.default_rng(1).normal(size=(3, sums.total, 2))
    gradient = Gradient(KERNEL, RENORMALISED, True)

    def of(where: ParticleSums, values: Any) -> Any:
        return where.sum(gradient, PREPARATIONS[1], values=values)

    for values in (fields[0], fields[1][:, :1], fields[2], fields[0]):
        np.testing.assert_allclose(of(sums, values), of(places(), values), rtol=1e-9)


@pytest.fixture
def swept(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """The interactions that are swept, in their order."""
    found: list[Any] = []
    prepare = sweep.Sweep.__post_init__

    def noted(self: sweep.Sweep) -> None:
        found.append(self.interaction)
        prepare(self)

    monkeypatch.setattr(sweep.Sweep, "__post_init__", noted)
    return found


@pytest.mark.parametrize("changes", [{}, {"projection": "intermediate"}, {"shifting": "none", "alpha": 0.0}], ids=str)
@pytest.mark.parametrize("make", [lambda **changes: in_a_box(vortices, **changes), in_a_tank])
def test_a_step_asks_for_all_that_it_sums_together_and_for_nothing_twice(
    make: Any, changes: dict[str, Any], swept: list[Any]
) -> None:
    flow: IncompressibleFlow = make(**changes)
    flow.advance(1)
    swept = [x.interaction if isinstance(x, WithUniform) else x for x in swept]
    joined = [x for x in swept if isinstance(x, Joined)]
    assert len(joined) == 1
    assert joined[0].parts == flow.together
    assert not set(joined[0].parts) & {x for x in swept if x not in joined}
