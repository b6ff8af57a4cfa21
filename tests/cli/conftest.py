"""The command line run in this process, in a folder of its own."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from sphear.cli import main


@dataclass(frozen=True)
class Outcome:
    """What a command leaves behind."""

    status: object
    out: str
    err: str

    def json(self) -> Any:
        """The one JSON document that stdout must be, when nothing went wrong."""
        assert (self.status, self.err) == (0, "")
        return json.loads(self.out)


@pytest.fixture
def sphear(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> Callable[..., Outcome]:
    monkeypatch.chdir(tmp_path)
    # whether a test is the first to need some code, and so the one that compiles it, is not what it is about
    monkeypatch.setattr("sphear.cli.notices._compiling", lambda folder: None)

    def run(*arguments: object) -> Outcome:
        monkeypatch.setattr(sys, "argv", ["sphear", *map(str, arguments)])
        with pytest.raises(SystemExit) as left:
            main()
        captured = capsys.readouterr()
        return Outcome(left.value.code, captured.out, captured.err)

    return run
