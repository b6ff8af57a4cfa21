"""The registry of names, and the registries of kernels, corrections and viscous terms."""

from __future__ import annotations

from typing import Any

import pytest

from sphear import CORRECTIONS, KERNELS, VISCOSITY, SphearError
from sphear.errors import quoted
from sphear.names import Registry, unknown

REGISTRIES = {"kernel": KERNELS, "correction": CORRECTIONS, "viscosity": VISCOSITY}


@pytest.fixture
def fruit() -> Registry[int]:
    registry: Registry[int] = Registry("fruit")
    registry.add("apple", 1, aliases=("Malus-domestica", "a"))
    registry.add("pear_tree", 2)
    return registry


@pytest.mark.parametrize(
    "spelling", ["apple", "APPLE", " apple ", "malus_domestica", "Malus domestica", "malus-DOMESTICA", "a", "A"]
)
def test_an_item_is_found_by_name_or_alias_whatever_the_spelling(fruit: Registry[int], spelling: str) -> None:
    assert fruit[spelling] == 1
    assert fruit.name(spelling) == "apple"


def test_iteration_is_over_names_in_the_order_of_registration(fruit: Registry[int]) -> None:
    assert list(fruit) == ["apple", "pear_tree"]
    assert len(fruit) == 2


@pytest.mark.parametrize("taken", ["apple", "Pear-Tree", "malus domestica"])
def test_a_name_taken_twice_is_refused(fruit: Registry[int], taken: str) -> None:
    with pytest.raises(SphearError, match="is taken by "):
        fruit.add(taken, 3)
    with pytest.raises(SphearError, match="is taken by "):
        fruit.add("plum", 3, aliases=(taken,))


def test_a_removed_name_and_its_aliases_are_free_again(fruit: Registry[int]) -> None:
    fruit.remove("apple")
    assert list(fruit) == ["pear_tree"]
    with pytest.raises(SphearError, match="there is no fruit named 'malus_domestica'"):
        fruit["malus_domestica"]
    fruit.add("plum", 3, aliases=("apple",))
    assert fruit["apple"] == 3


def test_an_unknown_name_is_refused_with_the_nearest_and_all_names(fruit: Registry[int]) -> None:
    with pytest.raises(SphearError, match=r"^there is no fruit named 'aple': did you mean apple\?") as caught:
        fruit["aple"]
    assert str(caught.value).endswith("fruit is one of apple, pear_tree")


def test_a_misspelt_alias_is_recognised_too(fruit: Registry[int]) -> None:
    with pytest.raises(SphearError, match=r"did you mean malus_domestica\?"):
        fruit["malus domestika"]


def test_nothing_is_suggested_where_nothing_is_near(fruit: Registry[int]) -> None:
    with pytest.raises(SphearError, match=r"^there is no fruit named 'xyz': fruit is one of apple, pear_tree$"):
        fruit["xyz"]


@pytest.mark.parametrize("name", ["Appel", "pear tre"])
def test_nearness_does_not_depend_on_the_spelling(name: str) -> None:
    assert "did you mean" in str(unknown("fruit", name, ["apple", "pear_tree"]))


@pytest.mark.parametrize("kind", REGISTRIES)
def test_every_registered_thing_is_found_under_each_of_its_names(kind: str) -> None:
    registry: Any = REGISTRIES[kind]
    assert registry.kind == kind
    for name in registry:
        item = registry[name]
        for spelling in (name, name.upper(), name.replace("_", "-")):
            assert registry[spelling] is item
        if item.name == name:
            assert all(registry[alias] is item for alias in item.aliases)


@pytest.mark.parametrize(
    ("label", "name"),
    [
        ("A", "takeda"), ("B", "two_pass"), ("C", "violeau"), ("D", "cleary"), ("E", "morris"),
        ("VISC-01", "morris"), ("VISC-02", "gotoh"), ("VISC-03", "schwaiger"), ("VISC-04", "oger"),
        ("Visc 01", "morris"), ("visc_02", "gotoh"),
    ],
)  # fmt: skip
def test_the_papers_labels_name_the_viscous_terms(label: str, name: str) -> None:
    assert VISCOSITY.name(label) == VISCOSITY.name(label.lower()) == name


@pytest.mark.parametrize(("level", "name"), [("0", "shepard"), ("1", "bonet_lok"), ("level-1", "bonet_lok")])
def test_the_levels_name_the_corrections(level: str, name: str) -> None:
    assert CORRECTIONS.name(level) == name


@pytest.mark.parametrize("kind", REGISTRIES)
def test_every_registered_thing_says_its_formula_and_source(kind: str) -> None:
    registry: Any = REGISTRIES[kind]
    for name in registry:
        assert registry[name].formula
        assert registry[name].source
        assert registry[name].__doc__


def test_a_name_is_suggested_in_one_spelling_and_quoted_as_it_was_given() -> None:
    registry: Registry[int] = Registry("case")
    registry.add("cavity-cylinder", 1)
    with pytest.raises(SphearError) as told:
        registry["my_cavity_cylinder"]
    assert str(told.value) == (
        "there is no case named 'my_cavity_cylinder': did you mean cavity-cylinder? case is one of cavity-cylinder"
    )


def test_the_setting_is_named_where_it_is_called_otherwise_than_its_kind() -> None:
    with pytest.raises(
        SphearError, match=r"^the setting laplacian is to be a viscosity, and there is no viscosity named"
    ):
        VISCOSITY.name("x", "the setting laplacian")


@pytest.mark.parametrize(
    "name", ["k" * 100_000, "\n" * 5000, [[0] * 9] * 9999, 10**5000], ids=["k", "lines", "lists", "n"]
)
def test_what_is_refused_is_not_repeated_whole(name: Any) -> None:
    assert len(quoted(name)) <= 80
    assert len(str(SphearError(f"not {name if isinstance(name, str) else quoted(name)}"))) <= 1200
    assert "\n" not in quoted(name)


def test_short_values_are_quoted_as_python_writes_them() -> None:
    assert [quoted(value) for value in ("a", 1.5, None, (1, 2))] == ["'a'", "1.5", "None", "(1, 2)"]
