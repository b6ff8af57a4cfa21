"""`sphear list`: the names of everything that can be chosen."""

from __future__ import annotations

import typer

from sphear.cli.catalogue import KINDS, entries, kind_of
from sphear.cli.extension import EXTENSIONS
from sphear.cli.output import print_json, print_tables


def list_names(
    kind: str | None = typer.Argument(None, metavar=f"[{'|'.join(KINDS)}]", help="Default: all."),
    extensions: list[str] = EXTENSIONS,
    as_json: bool = typer.Option(False, "--json", help="Print JSON instead of tables."),
) -> None:
    """List the names of everything that can be chosen, by kind."""
    kinds = KINDS if kind is None else (kind_of(kind),)
    found = {name: entries(name) for name in kinds}
    if as_json:
        print_json(found)
        return
    from sphear.results.table import Column, Table

    columns = (Column("name", "name"), Column("aliases", "also known as"), Column("summary", "what it is"))
    print_tables(
        [
            Table(name, columns, [{**entry, "aliases": ", ".join(entry["aliases"])} for entry in listed])
            for name, listed in found.items()
        ]
    )
