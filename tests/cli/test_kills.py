"""Runs that SIGKILL ends at random moments; many more are killed by the script itself."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[2] / "validation" / "kills.py"


@pytest.mark.skipif(not hasattr(os, "fork"), reason="its runs are children of one process")
def test_killed_runs_end_as_the_unbroken_one(tmp_path: Path) -> None:
    few = ("--kills", "3", "--signals", "0", "--compiling", "0", "--scheme", "explicit")
    environment = {**os.environ, "PYTHONPATH": str(SCRIPT.parents[1] / "src")}
    command = [sys.executable, str(SCRIPT), *few, "--file", str(tmp_path / "kills.json")]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    found = json.loads((tmp_path / "kills.json").read_text())["kills"]["explicit"]
    assert found["kills"] == 3
    assert found["damaged states"] == 0
    assert found["equal to the unbroken run"] == found["runs"] >= 1
