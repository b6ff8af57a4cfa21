"""Ctrl-C at an output of a run."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from sphear.cases.flow import CaseRun
from sphear.cases.flow.history import CaseHistory


@contextmanager
def interrupted_at(output: int, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Have Ctrl-C come when a run has made so many outputs."""
    watch = CaseHistory.watch

    def watched(history: CaseHistory, run: CaseRun) -> None:
        watch(history, run)
        if len(run.history) == output:
            raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(CaseHistory, "watch", watched)
        yield
