"""Steps of the incompressible scheme as flows grow, on one and on two threads, and beside another source tree.

    python benchmarks/incompressible_step.py [--beside CHECKOUT] [--runs N] [--sides N ...]

Milliseconds a step of the cavity at 50 to 400 particles a side, of the cavity with a cylinder and of the dam break, all
at Re = 1000, and bytes a particle of the largest cavity beyond those of one with 20 a side. Every run is a process of
its own that makes 20 steps first; the least of several runs counts. With --beside, a folder that has src/sphear, its
runs take turns with those of this tree, with compiled code in a folder of its own, and ratios are printed. Two threads
need two idle cores.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from _bench import Report

HERE = Path(__file__).parents[1]
SIDES = (50, 100, 200, 400)
OTHER_CASES = {"cavity-cylinder": (100, 200), "dam-break": (50, 100)}  # particles a side, and across the column
THREADS = (1, 2)
SMALL = 20  # particles a side of what is subtracted from the memory
PARTICLES = 400_000  # that a run moves by a step each, after its first steps; at least 10 steps
LEAST_STEPS, MOST_STEPS = 10, 100

Tree = Mapping[str, str]
"""The environment of a source tree's runs."""
Said = dict[str, Any]


def options(parser: argparse.ArgumentParser) -> None:
    """The options of this benchmark."""
    parser.add_argument("--beside", type=Path, metavar="CHECKOUT", help="a folder that has src/sphear")
    parser.add_argument("--runs", type=int, default=3, metavar="N", help="of which the least counts (3)")
    parser.add_argument("--sides", type=int, nargs="+", default=list(SIDES), metavar="N", help="of the cavity")
    parser.add_argument("--cavity-only", action="store_true", help="leave the other flows out")


def tree(root: Path, **more: str) -> Tree:
    """The environment in which Python imports the sphear of a source tree."""
    source = root.resolve() / "src"
    if not (source / "sphear").is_dir():
        raise SystemExit(f"{root} has no src/sphear: name the folder of a checkout")
    return {**os.environ, "PYTHONPATH": str(source), **more}


def steps_of(case: str, side: int) -> int:
    """The steps that a run is timed over."""
    particles = 2 * side**2 if case == "dam-break" else side**2
    return min(MOST_STEPS, max(LEAST_STEPS, PARTICLES // particles))


def run(where: Tree, case: str, side: int, threads: int, steps: int | None = None) -> Said:
    """One run in a process of its own."""
    script = str(Path(__file__).parent / "_incompressible_steps.py")
    arguments = (case, side, threads, steps_of(case, side) if steps is None else steps)
    command = [sys.executable, script, *map(str, arguments)]
    done = subprocess.run(command, env=where, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"{case} with {side} in {where['PYTHONPATH']} failed: {done.stderr.strip()[-1000:]}")
    said: Said = json.loads(done.stdout.splitlines()[-1])
    if Path(said["package"]).parent != Path(where["PYTHONPATH"]):
        raise SystemExit(f"the sphear of {said['package']} was imported and not that of {where['PYTHONPATH']}")
    return said


def least(trees: Mapping[str, Tree], case: str, side: int, threads: int, runs: int) -> dict[str, Said]:
    """Of each tree the run with the least time, the trees taken in turn."""
    best: dict[str, Said] = {}
    for _ in range(runs):
        for name, where in trees.items():
            said = run(where, case, side, threads)
            if name not in best or said["milliseconds"] < best[name]["milliseconds"]:
                best[name] = said
    return best


def measured(report: Report, trees: Mapping[str, Tree], case: str, side: int, runs: int) -> dict[int, dict[str, Said]]:
    """The least times of a flow on each number of threads, told with their ratios."""
    found = {threads: least(trees, case, side, threads, runs) for threads in THREADS}
    what = f"{case} {side} wide" if case == "dam-break" else f"{case} {side}x{side}"
    for name in trees:
        of = "" if len(trees) == 1 else f", {name}"
        for threads in THREADS:
            counted = f"{threads} thread{'s' if threads > 1 else ''}"
            report.add(f"{what}, a step on {counted}{of}", found[threads][name]["milliseconds"], "ms")
        one, two = (found[threads][name]["milliseconds"] for threads in THREADS)
        report.add(f"  speed on two threads over one{of}", one / two)
    if len(trees) == 2:
        for threads in THREADS:
            this, other = (said["milliseconds"] for said in found[threads].values())
            report.add(f"  time of this tree over the other's, {threads} thread{'s' * (threads > 1)}", this / other)
    return found


def memory(trees: Mapping[str, Tree], largest: dict[str, Said]) -> dict[str, float]:
    """Bytes a particle of the largest cavity of each tree, what a small one needs subtracted."""
    found = {}
    for name, where in trees.items():
        small, large = run(where, "cavity", SMALL, 1, steps=LEAST_STEPS), largest[name]
        found[name] = (large["memory"] - small["memory"]) / (large["particles"] - small["particles"])
    return found


def main() -> None:
    report = Report(__doc__ or "", options)
    chosen = report.options
    with tempfile.TemporaryDirectory() as cache:
        trees = {"this tree": tree(HERE)}
        if chosen.beside is not None:
            trees["the other"] = tree(chosen.beside, SPHEAR_CACHE_DIR=cache)
        cost, largest = {}, {}
        for side in sorted(chosen.sides):
            found = measured(report, trees, "cavity", side, chosen.runs)
            largest = found[1]
            own = largest["this tree"]
            cost[side] = 1e3 * own["milliseconds"] / own["particles"]
            report.add("  a particle and step on one thread", cost[side], "us")
        if len(cost) > 1:
            report.add(f"cost of a particle, most over {min(cost)} a side", max(cost.values()) / cost[min(cost)],
                       at_most=1.3)  # fmt: skip
        bytes_each = memory(trees, largest)
        for name, each in bytes_each.items():
            report.add(f"memory a particle, {max(cost)}x{max(cost)}, {name}", each, "bytes")
        if chosen.beside is not None:
            this, other = bytes_each.values()
            report.add("  memory of this tree over the other's", this / other)
        for case, sizes in {} if chosen.cavity_only else OTHER_CASES.items():
            for side in sizes:
                measured(report, trees, case, side, chosen.runs)
    report.close()


if __name__ == "__main__":
    main()
