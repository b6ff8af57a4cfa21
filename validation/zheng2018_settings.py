"""Search the settings that Zheng, Ma & Shao 2018 do not state, and keep the numbers in the package.

    python validation/zheng2018_settings.py [--workers N] [--only READING] [--at-most RESOLUTION] [--until TIME]
                                            [--missing] [--collect]

Runs come in the order of `tried`: all readings for a short time, then finer ones, then those to the paper's t = 40.
Each is written as it ends; one that is interrupted goes on where it was saved last. What was kept before stays where
nothing new was computed.
"""

from __future__ import annotations

from pathlib import Path

from _keeping import keep_as_they_end, parser, written

from sphear.studies.zheng2018.settings_rows import Search, identity, merged
from sphear.studies.zheng2018.settings_runs import tried

RESULT = Path(__file__).parent / "zheng2018" / "settings.json"


def main() -> None:
    """Compute and write."""
    asked = parser(__doc__)
    asked.add_argument("--only", metavar="READING", help="the name of one reading")
    asked.add_argument("--until", type=float, metavar="TIME", help="runs no longer than this")
    options = asked.parse_args()
    old = written(RESULT)
    known = {identity(row) for row in old["runs"]} if old and options.missing else set()
    search = Search(
        each
        for each in tried()
        if (options.only is None or each.reading == options.only)
        and (options.at_most is None or each.resolution <= options.at_most)
        and (options.until is None or each.until <= options.until)
        and tuple(each) not in known
    )
    keep_as_they_end(options, search.compute, lambda: {RESULT: merged(old, search.kept())})


if __name__ == "__main__":
    main()
