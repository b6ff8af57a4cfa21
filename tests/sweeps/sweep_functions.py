"""What workers call in tests instead of a flow; `resolution` says what happens."""

from __future__ import annotations

import multiprocessing
import os
import signal
import time
from pathlib import Path
from typing import Any

KILLS, RAISES, FAILS, ENDS, SLEEPS = 66, 67, 68, 69, 70


def scripted(case: str, settings: dict[str, Any]) -> dict[str, Any]:
    """A made-up result that says who computed it; each call leaves a line in the file $SWEEP_CALLS, if there is one."""
    resolution = settings["resolution"]
    if calls := os.environ.get("SWEEP_CALLS"):
        with Path(calls).open("a") as file:
            file.write(f"{resolution} {os.getpid()}\n")
    if resolution == KILLS:
        os.kill(os.getpid(), signal.SIGKILL)
    if resolution == RAISES:
        raise ZeroDivisionError("there is\nnothing to divide by")
    if resolution == ENDS:
        os._exit(3)
    if resolution == SLEEPS:
        time.sleep(600)
    end = "failed: it broke down" if resolution == FAILS else "time"
    time.sleep(0.05)
    threads = os.environ.get("NUMBA_NUM_THREADS")
    return {
        "case": case,
        "settings": settings,
        "metrics": {"time": float("nan"), "l2_error": 1 / resolution, "end": end},
        "performance": {"pid": os.getpid(), "threads": threads, "main": multiprocessing.parent_process() is None},
        "end": end,
        "history": [],
    }


def nonsense(case: str, settings: dict[str, Any]) -> dict[str, Any]:
    """Something that is no result."""
    return {"case": case}
