"""Ways of shifting, wall models, integrators and preconditioners of one's own, by name and as objects."""

from __future__ import annotations

import pickle
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

import sphear
from sphear.algebra import add, scale
from sphear.engine.stages import EnterBox, PerParticle, Rows, Stage
from sphear.interactions import Part
from sphear.schemes.weakly_compressible.integrators import Integrated, Step
from sphear.sweeps.plan import plan


class Sideways(sphear.ShiftingMethod):
    """Lind's, with a strength for each direction of time."""

    strength: float = 2.0
    backwards: float = 1.0

    def drift(self, kernel: sphear.Kernel, speed: float, spacing: float) -> Part:
        return sphear.Lind(self.strength * self.backwards).drift(kernel, speed, spacing)


class Twins(sphear.MirrorPoints):
    """The mirror points by another name."""


class Diagonal(sphear.Preconditioner):
    """Jacobi's by another name."""

    build = sphear.Jacobi.build


class Dynamic(sphear.ExplicitWallModel):
    """Particles that move with the wall and have a density of their own (Crespo et al. 2007)."""

    integrates_density = True


@dataclass(frozen=True)
class Kicked:
    """Velocity and density a step later, and the place with the new velocity."""

    time: float

    def at(self, own: Any) -> dict[str, Any]:
        velocity = add(own.velocity, scale(self.time, own.acceleration))
        place = add(own.position, scale(self.time, velocity))
        return {"velocity": velocity, "position": place, "density": own.density + self.time * own.density_rate}


class SymplecticEuler(sphear.Integrator):
    """Rates of the start, and the new velocity for the places; `part` of a step is made."""

    part: float = 1.0

    def kept(self, of: Integrated) -> tuple[str, ...]:
        return ()

    def step(self, evaluation: Sequence[Stage], time_step: float, of: Integrated, fastest: float) -> Step:
        move = PerParticle(Kicked(self.part * time_step), Rows.FLUID)
        return Step((*evaluation, move, EnterBox(fastest)), (0, len(evaluation)), len(evaluation))


@pytest.fixture
def own() -> None:
    """Names for all."""
    sphear.wall_model("dynamic")(Dynamic)
    sphear.shifting_method("sideways")(Sideways)
    sphear.wall_model("twins")(Twins)
    sphear.preconditioner("own_diagonal")(Diagonal)
    sphear.integrator("symplectic_euler", aliases=("kick_drift",))(SymplecticEuler)


COMMON: dict[str, Any] = {"scheme": "incompressible", "resolution": 12, "reynolds": 10.0, "time_step": 1e-3}


def after(**settings: Any) -> Any:
    run = sphear.flow("cavity", **COMMON, **settings)
    run.flow.advance(3)
    return run.flow.velocities


@pytest.mark.usefixtures("own")
def test_they_are_taken_by_name() -> None:
    found = after(shifting="sideways", walls="Twins", preconditioner="own_diagonal")
    np.testing.assert_array_equal(found, after(shifting="lind", shifting_strength=2.0, preconditioner="jacobi"))


@pytest.mark.usefixtures("own")
def test_flat_settings_are_their_fields() -> None:
    chosen = sphear.Incompressible(shifting="sideways", walls="twins", continuation="linear")
    assert (chosen.shifting_method, chosen.wall_model) == (Sideways(), Twins("linear"))
    assert chosen.shifting_strength == 2.0
    assert sphear.Incompressible(shifting="sideways", shifting_strength=3.0).shifting_method == Sideways(3.0)  # type: ignore[call-arg]


@pytest.mark.usefixtures("own")
def test_what_flat_settings_do_not_say_stays_an_object() -> None:
    item: Any = Sideways(backwards=0.5)  # type: ignore[call-arg]
    chosen = sphear.Incompressible(shifting=item)
    assert (chosen.shifting, chosen.shifting_method, chosen.shifting_strength) == (item, item, 2.0)
    assert chosen.model_dump(mode="json")["shifting"] == "Sideways(strength=2.0, backwards=0.5)"
    assert sphear.Incompressible(**dict(chosen)) == chosen
    np.testing.assert_array_equal(after(shifting=item), after(shifting_strength=1.0))


