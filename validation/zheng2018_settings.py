"""Search the settings that Zheng, Ma & Shao 2018 do not state, and keep the numbers in the package.

    python validation/zheng2018_settings.py [--workers N] [--only READING] [--at-most RESOLUTION] [--until TIME]
                                            [--missing] [--collect]

Runs come in the order of `tried`: all readings for a short time, then finer ones, then those to the paper's t = 40.
Each is written as it ends; one that is interrupted goes on where it was saved last. What was kept before stays where
nothing new was computed.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from sphear.errors import SphearError
from sphear.studies.kept import as_text
from sphear.studies.zheng2018.settings_rows import Search, identity, merged
from sphear.studies.zheng2018.settings_runs import tried

RESULT = Path(__file__).parent / "zheng2018" / "settings.json"


def main() -> None:
    """Compute and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--workers", type=int, default=1, help="processes")
    parser.add_argument("--only", metavar="READING", help="the name of one reading")
    parser.add_argument("--at-most", type=int, metavar="RESOLUTION", help="particles a side")
    parser.add_argument("--until", type=float, metavar="TIME", help="runs no longer than this")
    parser.add_argument("--missing", action="store_true", help="only those of which no numbers are written")
    parser.add_argument("--collect", action="store_true", help="write what was computed so far, and compute nothing")
    options = parser.parse_args()
    old = json.loads(RESULT.read_text(encoding="utf-8")) if RESULT.exists() else None
    known = {identity(row) for row in old["runs"]} if old and options.missing else set()
    search = Search(
        each
        for each in tried()
        if (options.only is None or each.reading == options.only)
        and (options.at_most is None or each.resolution <= options.at_most)
        and (options.until is None or each.until <= options.until)
        and tuple(each) not in known
    )

    def keep(text: str) -> None:
        print(text, flush=True)
        temporary = RESULT.with_suffix(".tmp")
        temporary.write_text(as_text(merged(old, search.kept())), encoding="utf-8")
        temporary.replace(RESULT)

    try:
        if not options.collect:
            search.compute(options.workers, keep)
    except KeyboardInterrupt:
        sys.exit("interrupted; what has ended is written, the same command goes on")
    except SphearError as error:
        sys.exit(str(error))
    keep("written")


if __name__ == "__main__":
    main()
