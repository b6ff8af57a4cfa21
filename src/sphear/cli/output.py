"""Output of a command: tables or JSON on stdout, progress on a terminal's stderr, files in a folder."""

from __future__ import annotations

import json
import os
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, TextIO

from sphear.environment import seconds
from sphear.errors import SphearError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from sphear.results import OutputFolder, Table

FIRST_LINE = "SPHEAR_PROGRESS_SECONDS"
USUAL, LONGEST = 10.0, 600.0  # seconds before the first line of a log file, and between two


def print_json(value: Any) -> None:
    """The value as JSON on stdout; numbers that are not finite, which JSON does not know, as null."""
    from sphear.results.finite import finite

    print(json.dumps(finite(value), indent=2, allow_nan=False))


def print_sentence(text: str) -> None:
    """Print a sentence beside results, on stderr, on one line."""
    print(f"sphear: {' '.join(text.split())}", file=sys.stderr)


def is_terminal(stream: TextIO | None) -> bool:
    """True if someone is watching; a closed stream is None."""
    return stream is not None and stream.isatty()


def print_tables(tables: Sequence[Table]) -> None:
    """The tables on stdout, as wide as the terminal or `$COLUMNS`; where neither is known, as wide as they are."""
    from rich.console import Console

    known = is_terminal(sys.stdout) or os.environ.get("COLUMNS", "").isdigit()
    console = Console(width=None if known else 200, highlight=False)
    for table in tables:
        console.print(table.render())


def print_text(text: str) -> None:
    """Text on stdout, wrapped to a terminal's width."""
    from rich.console import Console

    Console(highlight=False, markup=False, emoji=False).print(text, soft_wrap=not is_terminal(sys.stdout))


@contextmanager
def progress(what: str) -> Iterator[Callable[[str], None]]:
    """A line on stderr that says what is being done, and where it stands; in a log file now and then."""
    if not is_terminal(sys.stderr):
        yield now_and_then(what, sys.stderr)
        return
    from rich.console import Console

    status = Console(stderr=True).status(what)
    with suppress(OSError):  # a terminal may be closed meanwhile
        status.start()
    try:
        yield lambda text: status.update(f"{what}: {text}")
    finally:
        with suppress(OSError):
            status.stop()


def now_and_then(what: str, stream: TextIO | None) -> Callable[[str], None]:
    """A writer of lines for a log file: the first after 10 s, then each time that took twice as long, or 10 minutes.

    Args:
        what: is being done.
        stream: None where there is none.

    Raises:
        SphearError: `$SPHEAR_PROGRESS_SECONDS`, the time of the first line (0 for none at all), is no number.
    """
    first = seconds(FIRST_LINE, USUAL)
    began = last = time.monotonic()

    def tell(text: str) -> None:
        nonlocal last
        now = time.monotonic()
        if stream is None or not first or now - last < min(max(first, last - began), LONGEST):
            return
        last = now
        with suppress(OSError):
            print(f"{what}: {text}", file=stream, flush=True)

    return tell


def folder(out: str | None) -> OutputFolder | None:
    """The output folder, refused at once if it cannot be written; None where no files are wanted."""
    if out is None:
        return None
    if not out.strip():
        raise SphearError("the output folder needs a name")
    from sphear.results import OutputFolder

    return OutputFolder(out)


def write(
    out: OutputFolder, name: str, result: Any, tables: Sequence[Table], figures: Mapping[str, Callable[[], Figure]]
) -> None:
    """The numbers as JSON, the tables as CSV, the figures as PNG and SVG."""
    from sphear.results.finite import finite

    out.write_text(f"{name}.json", json.dumps(finite(result), indent=2, ensure_ascii=False) + "\n")
    for number, table in enumerate(tables):
        out.write_table(name if number == 0 else f"{name}-{number + 1}", table)
    for figure, draw in figures.items():
        out.write_figure(figure, draw())


def print_files(out: OutputFolder) -> None:
    """Print where the files are."""
    print_text("written: " + ", ".join(str(path) for path in out.files))
