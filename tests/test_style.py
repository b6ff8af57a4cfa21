"""The checks of pre-commit, so that `make test` is green only where a commit would be."""

import subprocess
import sys
from pathlib import Path

import pytest


@pytest.mark.parametrize("tool", ["ruff check", "ruff format --check", "mypy"])
def test_style(tool: str) -> None:
    root = Path(__file__).parents[1]
    check = subprocess.run([sys.executable, "-m", *tool.split()], cwd=root, capture_output=True, text=True, check=False)
    assert check.returncode == 0, check.stdout + check.stderr
