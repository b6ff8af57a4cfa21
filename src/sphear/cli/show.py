"""`sphear show`: the card of one thing that has a name, or of a study or case."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import typer

from sphear.cli.catalogue import KINDS, described, kind_and_name
from sphear.cli.extension import EXTENSIONS
from sphear.cli.output import print_json, print_text


def show(
    kind: str = typer.Argument(..., metavar="KIND", help=f"{', '.join(KINDS[:-1])} or {KINDS[-1]}; may be left out."),
    name: list[str] = typer.Argument((), metavar="NAME", help="As `sphear list KIND` shows it, or an alias."),
    extensions: list[str] = EXTENSIONS,
    as_json: bool = typer.Option(False, "--json", help="Print JSON instead of text."),
) -> None:
    """Show formula, source and measured properties of one thing, or the settings of a case and what they mean."""
    facts = described(*kind_and_name([kind, *name]))
    if as_json:
        print_json(facts)
    elif facts["kind"] == "viscosity":
        from sphear.cli.catalogue import viscous_card

        print_text(viscous_card(facts["name"]).text())
    elif facts["kind"] == "cases":
        from sphear.cli.explained import case_lines

        print_text("\n".join(case_lines(facts)))
    else:
        print_text(_lines(facts))


def _lines(facts: Mapping[str, Any]) -> str:
    lines = [str(facts["name"])]
    for key, value in facts.items():
        if key in ("kind", "name") or value in ([], None):
            continue
        if isinstance(value, Mapping):
            lines += [f"  {key}", *(f"    {name:<12} {_short(item)}" for name, item in value.items())]
        else:
            lines.append(f"  {key:<12} {_short(value)}")
    return "\n".join(lines)


def _short(value: Any) -> str:
    if isinstance(value, list | tuple):
        return ", ".join(map(_short, value))
    return f"{value:.10g}" if isinstance(value, float) else str(value)
