"""Compute the long items of Basa, Quinlan & Lastiwka 2009 and keep their numbers in the package.

    python validation/basa2009.py [--workers N] [ITEM]...

Each run is kept as it ends, and an interrupted computation goes on where it stopped.
"""

from __future__ import annotations

import argparse
from importlib import import_module
from pathlib import Path

from sphear.studies import ITEMS
from sphear.studies.kept import as_text

RESULTS = Path(__file__).parent / "basa2009"


def main() -> None:
    """Compute and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("items", nargs="*", choices=[[], *ITEMS["basa2009"]])
    parser.add_argument("--workers", type=int, default=1)
    chosen = parser.parse_args()
    for item in chosen.items or ITEMS["basa2009"]:
        module = import_module(f"sphear.studies.basa2009.{item.replace('-', '_')}")
        if hasattr(module, "compute") and not hasattr(module, "KEPT"):
            data = module.compute(quick=False, workers=chosen.workers, progress=print)
            (RESULTS / f"{item}.json").write_text(as_text(data), encoding="utf-8")


if __name__ == "__main__":
    main()
