"""Ctrl-C at an output of a run."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import pytest

from sphear.cases.flow import FlowRun


@contextmanager
def interrupted_at(output: int, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Have Ctrl-C come when a run has made so many outputs."""
    observe = FlowRun._observe

    def observed(run: FlowRun, until: float) -> None:
        observe(run, until)
        if len(run.history) == output:
            raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(FlowRun, "_observe", observed)
        yield
