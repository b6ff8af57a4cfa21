"""Compute the cavities of Zheng, Ma & Shao 2018 (figures 7 to 14) and keep their numbers in the package.

    python validation/zheng2018.py [--workers N] [--at-most RESOLUTION] [--terms TERM,TERM...] [--missing] [--collect]
                                    [ITEM]...

Short runs come first. Each is written as it ends; one that is interrupted goes on where it was saved last, within a
minute of where it stood. What was kept before stays where nothing new was computed.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from _keeping import keep_as_they_end, parser, written

from sphear.studies.zheng2018.cavities import CASES, TERMS, Study, Wanted, selected
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


def _missing(runs: list[Wanted], cases: list[str]) -> Iterator[Wanted]:
    """Those of which no numbers are written."""
    known = set()
    for case in cases:
        whole = merged(case, written(RESULTS / f"{case}.json"), data_of(case, {}))
        known |= {(case, *identity(row)) for row in whole["runs"]}
    return (each for each in runs if (each.case, *identity(each._asdict())) not in known)


def main() -> None:
    """Compute and write."""
    asked = parser(__doc__)
    asked.add_argument("items", nargs="*", metavar="ITEM", type=_item, help="such as figure-10")
    asked.add_argument("--terms", type=_terms, metavar="TERM,TERM...", help=f"some of {', '.join(TERMS)}")
    options = asked.parse_args()
    cases = list(dict.fromkeys(ITEMS[item] for item in options.items or ITEMS))
    runs = selected(cases, options.at_most, options.terms)
    study = Study(_missing(runs, cases) if options.missing else runs)

    def numbers() -> dict[Path, dict[str, Any]]:
        found, kept = study.kept(), {}
        for case in cases:
            path = RESULTS / f"{case}.json"
            new = data_of(case, {each: result for each, result in found.items() if each.case == case})
            kept[path] = merged(case, written(path), new)
        return kept

    keep_as_they_end(options, study.compute, numbers)


if __name__ == "__main__":
    main()
