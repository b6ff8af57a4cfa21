"""Kill runs at random moments, go on with them, and compare the end with that of the unbroken run, bit for bit.

    python validation/kills.py --kills 50 --signals 20

A kill (SIGKILL, which no process can catch) comes at a random moment of run, saving and writing of results, again and
again until the run has ended, half of them before results are written; the state is saved at each output. Signals
(SIGTERM, SIGHUP, Ctrl-C once, Ctrl-C twice) come while the flow is computed, while it is compiled and while results are
written; then the state must be that of the moment, the exit status 128 and the signal, and the end that of the unbroken
run. Each run is a child of this process with the compiled code in it, so that two of them cannot round differently;
while compiling, it is a process of its own. Writes `kills.json`.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

SMALL = ("--set", "threads=1")
PAPER = ("--preset", "basa2009", *SMALL)
SCHEMES = {
    "explicit": ("poiseuille", "--resolution", "10", "--until", "3", *PAPER),
    "kick-drift-kick": (
        "poiseuille", "--resolution", "10", "--until", "3", "--set", "integrator=kick_drift_kick", *PAPER,
    ),
    "gas": (
        "poiseuille", "--resolution", "10", "--until", "3", "--set", "equation_of_state=ideal_gas",
        "--set", "density=continuity", *PAPER,
    ),
    "incompressible": (
        "cavity", "--scheme", "incompressible", "--resolution", "12", "--until", "1", *SMALL,
    ),
    "dam break": ("dam-break", "--resolution", "8", "--until", "0.5", *SMALL),
}  # fmt: skip
SIGNALS = {
    "SIGTERM": (signal.SIGTERM,),
    "SIGHUP": (signal.SIGHUP,),
    "Ctrl-C once": (signal.SIGINT,),
    "Ctrl-C twice": (signal.SIGINT, signal.SIGINT),
}


def quiet_main(arguments: tuple[str, ...], said: Path) -> None:
    """The command line in this process, which is a child; what it says goes to a file."""
    from sphear.cli import main

    with said.open("w") as file:
        for stream in (1, 2):
            os.dup2(file.fileno(), stream)
        sys.argv = ["sphear", *arguments]
        main()


def start(arguments: tuple[str, ...], said: Path) -> int:
    """A child that runs a command; its process."""
    sys.stdout.flush()
    child = os.fork()
    if child:
        return child
    status = 1
    try:
        for each in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):  # as a shell starts it
            signal.signal(each, signal.default_int_handler if each == signal.SIGINT else signal.SIG_DFL)
        quiet_main(arguments, said)
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else 0
    finally:
        os._exit(status)


def ended(child: int) -> int:
    """Wait for a child; its exit status, negative of a signal."""
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def results(folder: Path) -> dict[str, Any]:
    """All that must be equal: history, metrics, profiles, tables and the last state."""
    import numpy as np

    from sphear.simulation.saved import read

    (state,) = folder.glob("*-state.npz")
    case = state.name.removesuffix("-state.npz")
    found: dict[str, Any] = json.loads((folder / f"{case}.json").read_text(encoding="utf-8"))
    found.pop("performance")
    found["tables"] = [path.read_text() for path in sorted(folder.glob("*.csv"))]
    found["state"] = {name: np.asarray(values).tobytes() for name, values in sorted(read(state)[1].items())}
    found["files"] = sorted(path.name for path in folder.iterdir())
    return found


def command(scheme: str, folder: Path, *, resume: bool) -> tuple[str, ...]:
    return ("run", *SCHEMES[scheme], "--json", "--out", str(folder), *(("--resume",) if resume else ()))


def kills(scheme: str, wanted: int, place: Path, chance: random.Random) -> dict[str, Any]:
    """Kill runs at random moments, so often, each gone on with to its end."""
    whole = place / "whole"
    began = time.monotonic()
    child, computing = start(command(scheme, whole, resume=False), place / "said"), 0.0
    while os.waitpid(child, os.WNOHANG) == (0, 0):
        if not any(whole.glob("*.json")):
            computing = time.monotonic() - began
        time.sleep(0.001)
    length, right = time.monotonic() - began, results(whole)
    made = runs = equal = damaged = early = while_writing = 0
    while made < wanted:
        folder, finished, runs = place / f"run-{runs}", False, runs + 1
        while not finished:
            resume = any(folder.glob("*-state*.npz"))
            child = start(command(scheme, folder, resume=resume), place / "said")
            if made < wanted:
                time.sleep(chance.uniform(0.0, chance.choice((computing, 1.1 * length))))
                with suppress(ProcessLookupError):
                    os.kill(child, signal.SIGKILL)
            status = ended(child)
            if status == -signal.SIGKILL:
                made += 1
                state = any(folder.glob("*-state.npz"))
                early += not state
                while_writing += any(folder.glob("*.json"))
                damaged += state and not readable(folder)
            else:
                finished = status == 0
                if not finished:
                    raise SystemExit(f"{scheme}: status {status}: {(place / 'said').read_text()}")
        equal += results(folder) == right
        shutil.rmtree(folder)
    return {
        "kills": made, "before the first saving": early, "while results are written": while_writing,
        "damaged states": damaged, "runs": runs, "equal to the unbroken run": equal,
    }  # fmt: skip


def readable(folder: Path) -> bool:
    from sphear.errors import SphearError
    from sphear.simulation.saved import read

    (state,) = folder.glob("*-state.npz")
    try:
        read(state)
    except SphearError:
        return False
    return True


def sending(child: int, numbers: tuple[signal.Signals, ...], chance: random.Random) -> None:
    for number in numbers:
        with suppress(ProcessLookupError):
            os.kill(child, number)
        time.sleep(chance.uniform(0.0, 0.1))


def heard(scheme: str, name: str, pattern: str, wanted: int, place: Path, chance: random.Random) -> dict[str, int]:
    """Send signals when a folder has such a file, so often; whether the state of the moment was kept."""
    whole = place / "whole"
    if not whole.exists():
        assert ended(start(command(scheme, whole, resume=False), place / "said")) == 0
    right, kept = results(whole), 0
    for number in range(wanted):
        folder = place / f"signal-{number}"
        child = start(command(scheme, folder, resume=False), place / "said")
        while not any(folder.glob(pattern)) and os.waitpid(child, os.WNOHANG) == (0, 0):
            time.sleep(0.001)
        time.sleep(chance.uniform(0.0, 0.05))
        sending(child, SIGNALS[name], chance)
        status, said = ended(child), (place / "said").read_text()
        well = status == 128 + SIGNALS[name][0] and ("--resume" in said or "all results" in said) and readable(folder)
        if well and "all results" not in said:
            well = ended(start(command(scheme, folder, resume=True), place / "said")) == 0
        kept += well and results(folder) == right
        shutil.rmtree(folder)
    return {"signals": wanted, "kept": kept}


def compiling(name: str, wanted: int, place: Path, chance: random.Random) -> dict[str, int]:
    """Send signals to processes that compile: the state at the start is kept, in one sentence."""
    kept, children = 0, []
    for number in range(wanted):  # at the same time: it takes long
        folder, cache = place / f"compiling-{number}", place / f"cache-{number}"
        environment = {**os.environ, "SPHEAR_CACHE_DIR": str(cache)}
        arguments = [sys.executable, "-m", "sphear", *command("explicit", folder, resume=False)]
        child = subprocess.Popen(arguments, env=environment, stderr=subprocess.PIPE, text=True)
        children.append((child, folder, cache))
    for child, folder, _ in children:
        while not folder.exists() and child.poll() is None:  # which is made when compiling begins
            time.sleep(0.005)
        time.sleep(chance.uniform(0.0, 3.0))
        sending(child.pid, SIGNALS[name], chance)
    for child, folder, cache in children:
        _, said = child.communicate()
        kept += (
            child.returncode == 128 + SIGNALS[name][0]
            and said.startswith("sphear: interrupted at ")
            and said.count("\n") == 1
            and readable(folder)
        )
        shutil.rmtree(folder, ignore_errors=True)
        shutil.rmtree(cache, ignore_errors=True)
    return {"signals": wanted, "kept": kept}


def main() -> None:
    """Make the kills and signals and write what was found."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--kills", type=int, default=50, help="of each scheme")
    parser.add_argument("--signals", type=int, default=20, help="of each kind, at each moment")
    parser.add_argument("--compiling", type=int, default=5, help="of each kind, while compiling")
    parser.add_argument("--scheme", action="append", choices=SCHEMES, help="to be killed; all if not given")
    parser.add_argument("--file", type=Path, default=Path(__file__).with_suffix(".json"), help="of results")
    options = parser.parse_args()
    os.environ |= {"SPHEAR_SAVE_SECONDS": "0", "SPHEAR_PROGRESS_SECONDS": "0"}
    for each in (signal.SIGINT, signal.SIGHUP, signal.SIGTERM):  # children must not inherit that one is ignored
        signal.signal(each, signal.default_int_handler if each == signal.SIGINT else signal.SIG_DFL)
    chance = random.Random(2026)
    with tempfile.TemporaryDirectory() as scratch:
        place = Path(scratch)
        for scheme in options.scheme or SCHEMES if options.kills else ():
            here = place / scheme.replace(" ", "-")
            here.mkdir()
            warm(scheme)  # compiles and imports all that children need
            keep(options.file, "kills", scheme, kills(scheme, options.kills, here, chance))
        here = place / "signals"
        here.mkdir()
        if options.signals:
            warm("explicit")
        for name in SIGNALS if options.signals else ():
            for moment, pattern in (("computing", "*-state.npz"), ("writing", "*.json")):
                found = heard("explicit", name, pattern, options.signals, here, chance)
                keep(options.file, "signals", f"{name}, {moment}", found)
        for name in SIGNALS if options.compiling else ():
            keep(options.file, "signals", f"{name}, compiling", compiling(name, options.compiling, here, chance))


def keep(target: Path, kind: str, name: str, found: dict[str, int]) -> None:
    """Put what was found beside what is in the file already."""
    print(name, found, flush=True)
    before = json.loads(target.read_text(encoding="utf-8")) if target.exists() else {"kills": {}, "signals": {}}
    before[kind][name] = found
    target.write_text(json.dumps(before, indent=1) + "\n", encoding="utf-8")


def warm(scheme: str) -> None:
    """Make a run's code and imports part of this process."""
    from sphear.cli.app import app

    with tempfile.TemporaryDirectory() as folder, open(os.devnull, "w") as nowhere:  # noqa: PTH123
        saved, sys.stdout = sys.stdout, nowhere
        try:
            app(["run", *SCHEMES[scheme], "--json", "--out", folder], standalone_mode=False)
        finally:
            sys.stdout = saved


if __name__ == "__main__":
    main()
