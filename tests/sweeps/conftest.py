"""Sweeps of runs that only pretend."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from sphear.sweeps import Run, Store, SweepResult, plan, run_sweep

SCRIPTED = "sweep_functions:scripted"


@pytest.fixture
def calls(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[], list[int]]:
    """The resolutions that workers were called with so far."""
    file = tmp_path / "calls"
    monkeypatch.syspath_prepend(Path(__file__).parent)
    monkeypatch.setenv("SWEEP_CALLS", str(file))
    return lambda: [int(line.split()[0]) for line in file.read_text().splitlines()] if file.exists() else []


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / "store")


@pytest.fixture
def sweep(calls: Any, store: Store) -> Callable[..., list[SweepResult]]:
    """A sweep of these resolutions by the scripted function."""

    def swept(resolutions: list[int], **options: Any) -> list[SweepResult]:
        return run_sweep(runs(resolutions), store, **{"compute": SCRIPTED, **options})

    return swept


def runs(resolutions: list[int]) -> list[Run]:
    """Runs of these resolutions."""
    return plan("poiseuille", {"resolution": resolutions}, {"until": 0.05}, preset="basa2009")
