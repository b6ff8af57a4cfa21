"""Everything that has a name, by kind, without importing what computes."""

from __future__ import annotations

import inspect
from contextlib import suppress
from functools import lru_cache
from importlib import import_module
from typing import TYPE_CHECKING, Any

from sphear.cli.output import print_sentence, progress
from sphear.errors import SphearError
from sphear.names import plain, unknown
from sphear.words import in_words

if TYPE_CHECKING:
    from sphear.viscosity.card import Card

_HOMES = {  # the module and the name of each registry
    "kernels": ("sphear.kernels", "KERNELS"),
    "viscosity": ("sphear.viscosity", "VISCOSITY"),
    "corrections": ("sphear.corrections", "CORRECTIONS"),
    "equations": ("sphear.equations_of_state", "EQUATIONS_OF_STATE"),
    "walls": ("sphear.boundaries.models", "WALL_MODELS"),
    "shifting": ("sphear.shifting", "SHIFTING"),
    "preconditioners": ("sphear.pressure", "PRECONDITIONERS"),
    "integrators": ("sphear.schemes.weakly_compressible.integrators", "INTEGRATORS"),
}
KINDS = (*_HOMES, "studies", "cases")
_SINGULAR = {
    "kernel": "kernels",
    "correction": "corrections",
    "equation": "equations",
    "equation_of_state": "equations",
    "wall": "walls",
    "wall_model": "walls",
    "preconditioner": "preconditioners",
    "integrator": "integrators",
    "study": "studies",
    "case": "cases",
    "viscous": "viscosity",
}

# the patch test has a command of its own, the flows are run by `sphear run`; summaries stand here so that listing them
# imports nothing
CASES = {
    "patch-test": "the Laplacian of a known field on a lattice or on jittered particles, against the exact one",
    "poiseuille": "plane Poiseuille flow from rest, against its start-up series",
    "couette": "plane Couette flow from rest, against its start-up series",
    "taylor-green": "the decaying Taylor-Green vortex in a periodic box",
    "cavity": "the lid-driven square cavity from rest, against computed and published profiles",
    "cavity-cylinder": "the lid-driven cavity with a cylinder inside, of any size at any place",
    "dam-break": "a column of fluid that collapses in a tank, against the measured front",
}


def kind_of(name: str) -> str:
    """The kind of a name in the plural or the singular; raises SphearError with the nearest."""
    kind = _SINGULAR.get(plain(name), plain(name))
    if kind not in KINDS:
        raise unknown("kind", name, KINDS)
    return kind


def kind_and_name(words: list[str]) -> tuple[str, str]:
    """The kind and the name that words say; the kind may be left out of a registered thing.

    Raises:
        SphearError: the first word is no kind and all together are no name, or a kind is alone.
    """
    try:
        kind = kind_of(words[0])
    except SphearError:
        whole = " ".join(words)
        for registered in ("viscosity", *_HOMES):
            with suppress(SphearError):
                return registered, _registry(registered).name(whole)
        raise
    if len(words) == 1:
        raise SphearError(f"show needs a name after {kind}, one of those that sphear list {kind} shows")
    return kind, " ".join(words[1:])


def entries(kind: str) -> list[dict[str, Any]]:
    """Name, aliases and a line about each thing of a kind."""
    if kind == "cases":
        return [{"name": name, "aliases": [], "summary": text} for name, text in CASES.items()]
    if kind == "studies":
        from sphear.studies import ITEMS

        return [
            {"name": f"{paper} {item}", "aliases": [], "summary": text}
            for paper, items in ITEMS.items()
            for item, text in items.items()
        ]
    registry = _registry(kind)
    return [
        {"name": name, "aliases": registry.aliases(name), "summary": _first_line(registry[name])} for name in registry
    ]


def _registry(kind: str) -> Any:
    module, name = _HOMES[kind]
    return getattr(import_module(module), name)


def _first_line(item: Any) -> str:
    """The first line of what is said of a registered thing.

    That of its module, where it has one of its own; of the class of a user's, whose module may be a whole program.
    """
    kind = item if inspect.isclass(item) else type(item)
    module = inspect.getmodule(kind) if kind.__module__.startswith("sphear.") else None
    text = (module.__doc__ if module else in_words(kind)) or item.formula
    return str(text).strip().partition("\n")[0].rstrip(".")


def described(kind: str, name: str) -> dict[str, Any]:
    """All that is known of one thing, for `sphear show`."""
    if kind in ("studies", "cases"):
        return _described_study(name) if kind == "studies" else _described_case(name)
    registry = _registry(kind)
    item = registry[name]
    facts = {"kind": kind, "name": registry.name(name), "aliases": registry.aliases(name)}
    if kind == "viscosity":
        return facts | viscous_card(facts["name"]).as_dict()
    facts |= {"summary": _first_line(item), "formula": item.formula}
    facts["source"] = item.source
    if kind == "kernels":
        facts |= {"support": f"{item.support:g} h", "sigma": dict(zip(("1-D", "2-D", "3-D"), item.sigma, strict=True))}
    return facts


@lru_cache
def viscous_card(name: str) -> Card:
    """The card of a term by its registered name; that of an extension is measured now, which takes some seconds."""
    from sphear.viscosity import VISCOSITY
    from sphear.viscosity.card import card

    known = card(None, name)
    if name in VISCOSITY.published:
        return known
    from sphear.cases.measured_card import measured_card

    with progress(f"measuring {name}") as tell:
        try:
            return known.with_properties(measured_card(name, tell).as_dict())
        except SphearError as error:
            print_sentence(f"the viscosity {name} cannot be measured: {error}")
            return known


def _described_study(name: str) -> dict[str, Any]:
    from sphear.studies import ITEMS, PAPERS, items

    paper, _, item = name.replace("/", " ").partition(" ")
    listed = {key: ITEMS[paper][key] for key in items(paper, [item] if item else [])}
    return {"kind": "studies", "name": name, "source": PAPERS[paper], "items": listed}


def _described_case(name: str) -> dict[str, Any]:
    known = {plain(case): case for case in CASES}
    if plain(name) not in known:
        raise unknown("case", name, CASES)
    from sphear.cli.explained import of_settings

    name = known[plain(name)]
    if name != "patch-test":
        from sphear.cases.flow import FLOWS
        from sphear.schemes.presets import BY_SCHEME

        case = FLOWS[name]
        settings = {scheme: case.settings(scheme=scheme).model_dump(mode="json") for scheme in case.defaults}
        about = {scheme: of_settings(case.kind(scheme)) for scheme in settings}
        presets = {scheme: {key: case.preset(key, scheme) for key in BY_SCHEME[scheme]} for scheme in settings}
        return {
            "kind": "cases", "name": name, "summary": CASES[name], "schemes": list(settings), **settings,
            "explained": about, "presets": presets,
        }  # fmt: skip
    from sphear.cases.fields import FIELDS
    from sphear.cases.patch_test import PatchTest

    settings = {key: field.default for key, field in PatchTest.model_fields.items()}
    return {
        "kind": "cases", "name": name, "summary": CASES[name], "fields": list(FIELDS), "settings": settings,
        "explained": {"settings": of_settings(PatchTest)},
    }  # fmt: skip
