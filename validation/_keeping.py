"""Long runs that are kept in the package as they end: their options, and the files that they are written to."""

from __future__ import annotations

import json
import sys
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from sphear.errors import SphearError
from sphear.studies.kept import as_text
from sphear.whole import whole

Numbers = dict[str, Any]


def parser(about: str | None) -> ArgumentParser:
    """The options that such scripts have in common."""
    made = ArgumentParser(description=about, formatter_class=RawDescriptionHelpFormatter)
    made.add_argument("--workers", type=int, default=1, help="processes")
    made.add_argument("--at-most", type=int, metavar="RESOLUTION", help="particles a side")
    made.add_argument("--missing", action="store_true", help="only those of which no numbers are written")
    made.add_argument("--collect", action="store_true", help="write what was computed so far, and compute nothing")
    return made


def written(path: Path) -> Numbers | None:
    """The numbers in a file; None where there is none."""
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None


def keep_as_they_end(
    options: Namespace,
    compute: Callable[[int, Callable[[str], None]], object],
    numbers: Callable[[], Mapping[Path, Numbers]],
) -> None:
    """Compute, and write after each run all that there is.

    Args:
        options: of the `parser`.
        compute: all runs, of so many processes and something that is told where they stand.
        numbers: what is to be kept so far, by the file it is written to.
    """

    def keep(text: str) -> None:
        print(text, flush=True)
        for path, data in numbers().items():
            with whole(path) as partial:
                partial.write_text(as_text(data), encoding="utf-8")

    try:
        if not options.collect:
            compute(options.workers, keep)
    except KeyboardInterrupt:
        sys.exit("interrupted; what has ended is written, the same command goes on")
    except SphearError as error:
        sys.exit(str(error))
    keep("written")
