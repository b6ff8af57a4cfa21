"""Shifting, wall models and preconditioners as objects: the same choice as names and flat settings."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, cast

import numpy as np
import pytest

import sphear
from sphear import (
    SFDI,
    AdamiDummies,
    FixedParticles,
    Grid,
    Incompressible,
    Jacobi,
    KickDriftKick,
    Lind,
    Midpoint,
    MirrorParticles,
    MirrorPoints,
    Natural,
    NoShifting,
    WeaklyCompressible,
    Xu,
)

ALONE: list[tuple[dict[str, Any], dict[str, Any]]] = [
    ({"shifting": Lind()}, {}),
    ({"shifting": Lind(1.0)}, {"shifting_strength": 1.0}),
    ({"shifting": Xu(0.7)}, {"shifting": "xu", "shifting_strength": 0.7}),
    ({"shifting": NoShifting()}, {"shifting": "none"}),
    ({"walls": MirrorPoints()}, {}),
    ({"walls": MirrorPoints("linear")}, {"continuation": "linear"}),
    ({"walls": AdamiDummies(divergence="continued")}, {"walls": "adami", "wall_divergence": "continued"}),
    ({"walls": SFDI("mirror")}, {"walls": "sfdi", "continuation": "mirror"}),
    ({"walls": Natural()}, {"walls": "natural"}),
    ({"walls": MirrorPoints("wall"), "continuation": "wall"}, {"continuation": "wall"}),
    ({"preconditioner": Jacobi()}, {"preconditioner": "jacobi"}),
    ({"preconditioner": Grid()}, {}),
]


@pytest.mark.parametrize(("objects", "flat"), ALONE)
def test_an_object_is_the_same_choice_as_flat_settings(objects: dict[str, Any], flat: dict[str, Any]) -> None:
    found, expected = Incompressible(**objects), Incompressible(**flat)
    assert found == expected
    assert found.model_dump(mode="json") == expected.model_dump(mode="json")
    assert str(found) == str(expected)
    assert (found.wall_model, found.shifting_method) == (expected.wall_model, expected.shifting_method)


OF_THE_EXPLICIT: list[tuple[dict[str, Any], dict[str, Any]]] = [
    ({"walls": MirrorParticles()}, {}),
    ({"walls": MirrorParticles("mirroring")}, {"continuation": "mirror"}),
    ({"walls": MirrorParticles("global"), "density": "summation"},
     {"continuation": "global_quadratic", "density": "summation"}),
    ({"walls": MirrorParticles(divergence="continued", on_wall=True)},
     {"wall_divergence": "continued", "wall_particles": True}),
    ({"walls": FixedParticles(continuation="linear")}, {"walls": "fixed", "continuation": "linear"}),
    ({"walls": AdamiDummies()}, {"walls": "adami"}),
    ({"integrator": KickDriftKick()}, {"integrator": "kick_drift_kick"}),
    ({"integrator": Midpoint()}, {"integrator": "rk2"}),
]  # fmt: skip


@pytest.mark.parametrize(("objects", "flat"), OF_THE_EXPLICIT)
def test_an_object_is_the_same_choice_in_the_explicit_scheme(objects: dict[str, Any], flat: dict[str, Any]) -> None:
    found, expected = WeaklyCompressible(**objects), WeaklyCompressible(**flat)
    assert found == expected
    assert found.model_dump(mode="json") == expected.model_dump(mode="json")
    assert str(found) == str(expected)
    assert (found.wall_model, found.time_integrator) == (expected.wall_model, expected.time_integrator)
    assert WeaklyCompressible(**dict(found)) == found
    assert found.without_effect(walled=True) == []


def test_the_object_has_the_flat_settings() -> None:
    chosen = Incompressible(walls="Adami-Dummies", continuation="mirror", shifting="XU", shifting_strength=2.0)
    assert (chosen.walls, chosen.shifting) == ("adami", "xu")
    assert chosen.wall_model == AdamiDummies("mirror", "slipping")
    assert chosen.shifting_method == Xu(2.0)


@pytest.mark.parametrize(
    "item",
    [
        Lind(0.25), Xu(), NoShifting(), SFDI("wall"), Natural(), Grid(3.0), Jacobi(), MirrorParticles(on_wall=True),
        FixedParticles("linear"), KickDriftKick(),
    ],
)  # fmt: skip
def test_an_object_prints_as_python(item: Any) -> None:
    assert eval(repr(item), {name: getattr(sphear, name) for name in sphear.__all__}) == item


@pytest.mark.parametrize("changes", [{"preconditioner": Grid(coarsening=3.0)}, {"walls": SFDI(), "shifting": Xu(0.3)}])
def test_settings_written_down_and_read_again_are_the_same(changes: dict[str, Any]) -> None:
    chosen = Incompressible(**changes)
    assert Incompressible(**dict(chosen)) == chosen
    assert Incompressible.model_validate(dict(chosen)) == chosen


def test_an_object_that_no_name_says_is_written_as_python() -> None:
    assert Incompressible(preconditioner=Grid(coarsening=3)).model_dump(mode="json")["preconditioner"] == (
        "Grid(coarsening=3.0, damping=0.7)"
    )


WRONG: dict[str, tuple[Callable[[], object], str]] = {
    "strengths": (
        lambda: Incompressible(shifting=Lind(0.5), shifting_strength=1.0),
        r"shifting=Lind\(strength=0.5\) and shifting_strength=1.0 contradict each other",
    ),
    "continuations": (
        lambda: sphear.flow("cavity", scheme="incompressible", walls=MirrorPoints(), continuation="linear"),
        r"walls=MirrorPoints\(.*\) and continuation=linear contradict each other",
    ),
    "of the explicit scheme": (
        lambda: sphear.WeaklyCompressible(transport=Lind(0.5), shifting_strength=1.0),
        "transport=.* contradict each other",
    ),
    "not of the explicit scheme": (
        lambda: sphear.flow("cavity", scheme="explicit", transport=Xu()),  # type: ignore[arg-type]
        "transport should be 'none', 'shifting' or 'transport_velocity', not Xu",
    ),
    "no strength": (lambda: Lind(0.0), "the strength of shifting must be a positive number, not 0.0"),
    "no continuation": (lambda: MirrorPoints("cubic"), "continuation .* one of .*quadratic.*, not 'cubic'"),  # type: ignore[arg-type]
    "no damping": (
        lambda: Grid(damping=-1.0),
        "the damping of the preconditioner grid must be a positive .*-1.0",
    ),
    "a class": (lambda: Incompressible(shifting=cast(Any, Lind)), "an object of the class ShiftingMethod, not <class"),
    "another kind": (lambda: Incompressible(walls=cast(Any, Lind())), "an object of the class WallModel, not Lind"),
    "a near name": (
        lambda: Incompressible(walls="miror"),
        "walls is to be a wall model, .* did you mean mirror_points .* is one of mirror_points, adami, sfdi, natural$",
    ),
    "a near name of the explicit scheme": (
        lambda: WeaklyCompressible(walls="fixd"),
        "walls is to be a wall model, .* did you mean fixed.* is one of adami, mirror, fixed$",
    ),
    "a name of the other scheme": (
        lambda: Incompressible(walls="fixed"),
        "walls=fixed is no wall model of the incompressible scheme, which has mirror_points, adami, sfdi, natural",
    ),
    "no wall model at all": (
        lambda: WeaklyCompressible(walls=cast(Any, Lind())),
        "walls should be a name, such as 'adami', or an object of the class ExplicitWallModel, not Lind",
    ),
    "Adami's by a continuation": (
        lambda: WeaklyCompressible(walls=AdamiDummies("linear")),
        "finds velocities behind walls=adami in its own way: leave continuation and divergence out of Adami",
    ),
    "fits of fixed particles": (
        lambda: FixedParticles("mirror"),
        "^walls=fixed .* continuation=linear or quadratic, not mirror$",
    ),
    "fits of mirrors": (lambda: MirrorParticles("cubic"), "there is no continuation named 'cubic'"),
    "divergence of mirrors": (
        lambda: MirrorParticles(divergence=cast(Any, "sliding")),
        "divergence of the wall model MirrorParticles should be one of slipping, continued, not 'sliding'",
    ),
    "no yes or no": (lambda: MirrorParticles(on_wall=cast(Any, 1)), "on_wall .* should be True or False, not 1"),
    "both divergences": (
        lambda: WeaklyCompressible(walls=MirrorParticles(divergence="slipping"), wall_divergence="continued"),
        "contradict each other: leave wall_divergence to the object",
    ),
    "no integrator": (
        lambda: WeaklyCompressible(integrator=cast(Any, Lind())),
        "integrator should be a name, such as 'midpoint', or an object of the class Integrator, not Lind",
    ),
}


@pytest.mark.parametrize("mistake", WRONG)
def test_mistakes_are_told_in_a_sentence(mistake: str) -> None:
    make, sentence = WRONG[mistake]
    with pytest.raises(sphear.SphearError, match=sentence):
        make()


def test_an_object_goes_before_the_defaults_of_cases_and_presets() -> None:
    chosen: Any = sphear.flow("dam-break", walls=MirrorPoints(), resolution=8).settings
    assert chosen.continuation == "quadratic"
    paper: Any = sphear.flow(
        "cavity", scheme="incompressible", preset="zheng2018", walls=AdamiDummies(), shifting=Lind(1.0), resolution=12
    ).settings
    assert (paper.wall_model, paper.shifting_method) == (AdamiDummies(), Lind(1.0))


def test_the_explicit_scheme_has_the_strength_of_the_object() -> None:
    chosen = sphear.WeaklyCompressible(transport=Lind(0.3))
    assert (chosen.transport, chosen.shifting_strength) == ("shifting", 0.3)


def test_a_flow_by_objects_is_that_by_names() -> None:
    common: dict[str, Any] = {"scheme": "incompressible", "resolution": 12, "reynolds": 10.0}
    one = sphear.flow("cavity", **common, walls=SFDI("mirror"), shifting=Xu(1.0), preconditioner=Jacobi())
    flat: dict[str, Any] = {"walls": "sfdi", "continuation": "mirror", "shifting": "xu", "shifting_strength": 1.0}
    other = sphear.flow("cavity", **common, **flat, preconditioner="jacobi")
    for run in (one, other):
        run.flow.advance(3)
    np.testing.assert_array_equal(one.flow.velocities, other.flow.velocities)
    assert one.flow.resolved() == other.flow.resolved()
