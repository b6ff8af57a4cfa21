"""What the benchmarks share: competitors timed in turn, and reports of what was measured, asked for, and on what."""

from __future__ import annotations

import argparse
import json
import os
import platform
import sys
import time
from collections.abc import Callable, Mapping
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]
Measurement = Callable[[], Mapping[str, float]]


# of the processor's time, so that other programs do not count; Windows knows it too coarsely
own_clock = time.perf_counter if sys.platform == "win32" else time.thread_time


def clocked(
    name: str, call: Callable[[], object], repeats: int = 1, clock: Callable[[], float] = own_clock
) -> Measurement:
    """A measurement: the least time of a few calls in a row, by name; calls on several threads need another clock."""

    def measure() -> dict[str, float]:
        least = float("inf")
        for _ in range(repeats):
            begin = clock()
            call()
            least = min(least, clock() - begin)
        return {name: least}

    return measure


def best_of(seconds: float, *measurements: Measurement) -> dict[str, float]:
    """The least of each measured time, with the measurements taken in turn, again and again.

    Processors change their speed and other programs get in the way: times are comparable only if taken side by side,
    and the least of many is the one that was disturbed least.
    """
    least: dict[str, float] = {}
    for measure in measurements:
        measure()  # compiles, fills caches
    until = time.perf_counter() + seconds
    while not least or time.perf_counter() < until:
        for measure in measurements:
            for name, taken in measure().items():
                least[name] = min(taken, least.get(name, taken))
    return least


def jittered_square(side: int, jitter: float = 0.3, dimension: int = 2) -> Array:
    """side^d particles of the unit square or cube, each moved by up to jitter / 2 spacings along each axis."""
    ticks = (np.arange(side) + 0.5) / side
    nodes = np.stack(np.meshgrid(*[ticks] * dimension), -1).reshape(-1, dimension)
    moved: Array = nodes + jitter / side * (np.random.default_rng(0).random(nodes.shape) - 0.5)
    return moved


def difference(a: Array, b: Array) -> float:
    """The largest difference of two arrays, relative to the largest number of the second."""
    return float(np.abs(a - b).max() / np.abs(b).max())


def machine() -> dict[str, str | int]:
    """The processor, how many of them, and the versions of everything that matters."""
    model = platform.processor() or platform.machine()
    if Path("/proc/cpuinfo").exists():
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        model = next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), model)
    facts: dict[str, str | int] = {
        "processor": model,
        "cores": os.cpu_count() or 1,
        "python": platform.python_version(),
    }
    return facts | {name: version(name) for name in ("numpy", "scipy", "numba", "llvmlite")}


class Report:
    """Prints what was measured as it comes; with `--json FILE` on the command line it also keeps it there.

    Args:
        title: what is measured, the docstring of the benchmark.
        more: adds options of its own to the command line; what was chosen is `options`.
    """

    def __init__(self, title: str, more: Callable[[argparse.ArgumentParser], object] = bool) -> None:
        parser = argparse.ArgumentParser(description=title, formatter_class=argparse.RawDescriptionHelpFormatter)
        parser.add_argument("--json", type=Path, metavar="FILE", help="write the numbers there too")
        more(parser)
        self.options = parser.parse_args()
        self.file: Path | None = self.options.json
        self.results: list[dict[str, Any]] = []
        self.machine = machine()
        print(title.splitlines()[0], "; ".join(f"{name} {value}" for name, value in self.machine.items()), sep="\n")

    def add(
        self, what: str, value: float, unit: str = "", *, at_least: float | None = None, at_most: float | None = None
    ) -> None:
        """One number, and what is asked of it."""
        asked = ""
        if at_least is not None:
            asked = f"asked: at least {at_least:g}{'' if value >= at_least else ', MISSED'}"
        if at_most is not None:
            asked = f"asked: at most {at_most:g}{'' if value <= at_most else ', MISSED'}"
        print(f"  {what:<62}{value:9.3g} {unit:<10}{asked}".rstrip(), flush=True)
        row = {"what": what, "value": value, "unit": unit, "at_least": at_least, "at_most": at_most}
        self.results.append({key: entry for key, entry in row.items() if entry not in ("", None)})

    def say(self, sentence: str) -> None:
        """A sentence among the numbers."""
        print(f"  {sentence}", flush=True)

    def close(self) -> None:
        """Write the file, if one is wanted."""
        if self.file:
            content = {"benchmark": Path(sys.argv[0]).stem, "machine": self.machine, "results": self.results}
            self.file.write_text(json.dumps(content, indent=1) + "\n")
