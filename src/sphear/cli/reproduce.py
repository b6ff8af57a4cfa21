"""`sphear reproduce`: tables and figures of a paper, computed again."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import typer

from sphear.cli.output import (
    folder,
    print_files,
    print_json,
    print_sentence,
    print_tables,
    print_text,
    progress,
    write,
)
from sphear.errors import Interrupted, SphearError


def reproduce(
    paper: str = typer.Argument(..., metavar="PAPER", help="zheng2018 or basa2009."),
    item: list[str] | None = typer.Argument(None, metavar="[ITEM]...", help="Such as table-1; default: all."),
    quick: bool = typer.Option(False, "--quick", help="Fewer seeds and repetitions where an item is long."),
    rerun: bool = typer.Option(False, "--rerun", help="Compute long items too, instead of drawing what is kept."),
    workers: int = typer.Option(1, help="Processes for the runs of long items."),
    as_json: bool = typer.Option(False, "--json", help="Print JSON: one object for one item, a list for several."),
    out: str | None = typer.Option(None, metavar="DIR", help="Write figures, tables and JSON to this folder."),
) -> None:
    """Compute tables and figures of a paper again and say whether its findings hold."""
    from sphear import studies

    wanted = studies.items(paper, item or [])
    if workers < 1:
        raise SphearError(f"workers must be at least 1, not {workers}")
    files = folder(out)
    results = []
    shown: set[str] = set()  # a figure drawn from a table that was just printed does not print it again
    for name in wanted:
        with progress(f"{paper} {name}") as tell, _sentences():
            try:
                result = studies.reproduce(paper, name, quick=quick, rerun=rerun, workers=workers, progress=tell)
            except KeyboardInterrupt:
                raise Interrupted("interrupted; runs that have ended are kept, the same command goes on") from None
            results.append(result.as_dict(paper, name))
            if files is not None:
                figures = {f"{paper}-{figure}": draw for figure, draw in result.figures.items()}
                write(files, f"{paper}-{name}", results[-1], result.tables, figures)
        if not as_json:
            print_tables([table for table in result.tables if table.title not in shown])
            shown.update(table.title for table in result.tables)
            said = f"  The paper: {result.claim}.\n  Found: {result.finding}.\n  Agrees: {result.agrees}.\n"
            print_text(f"{paper} {name}\n{said}")
    if as_json:
        print_json(results[0] if len(results) == 1 else results)
    elif files is not None:
        print_files(files)


@contextmanager
def _sentences() -> Iterator[None]:
    """Say what sweeps warn of as the command line says things."""
    from sphear.sweeps import SweepWarning

    usual = warnings.showwarning

    def show(message: Warning | str, category: type[Warning], *where: Any, **more: Any) -> None:
        if issubclass(category, SweepWarning):
            print_sentence(str(message))
        else:
            usual(message, category, *where, **more)

    with warnings.catch_warnings():
        warnings.simplefilter("always", SweepWarning)
        warnings.showwarning = show
        yield
