"""Terms, kernels, corrections and equations of state as objects in the settings of flows and patch tests."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import sphear
from sphear.algebra import Scalar, Vector
from sphear.cases.flow import FLOWS
from sphear.schemes.weakly_compressible.flow import WeaklyCompressibleFlow
from sphear.sweeps import Run, Store, plan, run_sweep


@dataclass(frozen=True)
class Mine(sphear.LaplacianTerm):
    """A user's own: that of Morris, Fox & Zhu, with a factor."""

    factor: float = 2.0

    name = "mine"

    def weight(self, kernel: sphear.Kernel, correction: sphear.Correction, own: Any, d: Vector, r2: Scalar) -> Scalar:
        return -self.factor * correction.radial(kernel, own.prepared, d, r2) / r2


class Hiding(Mine):
    """One whose number the engine cannot know."""

    def __init__(self, hidden: float) -> None:
        object.__setattr__(self, "hidden", hidden)


def settings(run: sphear.CaseRun) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(json.dumps(run.as_dict()["settings"]))
    return found


def flow(case: str = "cavity", **more: Any) -> sphear.CaseRun:
    """By the incompressible scheme, which compiles little; the time loop of the explicit one takes seconds."""
    return sphear.flow(case, **{"scheme": "incompressible", "resolution": 12, "until": 0.02, **more}).run()


def test_a_users_term_moves_a_flow_as_the_package_s_own() -> None:
    own, package = (flow(viscosity=term) for term in (Mine(), "morris"))
    np.testing.assert_allclose(own.flow.velocities, package.flow.velocities, rtol=0, atol=1e-13)
    assert settings(own)["viscosity"] == "Mine(factor=2.0)"
    other = flow(viscosity=Mine(factor=4.0))
    assert np.abs(other.flow.velocities - own.flow.velocities).max() > 1e-4


OBJECTS: dict[str, tuple[str, dict[str, Any], dict[str, Any]]] = {
    "viscosity": ("explicit", {"viscosity": sphear.Cleary(xi=4.24)}, {"viscosity": "cleary_4.24"}),
    "kernel": ("incompressible", {"kernel": sphear.WendlandC2(0.13)}, {"kernel": "wendland_c2", "h_over_dx": 1.56}),
    "correction": ("explicit", {"correction": sphear.BonetLok()}, {"correction": "level_1"}),
    "gradient_correction": (
        "incompressible",
        {"gradient_correction": sphear.NoCorrection(), "gradient": "symmetric"},
        {"gradient_correction": "none", "gradient": "symmetric"},
    ),
    "laplacian": ("incompressible", {"laplacian": sphear.Gotoh()}, {"laplacian": "gotoh"}),
    "equation_of_state": (
        "explicit", {"equation_of_state": sphear.BatchelorTait(1.0, 12.0)}, {"sound_speed": 12.0},
    ),
    "ideal_gas": (
        "explicit", {"equation_of_state": sphear.IdealGas(gamma=1.4)}, {"equation_of_state": "ideal_gas"},
    ),
}  # fmt: skip


@pytest.mark.parametrize("key", OBJECTS)
def test_an_object_is_the_name_that_stands_for_it(key: str) -> None:
    scheme, by_object, by_name = OBJECTS[key]
    case = "poiseuille" if key == "ideal_gas" else "cavity"
    if scheme == "explicit":  # the same stages, with the same numbers in them
        one, other = (
            WeaklyCompressibleFlow(FLOWS[case].problem(chosen), chosen)
            for chosen in (FLOWS[case].explicit(resolution=12, **chosen) for chosen in (by_object, by_name))
        )
        assert (one._step, one.sound_speed, one.time_step) == (other._step, other.sound_speed, other.time_step)
        return
    first, second = (flow(case, **chosen) for chosen in (by_object, by_name))
    np.testing.assert_array_equal(first.flow.velocities, second.flow.velocities)
    np.testing.assert_array_equal(first.flow.pressure, second.flow.pressure)


def test_an_equation_of_state_gives_its_own_speed_of_sound_and_pressure() -> None:
    stiff, soft = (
        sphear.flow("poiseuille", equation_of_state=equation, resolution=12)
        for equation in (sphear.IdealGas(gamma=1.67), sphear.IdealGas(gamma=1.1))
    )
    ratio = stiff.flow.resolved()["sound_speed"] / soft.flow.resolved()["sound_speed"]
    assert ratio == pytest.approx((1.67 / 1.1) ** 0.5)
    assert stiff.settings.model_dump(mode="json")["equation_of_state"] == "IdealGas(gamma=1.67)"


