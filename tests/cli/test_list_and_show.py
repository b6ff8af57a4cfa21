"""`sphear list` and `sphear show`: every name and alias of everything that can be chosen."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from sphear import (
    CORRECTIONS,
    EQUATIONS_OF_STATE,
    INTEGRATORS,
    KERNELS,
    PRECONDITIONERS,
    SHIFTING,
    VISCOSITY,
    WALL_MODELS,
    Morris,
    __version__,
)
from sphear.cases.fields import FIELDS
from sphear.cases.flow import FLOWS
from sphear.cases.patch_test import PatchTest
from sphear.names import Registry
from sphear.studies import ITEMS, PAPERS
from sphear.viscosity.card import measured

Run = Callable[..., Any]

REGISTRIES: dict[str, Registry[Any]] = {
    "kernels": KERNELS,
    "viscosity": VISCOSITY,
    "corrections": CORRECTIONS,
    "equations": EQUATIONS_OF_STATE,
    "walls": WALL_MODELS,
    "shifting": SHIFTING,
    "preconditioners": PRECONDITIONERS,
    "integrators": INTEGRATORS,
}
STUDIES = [f"{paper} {item}" for paper, items in ITEMS.items() for item in items]
NAMES = {
    **{kind: list(registry) for kind, registry in REGISTRIES.items()},
    "studies": STUDIES,
    "cases": ["patch-test", *FLOWS],
}
SINGULAR = {
    "kernel": "kernels",
    "viscous": "viscosity",
    "correction": "corrections",
    "equation": "equations",
    "Equation-of-State": "equations",
    "wall model": "walls",
    "preconditioner": "preconditioners",
    "integrator": "integrators",
    "study": "studies",
    "case": "cases",
}


def names_and_aliases() -> Iterator[tuple[str, str, str]]:
    for kind, registry in REGISTRIES.items():
        for name in registry:
            for spelling in (name, *registry.aliases(name)):
                yield kind, spelling, name


@pytest.mark.parametrize("kind", NAMES)
def test_a_kind_is_listed_with_all_its_names(kind: str, sphear: Run) -> None:
    listed = sphear("list", kind, "--json").json()
    assert [entry["name"] for entry in listed[kind]] == NAMES[kind]
    assert list(listed) == [kind]


def test_everything_is_listed_by_default(sphear: Run) -> None:
    listed = sphear("list", "--json").json()
    assert {kind: [entry["name"] for entry in entries] for kind, entries in listed.items()} == NAMES


@pytest.mark.parametrize(("one", "kind"), SINGULAR.items())
def test_a_kind_may_be_named_in_the_singular(one: str, kind: str, sphear: Run) -> None:
    assert sphear("list", one, "--json").json() == sphear("list", kind.upper(), "--json").json()


@pytest.mark.parametrize("kind", REGISTRIES)
def test_aliases_are_listed(kind: str, sphear: Run) -> None:
    listed = {entry["name"]: entry["aliases"] for entry in sphear("list", kind, "--json").json()[kind]}
    assert listed == {name: REGISTRIES[kind].aliases(name) for name in REGISTRIES[kind]}


@pytest.mark.parametrize("kind", NAMES)
def test_each_entry_has_a_line_about_it(kind: str, sphear: Run) -> None:
    for entry in sphear("list", kind, "--json").json()[kind]:
        assert len(entry["summary"]) > 10
        assert "\n" not in entry["summary"]


@pytest.mark.parametrize("kind", NAMES)
def test_the_table_has_a_line_for_each_name(kind: str, sphear: Run) -> None:
    found = sphear("list", kind)
    assert (found.status, found.err) == (0, "")
    assert [name for name in NAMES[kind] if f"\n  {name}  " not in found.out] == []


@pytest.mark.parametrize(("kind", "spelling", "name"), list(names_and_aliases()))
def test_a_thing_is_shown_by_name_and_alias(kind: str, spelling: str, name: str, sphear: Run) -> None:
    facts = sphear("show", kind, spelling, "--json").json()
    assert (facts["kind"], facts["name"]) == (kind, name)
    assert facts["aliases"] == REGISTRIES[kind].aliases(name)
    assert (facts["formula"], facts["source"]) == (REGISTRIES[kind][name].formula, REGISTRIES[kind][name].source)


@pytest.mark.parametrize(("kind", "name"), [(kind, name) for kind in REGISTRIES for name in NAMES[kind]])
def test_the_text_says_formula_and_source_in_full(kind: str, name: str, sphear: Run) -> None:
    found = sphear("show", kind, name)
    assert (found.status, found.err) == (0, "")
    assert REGISTRIES[kind][name].formula in found.out
    assert REGISTRIES[kind][name].source in found.out


@pytest.mark.parametrize("name", list(VISCOSITY))
def test_a_viscous_term_is_shown_with_what_was_measured_of_it(name: str, sphear: Run) -> None:
    facts = sphear("show", "viscosity", name, "--json").json()
    assert {key: facts[key] for key in measured()[name]} == measured()[name]


@pytest.mark.parametrize("name", list(KERNELS))
def test_a_kernel_is_shown_with_its_support_and_factors(name: str, sphear: Run) -> None:
    facts = sphear("show", "kernel", name, "--json").json()
    assert facts["support"] == f"{KERNELS[name].support:g} h"
    assert tuple(facts["sigma"].values()) == pytest.approx(KERNELS[name].sigma)


@pytest.mark.parametrize("words", [["cubic", "spline"], ["Cubic-Spline"], [" CUBIC "]])
def test_a_name_may_be_written_in_words(words: list[str], sphear: Run) -> None:
    assert sphear("show", "kernel", *words, "--json").json()["name"] == "cubic_spline"


@pytest.mark.parametrize(("words", "kind"), [(["VISC-03"], "viscosity"), (["Cubic", "Spline"], "kernels")])
def test_the_kind_may_be_left_out(words: list[str], kind: str, sphear: Run) -> None:
    assert sphear("show", *words, "--json").json()["kind"] == kind


def test_a_kind_alone_is_refused(sphear: Run) -> None:
    found = sphear("show", "kernel")
    assert (found.status, found.out) == (2, "")
    assert found.err == "sphear: show needs a name after kernels, one of those that sphear list kernels shows\n"


@pytest.mark.parametrize("study", STUDIES)
@pytest.mark.parametrize("separator", [" ", "/", None])
def test_an_item_of_a_study_is_shown(study: str, separator: str | None, sphear: Run) -> None:
    paper, item = study.split()
    words = [paper, item] if separator is None else [f"{paper}{separator}{item}"]
    facts = sphear("show", "study", *words, "--json").json()
    assert facts["items"] == {item: ITEMS[paper][item]}


@pytest.mark.parametrize("paper", ITEMS)
def test_a_study_is_shown_with_its_source_and_items(paper: str, sphear: Run) -> None:
    facts = sphear("show", "study", paper, "--json").json()
    assert (facts["source"], facts["items"]) == (PAPERS[paper], ITEMS[paper])


def test_a_case_is_shown_with_its_fields_and_settings(sphear: Run) -> None:
    facts = sphear("show", "case", "patch-test", "--json").json()
    assert facts["fields"] == list(FIELDS)
    assert facts["settings"] == PatchTest().model_dump(mode="json")


@pytest.mark.parametrize("name", ["patch-test", *FLOWS])
def test_every_setting_of_a_case_is_explained_in_80_columns(name: str, sphear: Run) -> None:
    facts = sphear("show", "case", name, "--json").json()
    found = sphear("show", "case", name)
    assert (found.status, found.err) == (0, "")
    assert [line for line in found.out.splitlines() if len(line) > 79] == []
    for scheme, about in facts["explained"].items():
        assert list(about) == list(facts[scheme])
        for setting, one in about.items():
            assert min(len(one["meaning"]), len(one["values"])) > 3
            assert f"\n    {setting} = " in found.out
    for presets in facts.get("presets", {}).values():
        assert all(f"--preset {preset} " in found.out for preset in presets)


def test_choices_and_bounds_are_shown(sphear: Run) -> None:
    said = " ".join(sphear("show", "case", "dam-break").out.split())
    for text in ("walls = mirror_points mirror_points, adami, sfdi, natural", "tank = 6 a number >= 1.5 and <= 1000",
                 "alpha = none a number >= 0 and <= 1, or none", "kernel = wendland_c2 cubic_spline, quartic_spline",
                 "continuation = linear mirror, linear, quadratic, wall how",
                 "column = 2 a number > 0 and <= 100 its height over its width."):  # fmt: skip
        assert text in said


def test_a_users_term_is_listed_and_shown(sphear: Run) -> None:
    class Mine(Morris):
        """One from a script."""

        name = "mine"

    VISCOSITY.add("mine", Mine())
    try:
        listed = sphear("list", "viscosity", "--json").json()["viscosity"]
        assert listed[-1] == {"name": "mine", "aliases": [], "summary": "One from a script"}
        assert sphear("show", "viscosity", "mine").out.startswith("Mine(eta=None)\n")
    finally:
        VISCOSITY.remove("mine")


@pytest.mark.parametrize("name", list(FLOWS))
def test_a_flow_is_shown_with_the_settings_of_each_scheme(name: str, sphear: Run) -> None:
    facts = sphear("show", "case", name.replace("-", "_"), "--json").json()
    assert facts["schemes"] == list(FLOWS[name].defaults)
    for scheme in facts["schemes"]:
        assert facts[scheme] == FLOWS[name].settings(scheme=scheme).model_dump(mode="json")


@pytest.mark.parametrize("arguments", [("--version",), ("--help",), ("-h",), ()])
def test_what_answers_at_once(arguments: tuple[str, ...], sphear: Run) -> None:
    found = sphear(*arguments)
    assert (found.status, found.err) == (0, "")
    assert (__version__ if "--version" in arguments else "Usage: sphear") in found.out


@pytest.mark.parametrize("command", ["list", "show", "patch-test", "reproduce"])
def test_every_command_has_help(command: str, sphear: Run) -> None:
    found = sphear(command, "--help")
    assert (found.status, found.err) == (0, "")
    assert f"Usage: sphear {command}" in found.out
