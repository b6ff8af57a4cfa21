"""The settings of a case as `sphear show` prints them: value, choices and meaning of each, in 80 columns."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from textwrap import wrap
from typing import Any

from pydantic import BaseModel

from sphear.described import explained

WIDTH = 79


def of_settings(kind: type[BaseModel]) -> dict[str, dict[str, str]]:
    """Meaning and values of each setting of a class, by name."""
    from sphear.schemes.registered_names import REGISTRIES, choices

    listed = {
        key: "any of `sphear list viscosity`" if REGISTRIES[key].kind == "viscosity" else ", ".join(names)
        for key, names in choices(kind).items()
    }
    return {name: {"meaning": one.meaning, "values": one.values} for name, one in explained(kind, listed).items()}


def case_lines(facts: Mapping[str, Any]) -> list[str]:
    """A case in a sentence, its settings, those that all its schemes share first, and its presets."""
    schemes = facts.get("schemes", ["settings"])
    first = schemes[0]
    both = [
        name
        for name, value in facts[first].items()
        if all(
            name in facts[scheme]
            and (facts[scheme][name], facts["explained"][scheme][name]) == (value, facts["explained"][first][name])
            for scheme in schemes
        )
    ]
    lines = [str(facts["name"]), *_wrapped(facts["summary"])]
    if "fields" in facts:
        lines += _wrapped(f"fields: {', '.join(facts['fields'])}")
    lines += _section("settings" if len(schemes) == 1 else "settings of every scheme", facts, first, both)
    for scheme in schemes:
        own = [name for name in facts[scheme] if name not in both]
        if own:
            lines += _section(f"settings of scheme={scheme}", facts, scheme, own)
    for scheme, presets in facts.get("presets", {}).items():
        for name, settings in presets.items():
            chosen = ", ".join(f"{key}={short(value)}" for key, value in settings.items())
            lines += ["", f"  --preset {name} (scheme={scheme})", *_wrapped(chosen)]
    return lines


def _section(title: str, facts: Mapping[str, Any], scheme: str, names: Iterable[str]) -> list[str]:
    lines = ["", f"  {title}"]
    for name in names:
        about, value = facts["explained"][scheme][name], short(facts[scheme][name])
        head = f"    {name} = {value}"
        one_line = f"{head:<40} {about['values']}"
        lines += [one_line] if len(one_line) <= WIDTH else [head, *_wrapped(about["values"])]
        lines += _wrapped(about["meaning"])
    return lines


def _wrapped(text: str) -> list[str]:
    return wrap(text, WIDTH, initial_indent=" " * 8, subsequent_indent=" " * 8, break_on_hyphens=False)


def short(value: Any) -> str:
    """A value as it is written on the command line."""
    if isinstance(value, list | tuple):
        return ", ".join(map(str, value))
    if isinstance(value, bool):
        return "true" if value else "false"
    return "none" if value is None else f"{value:.10g}" if isinstance(value, float) else str(value)
