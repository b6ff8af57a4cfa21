"""Compute the cavities of Zheng, Ma & Shao 2018 (figures 7 to 14) and keep their numbers in the package.

    python validation/zheng2018.py [--workers N] [--at-most RESOLUTION] [--terms TERM,TERM...] [--missing] [--collect]
                                    [ITEM]...

Short runs come first. Each is written as it ends; one that is interrupted goes on where it was saved last, within a
minute of where it stood. What was kept before stays where nothing new was computed.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from sphear.errors import SphearError
from sphear.studies.kept import as_text
from sphear.studies.zheng2018.cavities import CASES, TERMS, Study, Wanted, chosen
from sphear.studies.zheng2018.cavity_rows import data_of, identity, merged

RESULTS = Path(__file__).parent / "zheng2018"
ITEMS = {f"figure-{number}": CASES[number > 10] for number in range(7, 15)}


def _terms(text: str) -> tuple[str, ...]:
    names = tuple(text.split(","))
    if unknown := set(names) - set(TERMS):
        raise argparse.ArgumentTypeError(f"no term named {', '.join(sorted(unknown))}")
    return names


def _item(text: str) -> str:
    if text not in ITEMS:
        raise argparse.ArgumentTypeError(f"choose from {', '.join(ITEMS)}, not {text!r}")
    return text


def _written(case: str) -> dict[str, Any] | None:
    path = RESULTS / f"{case}.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None


def _missing(runs: list[Wanted], cases: list[str]) -> Iterator[Wanted]:
    """Those of which no numbers are written."""
    known = set()
    for case in cases:
        whole = merged(case, _written(case), data_of(case, {}))
        known |= {(case, *identity(row)) for row in whole["runs"]}
    return (each for each in runs if (each.case, *identity(each._asdict())) not in known)


def main() -> None:
    """Compute and write."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("items", nargs="*", metavar="ITEM", type=_item, help="such as figure-10")
    parser.add_argument("--workers", type=int, default=1, help="processes")
    parser.add_argument("--at-most", type=int, metavar="RESOLUTION", help="particles a side")
    parser.add_argument("--terms", type=_terms, metavar="TERM,TERM...", help=f"some of {', '.join(TERMS)}")
    parser.add_argument("--missing", action="store_true", help="only those of which no numbers are written")
    parser.add_argument("--collect", action="store_true", help="write what was computed so far, and compute nothing")
    options = parser.parse_args()
    cases = list(dict.fromkeys(ITEMS[item] for item in options.items or ITEMS))
    runs = chosen(cases, options.at_most, options.terms)
    study = Study(_missing(runs, cases) if options.missing else runs)

    def keep(text: str) -> None:
        print(text, flush=True)
        found = study.kept()
        for case in cases:
            new = data_of(case, {each: result for each, result in found.items() if each.case == case})
            temporary = RESULTS / f"{case}.tmp"
            temporary.write_text(as_text(merged(case, _written(case), new)), encoding="utf-8")
            temporary.replace(temporary.with_suffix(".json"))

    try:
        if not options.collect:
            study.compute(options.workers, keep)
    except KeyboardInterrupt:
        sys.exit("interrupted; what has ended is written, the same command goes on")
    except SphearError as error:
        sys.exit(str(error))
    keep("written")


if __name__ == "__main__":
    main()
