"""The checks of pre-commit, so that `make test` is green only where a commit would be, and how docstrings begin."""

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SOURCE = ROOT / "src" / "sphear"
NO_FIRST_WORDS = {
    "What",
    "Whether",
    "Which",
    "Those",
    "That",
    "How",
}  # a docstring begins with a verb or the thing itself
ONLY_A_SHAPE = re.compile(r"\([\w, -]*\)\.?")  # "(N, d).", which does not say of what


@pytest.mark.parametrize("tool", ["ruff check", "ruff format --check", "mypy"])
def test_style(tool: str) -> None:
    check = subprocess.run([sys.executable, "-m", *tool.split()], cwd=ROOT, capture_output=True, text=True, check=False)
    assert check.returncode == 0, check.stdout + check.stderr


def docstrings(path: Path) -> list[tuple[str, str]]:
    """The docstrings of a file by their first lines, each with its place."""
    return [
        (f"{path.relative_to(SOURCE)}, {getattr(node, 'name', 'module')}", said.splitlines()[0])
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef)
        and (said := ast.get_docstring(node))
    ]


def test_docstrings_begin_with_a_verb_or_the_thing() -> None:
    found = [each for path in sorted(SOURCE.rglob("*.py")) for each in docstrings(path)]
    assert len(found) > 1500
    assert [(place, line) for place, line in found if line.split()[0].strip(",:.") in NO_FIRST_WORDS] == []
    assert [(place, line) for place, line in found if ONLY_A_SHAPE.fullmatch(line)] == []
