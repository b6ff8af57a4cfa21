"""The defaults of an explicit flow, what becomes of them beside settings that are named, and the papers' presets."""

from __future__ import annotations

from typing import Any, cast

import pytest

import sphear
from sphear.equations_of_state import BatchelorTait, IdealGas
from sphear.errors import SphearError
from sphear.schemes.presets import BY_SCHEME
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings

BEST: dict[str, Any] = {
    "viscosity": "fatehi_manzari", "correction": "bonet_lok", "kernel": "wendland_c2", "h_over_dx": None,
    "equation_of_state": "batchelor_tait", "density": "continuity", "momentum": None, "pressure_reduction": "none",
    "density_diffusion": 0.1, "diffusion_form": "antuono", "walls": "mirror", "continuation": "quadratic",
    "wall_divergence": "slipping", "wall_particles": False, "integrator": "midpoint", "transport": "shifting",
}  # fmt: skip
SUMMED: dict[str, Any] = {
    "density": "summation", "density_diffusion": 0.0, "diffusion_form": "molteni", "wall_divergence": "continued",
}  # fmt: skip

# a setting that is named, its value, and what others become that nobody named
BESIDE: list[tuple[str, Any, dict[str, Any]]] = [
    ("viscosity", "morris", {}),
    ("correction", "none", {}),
    ("kernel", "cubic_spline", {}),
    ("equation_of_state", "batchelor_tait", {}),
    ("equation_of_state", "linear", {}),
    ("equation_of_state", BatchelorTait(1000.0, 10.0, 7), {}),
    ("equation_of_state", "ideal_gas", {"transport": "none"}),
    ("equation_of_state", IdealGas(1.6), {"transport": "none"}),
    ("density", "continuity", {}),
    ("density", "summation", SUMMED),
    ("momentum", None, {}),
    ("momentum", "products", {}),
    ("momentum", "squares", SUMMED),
    ("pressure_reduction", "none", {}),
    ("pressure_reduction", "mean", {}),
    ("pressure_reduction", "hydrostatic", {}),
    ("density_diffusion", 0.2, {}),
    ("density_diffusion", 0.0, {"diffusion_form": "molteni"}),
    ("diffusion_form", "antuono", {}),
    ("diffusion_form", "molteni", {}),
    ("walls", "mirror", {}),
    ("walls", "fixed", SUMMED),
    ("walls", "adami", SUMMED),
    ("continuation", "linear", {}),
    ("wall_divergence", "slipping", {}),
    ("wall_divergence", "continued", {}),
    ("wall_particles", True, {}),
    ("wall_particles", False, {}),
    ("integrator", "midpoint", {}),
    ("integrator", "kick_drift_kick", {}),
    ("transport", "none", {}),
    ("transport", "shifting", {}),
    ("transport", "transport_velocity", SUMMED),
    ("sound_speed", 20.0, {}),
]


def test_the_defaults_are_the_best_settings() -> None:
    assert {name: getattr(WeaklyCompressibleSettings(), name) for name in BEST} == BEST


@pytest.mark.parametrize("case", ["poiseuille", "couette", "taylor-green", "cavity"])
def test_a_flow_without_a_preset_has_the_best_settings(case: str) -> None:
    settings = sphear.flow(case, resolution=12).settings
    assert {name: getattr(settings, name) for name in BEST} == BEST


@pytest.mark.parametrize(("name", "value", "others"), BESIDE, ids=lambda x: "" if isinstance(x, dict) else str(x))
def test_defaults_give_way_to_what_is_named(name: str, value: Any, others: dict[str, Any]) -> None:
    settings = WeaklyCompressibleSettings(**{name: value})
    assert {key: getattr(settings, key) for key in BEST} | {name: value} == {**BEST, **others, name: value}
    assert settings.model_fields_set == {name}
    assert settings.without_effect(walled=True) == []


@pytest.mark.parametrize(("name", "value", "others"), BESIDE, ids=lambda x: "" if isinstance(x, dict) else str(x))
def test_settings_written_down_and_read_again_are_the_same(name: str, value: Any, others: dict[str, Any]) -> None:
    settings = WeaklyCompressibleSettings(**{name: value})
    written = settings.model_dump(exclude={name}) | {name: value}  # an object is no text
    again = WeaklyCompressibleSettings(**written)
    assert again == settings
    assert again.without_effect(walled=True) == []
    named = WeaklyCompressibleSettings(**{key: written[key] for key in settings.model_fields_set})
    assert named == settings
    assert named.model_fields_set == settings.model_fields_set


@pytest.mark.parametrize("walls", ["fixed", "adami"])
@pytest.mark.parametrize(
    "named", [{"density": "continuity"}, {"momentum": "products"}, {"density_diffusion": 0.05}], ids=str
)
def test_densities_beside_walls_of_particles_are_integrated_where_that_is_named(
    walls: str, named: dict[str, Any]
) -> None:
    settings = WeaklyCompressibleSettings.model_validate({"walls": walls, **named})
    form = "molteni" if walls == "adami" else "antuono"
    assert (settings.density, settings.diffusion_form, settings.wall_divergence) == ("continuity", form, "continued")


