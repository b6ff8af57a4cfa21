"""How long a user waits for the command line: `list`, and `reproduce` once its sweeps are in the cache.

Wall time of whole processes, started in turn, beside the time of importing NumPy alone; best and median of several.
"""

from __future__ import annotations

import statistics
import subprocess
import sys
import time

from _bench import Report

ROUNDS = 7
COMMANDS = {
    "import numpy": ["-c", "import numpy"],
    "sphear list": ["-m", "sphear", "list"],
    "sphear reproduce zheng2018 table-1": ["-m", "sphear", "reproduce", "zheng2018", "table-1"],
}
ASKED = {"sphear list": 0.5, "sphear reproduce zheng2018 table-1": 3.0}


def wait(arguments: list[str]) -> float:
    """Seconds."""
    begin = time.perf_counter()
    subprocess.run([sys.executable, *arguments], check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - begin


def main() -> None:
    report = Report(__doc__ or "")
    times: dict[str, list[float]] = {name: [] for name in COMMANDS}
    for arguments in COMMANDS.values():
        wait(arguments)  # fills the cache
    for _ in range(ROUNDS):
        for name, arguments in COMMANDS.items():
            times[name].append(wait(arguments))
    for name, taken in times.items():
        report.add(f"{name}, best", min(taken), "s", at_most=ASKED.get(name))
        report.add(f"{name}, median", statistics.median(taken), "s", at_most=ASKED.get(name))
        if name in ASKED:
            report.add(f"{name} / import numpy", min(taken) / min(times["import numpy"]))
    report.close()


if __name__ == "__main__":
    main()
