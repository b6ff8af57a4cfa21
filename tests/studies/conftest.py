"""Where the runs of studies are kept while they are tested."""

from __future__ import annotations

from pathlib import Path

import pytest


@pytest.fixture
def own_store(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """Runs are kept here and not in the user's folder."""
    monkeypatch.setenv("SPHEAR_RUNS_DIR", str(tmp_path))
    return tmp_path