def test_every_choice_is_tried_alone() -> None:
    tried = {(name, value) for name, value, _ in BESIDE if isinstance(value, str | None)}
    choices: dict[str, tuple[str, ...]] = {
        "density": ("summation", "continuity"),
        "momentum": ("squares", "products"),
        "pressure_reduction": ("mean", "hydrostatic", "none"),
        "diffusion_form": ("molteni", "antuono"),
        "walls": ("mirror", "fixed", "adami"),
        "integrator": ("midpoint", "kick_drift_kick"),
        "transport": ("none", "shifting", "transport_velocity"),
        "equation_of_state": ("batchelor_tait", "linear", "ideal_gas"),
    }
    assert {(name, value) for name, values in choices.items() for value in values} <= tried


@pytest.mark.parametrize(
    ("named", "sentence"),
    [
        (
            {"density": "summation", "wall_divergence": "slipping"},
            "wall_divergence=slipping is about the continuity",
        ),
        ({"walls": "fixed", "wall_divergence": "slipping"}, "and not for density=summation with walls=fixed"),
        (
            {"walls": "adami", "density": "continuity", "diffusion_form": "antuono"},
            "antuono needs density gradients in the walls",
        ),
        ({"momentum": "squares", "density_diffusion": 0.1}, "density=summation has none"),
        ({"transport": "transport_velocity", "density": "continuity"}, "not for density=continuity"),
        ({"transport": "shifting", "equation_of_state": "ideal_gas"}, "take transport=none"),
    ],
)
def test_settings_that_are_named_do_not_give_way(named: dict[str, Any], sentence: str) -> None:
    with pytest.raises(SphearError, match=sentence):
        WeaklyCompressibleSettings(**named)


PAPERS: dict[str, tuple[str, dict[str, Any]]] = {
    "basa2009": (
        "explicit",
        {
            "viscosity": "morris", "correction": "none", "kernel": "cubic_spline", "h_over_dx": None,
            "equation_of_state": "batchelor_tait", "density": "summation", "momentum": None,
            "pressure_reduction": "mean", "density_diffusion": 0.0, "diffusion_form": "molteni", "walls": "mirror",
            "continuation": "linear", "wall_divergence": "continued", "wall_particles": False, "integrator": "midpoint",
            "transport": "none",
        },
    ),
    "zheng2018": (
        "incompressible",
        {
            "viscosity": "oger", "kernel": "cubic_spline", "h_over_dx": 1.2, "gradient": "symmetric",
            "gradient_correction": "none", "laplacian": "morris", "alpha": 0.01, "projection": "intermediate",
            "walls": "sfdi", "continuation": "mirror", "wall_divergence": "continued", "shifting": "none",
        },
    ),
}  # fmt: skip


@pytest.mark.parametrize("preset", PAPERS)
def test_a_preset_has_the_settings_of_its_paper(preset: str) -> None:
    scheme, settings = PAPERS[preset]
    assert list(BY_SCHEME[scheme]) == [preset]
    found = sphear.flow("poiseuille", scheme=scheme, preset=preset, resolution=12).settings
    assert {name: getattr(found, name) for name in settings} == settings


def test_the_papers_cavity_has_its_own_walls() -> None:
    """Section 6.2: fixed particles, and results with level 0."""
    found = sphear.flow("cavity", preset="basa2009", resolution=12).settings.model_dump()
    walls = {"walls": "fixed", "continuation": "quadratic", "correction": "shepard"}
    assert {name: found[name] for name in BEST} == {**PAPERS["basa2009"][1], **walls}


@pytest.mark.parametrize("case", ["taylor-green", "poiseuille"])
def test_nobody_is_told_that_a_part_of_a_preset_has_no_effect(case: str) -> None:
    run = sphear.flow(case, preset="basa2009", walls="adami", resolution=12)
    assert run.settings.without_effect(run.flow.problem.walled) == []


@pytest.mark.parametrize(
    ("preset", "scheme", "allowed"),
    [
        ("modern", "explicit", "basa2009"),
        ("paper", "incompressible", "zheng2018"),
        ("basa2009", "incompressible", "zheng2018"),
    ],
)
def test_a_preset_that_a_scheme_has_not_is_refused_with_those_it_has(preset: str, scheme: str, allowed: str) -> None:
    with pytest.raises(SphearError, match=rf"^there is no preset named '{preset}': .*preset is one of {allowed}$"):
        sphear.flow("cavity", scheme=scheme, preset=preset)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("slip", "wall_divergence, slipping for true"),
        ("neumann", "called walls"),
        ("wall_velocity", "called continuation"),
    ],
)
def test_settings_of_before_are_told_by_their_names_of_now(name: str, said: str) -> None:
    with pytest.raises(SphearError, match=f"the setting {name} of 0.1 is .*{said}"):
        WeaklyCompressibleSettings(**cast(Any, {name: True}))