@pytest.mark.usefixtures("own")
def test_a_sweep_sends_the_object_along_with_its_name() -> None:
    (run,) = plan("cavity", {"shifting": ["sideways"]}, {**COMMON, "walls": "twins", "until": 0.1})
    sent = {key: value.item for key, value in run.sent.items() if key in ("shifting", "walls")}
    assert sent == {"shifting": Sideways(), "walls": Twins()}
    assert pickle.loads(pickle.dumps(sent)) == sent
    (run,) = plan("cavity", {"integrator": ["symplectic_euler"]}, {"resolution": 12, "until": 0.1})
    assert run.sent["integrator"].item == SymplecticEuler()


@pytest.mark.usefixtures("own")
def test_a_wall_model_of_the_explicit_scheme_is_one_class() -> None:
    """Behind a lid its particles keep the lid's velocity, and their density follows the continuity equation."""
    common: dict[str, Any] = {"resolution": 12, "reynolds": 10.0, "density": "continuity", "threads": 1}
    named, item = (sphear.flow("cavity", walls=walls, **common) for walls in ("dynamic", Dynamic()))
    for run in (named, item):
        run.flow.advance(3)
    np.testing.assert_array_equal(named.flow.velocities, item.flow.velocities)
    fields: Any = named.flow._fields  # type: ignore[attr-defined]
    behind = slice(named.flow.count, None)
    np.testing.assert_array_equal(fields["velocity"][behind], fields["wall_velocity"][behind])
    assert np.abs(fields["density"][behind] - named.flow.problem.density).max() > 1e-6
    with pytest.raises(sphear.SphearError, match="walls=dynamic is no wall model of the incompressible scheme"):
        sphear.Incompressible(walls="dynamic")


@pytest.mark.usefixtures("own")
def test_an_integrator_is_what_its_stages_are() -> None:
    half: Any = SymplecticEuler(part=0.5)  # type: ignore[call-arg]
    common: dict[str, Any] = {"resolution": 12, "reynolds": 10.0, "transport": "none", "threads": 1}
    for integrator, part in (("Kick-Drift", 1.0), (half, 0.5)):
        flow: Any = sphear.flow("cavity", integrator=integrator, **common).flow
        places, density, dt = flow.positions.copy(), flow.density.copy(), part * flow.time_step
        flow.advance(1)
        np.testing.assert_allclose(flow.velocities, dt * flow.acceleration, rtol=1e-12)
        np.testing.assert_allclose(flow.positions, places + dt * flow.velocities, rtol=1e-12)
        np.testing.assert_allclose(flow.density, density + dt * flow.density_rate, rtol=1e-12)
        assert np.abs(flow.velocities).max() > 0.0
    assert sphear.WeaklyCompressible(integrator="kick_drift").time_integrator == SymplecticEuler()
    assert sphear.WeaklyCompressible(integrator=half).integrator == half


def test_one_without_its_method_is_refused() -> None:
    class NoDrift(sphear.ShiftingMethod): ...

    with pytest.raises(sphear.SphearError, match="the class NoDrift lacks the method drift of ShiftingMethod"):
        sphear.shifting_method("no_drift")(NoDrift)

    class NoStep(sphear.Integrator):
        kept = sphear.Midpoint.kept

    with pytest.raises(sphear.SphearError, match="the class NoStep lacks the method step of Integrator"):
        sphear.integrator("no_step")(NoStep)
    with pytest.raises(sphear.SphearError, match=r"@sphear\.wall_model names a class derived from sphear\.WallModel"):
        sphear.wall_model("walls")(NoDrift)  # type: ignore[type-var]
