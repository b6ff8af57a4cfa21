"""Answers to malformed command lines and calls: 1,000 and 500 of them drawn at random, all wrong by construction.

    python validation/malformed.py [COMMANDS CALLS [SEED]]

Each is to be answered by one sentence within 20 s and 2 GB, with nothing printed or left beside it. Prints what was
not, and writes how many of each kind were to `validation/malformed.json`.
"""

from __future__ import annotations

import json
import sys
import tempfile
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from tests.fuzz.calls import calls  # noqa: E402 -- found by the path above
from tests.fuzz.commands import commands  # noqa: E402
from tests.fuzz.judged import fault_of_call, fault_of_command, in_folder  # noqa: E402


def main() -> None:
    """Draw, judge, say and write."""
    numbers = [int(text) for text in sys.argv[1:]] or [1000, 500]
    seed = numbers[2] if len(numbers) > 2 else 0
    right: dict[str, Counter[str]] = {"commands": Counter(), "calls": Counter()}
    wrong: dict[str, Counter[str]] = {"commands": Counter(), "calls": Counter()}
    with tempfile.TemporaryDirectory() as folder, in_folder(Path(folder)):
        for command in commands(numbers[0], seed):
            fault = fault_of_command(command)
            (wrong if fault else right)["commands"][command.kind] += 1
            if fault:
                print(f"{command.kind}: {[text[:60] for text in command.arguments]}: {fault}", flush=True)
    with tempfile.TemporaryDirectory() as folder, in_folder(Path(folder)):
        for call in calls(numbers[1], seed, Path(folder)):
            fault = fault_of_call(call)
            (wrong if fault else right)["calls"][call.kind] += 1
            if fault:
                print(f"{call.kind}: {call.words}: {fault}", flush=True)
    summary = {
        what: {
            "drawn": right[what].total() + wrong[what].total(),
            "answered by one sentence": dict(sorted(right[what].items())),
            "not": dict(sorted(wrong[what].items())),
        }
        for what in right
    }
    text = json.dumps({"seed": seed, **summary}, indent=1)
    print(text)
    (ROOT / "validation" / "malformed.json").write_text(text + "\n")


if __name__ == "__main__":
    main()
