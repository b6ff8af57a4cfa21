"""Compute the long items of Basa, Quinlan & Lastiwka 2009 and keep their numbers in the package.

    python validation/basa2009.py [--workers N] [ITEM]...

Each run is kept as it ends, and an interrupted computation goes on where it stopped.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from sphear.studies import ITEMS, is_long, kept_as, study_of
from sphear.studies.kept import as_text

RESULTS = Path(__file__).parent / "basa2009"


def main() -> None:
    """Compute and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("items", nargs="*", choices=[[], *ITEMS["basa2009"]])
    parser.add_argument("--workers", type=int, default=1)
    chosen = parser.parse_args()
    for item in chosen.items or ITEMS["basa2009"]:
        study = study_of("basa2009", item)
        if is_long(study) and kept_as(study, item) == item:
            data = study.compute(quick=False, workers=chosen.workers, progress=print)
            (RESULTS / f"{item}.json").write_text(as_text(data), encoding="utf-8")


if __name__ == "__main__":
    main()