WRONG: dict[str, tuple[dict[str, Any], str]] = {
    "no name": ({"viscosity": 3}, "the setting viscosity should be a name, such as .*, or an object"),
    "a wrong name": ({"viscosity": "moris"}, "no viscosity named 'moris': did you mean morris"),
    "another kind": ({"kernel": sphear.Morris()}, r"the setting kernel should be .*, not Morris\(eta=None\)"),
    "a class": ({"kernel": sphear.WendlandC2}, "the setting kernel should be"),
    "h twice": ({"kernel": sphear.WendlandC2(0.1), "h_over_dx": 2}, "has its own h"),
    "an equation that is none": ({"equation_of_state": Mine()}, r"equation_of_state should be .*, not Mine\("),
    "another fluid": ({"equation_of_state": sphear.Linear(1e3, 10.0)}, "rho0 must be the density of the flow, 1"),
    "sound twice": ({"equation_of_state": sphear.Linear(1.0, 10.0), "sound_speed": 3}, "give its c0 instead"),
    "a hidden number": ({"viscosity": Hiding(3.0)}, "Hiding has hidden, which is no field of it"),
}


@pytest.mark.parametrize("what", WRONG)
def test_a_wrong_object_is_refused_in_one_sentence(what: str) -> None:
    chosen, sentence = WRONG[what]
    with pytest.raises(sphear.SphearError, match=sentence) as raised:
        sphear.flow("cavity", resolution=12, **chosen)
    assert "\n" not in str(raised.value)


def test_a_run_goes_on_with_an_equal_object_and_no_other(tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    flow(viscosity=Mine(), until=0.01).save(path)
    went_on = sphear.flow("cavity", scheme="incompressible", viscosity=Mine(factor=2), resolution=12, until=0.02)
    went_on.restore(path)
    np.testing.assert_allclose(went_on.run().flow.velocities, flow(viscosity=Mine()).flow.velocities, atol=1e-15)
    with pytest.raises(sphear.SphearError, match=r"has viscosity = Mine\(factor=2.0\), not Mine\(factor=3.0\)"):
        sphear.flow("cavity", scheme="incompressible", viscosity=Mine(factor=3), resolution=12, until=0.02).restore(
            path
        )


def test_a_setting_without_effect_is_told_beside_objects() -> None:
    run = sphear.flow("cavity", equation_of_state=sphear.Linear(1.0, 10.0), initial_pressure=3.0, resolution=12)
    assert run.settings.without_effect(walled=True) == [
        "initial_pressure has no effect with equation_of_state=Linear(rho0=1.0, c0=10.0)"
    ]


def test_a_patch_test_takes_objects() -> None:
    test = sphear.PatchTest(viscosity=(Mine(), sphear.Morris()), kernel=sphear.WendlandC2(0.12), sizes=(16,))
    own, morris = test.rows()
    assert (own["viscosity"], morris["viscosity"]) == ("Mine(factor=2.0)", "morris")
    assert own["l1"] == pytest.approx(morris["l1"], rel=1e-12)


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [({"dim": 3}, "no setting named 'dim': did you mean dimension"), ({"dimension": 4}, "dimension should be 2 or 3")],
)
def test_a_wrong_patch_test_is_refused_in_one_sentence(wrong: dict[str, Any], sentence: str) -> None:
    with pytest.raises(sphear.SphearError, match=sentence) as raised:
        sphear.PatchTest(**wrong)
    assert "\n" not in str(raised.value)


def test_a_sweep_takes_objects_and_names_of_ones_own(tmp_path: Path) -> None:
    sphear.VISCOSITY.add("cleary_2", sphear.Cleary(xi=2))
    try:
        over = {"viscosity": [sphear.Cleary(xi=3), sphear.Cleary(xi=3.0), "cleary_2"]}
        runs = plan("taylor-green", over, {"scheme": "incompressible", "resolution": 12, "until": 0.01})
        results = run_sweep(runs, Store(tmp_path))
    finally:
        sphear.VISCOSITY.remove("cleary_2")
    assert [(result.end, result.settings["viscosity"]) for result in results] == [
        ("time", "Cleary(xi=3.0, eta=0.1)"),
        ("time", "cleary_2"),
    ]


def test_a_sweep_refuses_an_object_that_its_workers_cannot_know(tmp_path: Path) -> None:
    @dataclass(frozen=True)
    class Local(Mine):
        """Known in this function only."""

    run = Run("taylor-green", sphear.flow("taylor-green", viscosity=Local(), resolution=12).settings)
    with pytest.raises(sphear.SphearError, match=r"the viscosity Local of this sweep .* put the class into a module"):
        run_sweep([run], Store(tmp_path))


def test_the_card_of_a_users_term() -> None:
    class Plain(sphear.LaplacianTerm):
        """Without anything but itself."""

    assert repr(Plain()).startswith(
        "Plain()\n  in words         Without anything but itself\n  formula          not stated"
    )
    assert repr(Mine()) == "Mine(factor=2.0)"
