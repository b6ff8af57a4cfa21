"""Runs of the incompressible scheme one by one: planned, on one thread, and gone on with where they were saved."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sphear.errors import SphearError

if TYPE_CHECKING:
    from sphear.cases.flow import CaseRun
    from sphear.schemes.base import Settings
    from sphear.sweeps import Run


def planned(case: str, settings: dict[str, Any], preset: str | None) -> Run:
    """A run of a case, its settings checked."""
    from sphear.sweeps import plan

    return plan(case, {}, {"scheme": "incompressible", **settings}, preset=preset)[0]


def on_one_thread(case: str, settings: dict[str, Any]) -> Settings:
    """The settings of a run, with one thread where nothing is said: runs share the processors."""
    from sphear.cases.flow import FLOWS

    if settings.get("threads", 1) is None:
        settings = {**settings, "threads": 1}
    return FLOWS[case].settings(**settings)


def gone_on_with(start: Callable[[], CaseRun], saved: Path) -> CaseRun:
    """A run as it was saved last; at its start where nothing is saved, or what is saved cannot be gone on with.

    Args:
        start: makes the run.
        saved: the file.
    """
    from sphear.simulation.saved import recover

    recover(saved)
    run = start()
    if saved.exists():
        try:
            run.restore(saved)
        except SphearError:  # of other settings, or further on
            run = start()
    return run
