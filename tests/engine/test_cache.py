"""Generated code on disk: found again by the next process, never met when it is stale, and never in the way."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from sphear import Neighbours
from sphear.engine import cache
from sphear.engine.cache import cache_directory, generated, generated_module
from sphear.engine.sweep import sweep

# the sum of a formula over a row of particles, in a process of its own
SCRIPT = """
import sys
sys.path.insert(0, sys.argv[1])
import numpy as np
from formula import Formula
from sphear import Neighbours
from sphear.engine.sweep import sweep
print(*sweep(Formula(), Neighbours(np.arange(3.0)[:, None], 1.5), mass=np.array([1.0, 2.0, 4.0]))[:, 0])
"""
FORMULA = """
from dataclasses import dataclass
from sphear.algebra import positive_part
from sphear.engine.formula import Sum

@dataclass(frozen=True)
class Formula(Sum):
    def pair(self, own, other, d, r2):
        return (positive_part(2.25 - r2) * {weight},)
"""
SUMS = {"other.mass": "2.5 6.25 2.5", "own.mass": "1.25 5.0 5.0"}


def run(folder: Path, formula: str, **environment: str) -> str:
    """What the script prints with this formula, and with a code cache in the folder."""
    (folder / "formula.py").write_text(FORMULA.format(weight=formula), encoding="utf-8")
    variables = os.environ | {"SPHEAR_CACHE_DIR": str(folder / "cache"), "PYTHONDONTWRITEBYTECODE": "1"} | environment
    command = [sys.executable, "-W", "error", "-c", SCRIPT, str(folder)]
    done = subprocess.run(command, env=variables, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def machine_code(folder: Path) -> dict[str, int]:
    """The files of the code cache, with the time each was written."""
    return {path.name: path.stat().st_mtime_ns for path in folder.rglob("*") if path.suffix in (".py", ".code")}


def test_a_second_process_compiles_nothing_and_an_edited_formula_is_compiled_anew(tmp_path: Path) -> None:
    # sets are printed in another order by another hash seed: the text, and so its name, must not depend on it
    assert run(tmp_path, "other.mass", PYTHONHASHSEED="1") == SUMS["other.mass"]
    first = machine_code(tmp_path / "cache")
    assert any(name.endswith(".code") for name in first)
    assert run(tmp_path, "other.mass", PYTHONHASHSEED="2") == SUMS["other.mass"]
    assert machine_code(tmp_path / "cache") == first
    assert run(tmp_path, "own.mass") == SUMS["own.mass"]
    edited = machine_code(tmp_path / "cache")
    assert edited.items() > first.items()
    assert run(tmp_path, "other.mass") == SUMS["other.mass"]
    assert machine_code(tmp_path / "cache") == edited


def test_a_cache_folder_that_cannot_be_written_to_is_done_without(tmp_path: Path) -> None:
    (tmp_path / "cache").write_text("a file, not a folder", encoding="utf-8")
    (tmp_path / "temporary").mkdir()
    assert run(tmp_path, "other.mass", TMPDIR=str(tmp_path / "temporary")) == SUMS["other.mass"]
    assert machine_code(tmp_path / "temporary")


def test_a_process_that_finds_every_file_damaged_is_right_and_mends_them(tmp_path: Path) -> None:
    run(tmp_path, "other.mass")
    files = sorted((tmp_path / "cache").iterdir())
    contents = {path: path.read_bytes() for path in files}
    for number, path in enumerate(files):
        path.write_bytes((b"", contents[path][: len(contents[path]) // 2], bytes(100))[number % 3])
    assert run(tmp_path, "other.mass") == SUMS["other.mass"]
    texts = [path for path in files if path.suffix == ".py"]
    assert [path.read_bytes() for path in texts] == [contents[path] for path in texts]
    mended = machine_code(tmp_path / "cache")
    assert run(tmp_path, "other.mass") == SUMS["other.mass"]
    assert machine_code(tmp_path / "cache") == mended


def test_a_read_only_installation_without_a_home_still_works(tmp_path: Path) -> None:
    """Code compiled from files of the package itself is in the same cache, not beside them."""
    package = Path(cache.__file__).parents[2]
    for source in package.rglob("*.py"):
        copy = tmp_path / "installed" / "sphear" / source.relative_to(package)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_bytes(source.read_bytes())
        (copy.parent / "__pycache__").touch()  # a file where the folder would be
    blocked = {name: str(tmp_path / "formula.py") for name in ("HOME", "XDG_CACHE_HOME", "LOCALAPPDATA")}
    (tmp_path / "cache").touch()
    (tmp_path / "temporary").mkdir()
    blocked |= {"PYTHONPATH": str(tmp_path / "installed"), "TMPDIR": str(tmp_path / "temporary")}
    assert run(tmp_path, "other.mass", **blocked) == SUMS["other.mass"]
    assert machine_code(tmp_path / "temporary")
    assert not machine_code(tmp_path / "installed" / "sphear" / "neighbours" / "__pycache__")


def test_formulas_of_the_same_name_are_told_apart_within_a_process() -> None:
    pairs = Neighbours(np.arange(3.0)[:, None], 1.5)
    for weight, expected in SUMS.items():
        module = ModuleType("formula")
        exec(FORMULA.format(weight=weight), module.__dict__)
        found = sweep(module.Formula(), pairs, mass=np.array([1.0, 2.0, 4.0]))[:, 0]
        assert " ".join(map(str, found)) == expected


@pytest.fixture
def no_cache_variables(monkeypatch: pytest.MonkeyPatch) -> pytest.MonkeyPatch:
    for name in ("SPHEAR_CACHE_DIR", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    return monkeypatch


def test_the_cache_folder_is_the_one_asked_for(no_cache_variables: pytest.MonkeyPatch, tmp_path: Path) -> None:
    no_cache_variables.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    no_cache_variables.setenv("SPHEAR_CACHE_DIR", str(tmp_path / "asked" / "for"))
    assert cache_directory() == tmp_path / "asked" / "for"
    assert (tmp_path / "asked" / "for").is_dir()


@pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="other platforms have other cache folders")
def test_the_cache_folder_is_that_of_the_user(no_cache_variables: pytest.MonkeyPatch, tmp_path: Path) -> None:
    no_cache_variables.setenv("HOME", str(tmp_path))
    assert cache_directory() == tmp_path / ".cache" / "sphear"
    no_cache_variables.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    assert cache_directory() == tmp_path / "xdg" / "sphear"


def test_a_generated_module_is_named_by_its_text(no_cache_variables: pytest.MonkeyPatch, tmp_path: Path) -> None:
    no_cache_variables.setenv("SPHEAR_CACHE_DIR", str(tmp_path))
    one, two = generated_module("x = 1\n"), generated_module("x = 2\n")
    assert (one.x, two.x) == (1, 2)
    assert one.__name__ != two.__name__
    assert generated_module("x = 1\n") is one
    assert sorted(path.name for path in tmp_path.glob("*.py")) == sorted(f"{m.__name__}.py" for m in (one, two))
    assert not list(tmp_path.glob("*.tmp"))


def test_generated_code_says_which_engine_it_belongs_to(no_cache_variables: pytest.MonkeyPatch, tmp_path: Path) -> None:
    no_cache_variables.setenv("SPHEAR_CACHE_DIR", str(tmp_path))
    old = generated_module("y = 1\n")
    no_cache_variables.setattr(generated, "stamp", lambda: "another")
    generated_module.cache_clear()
    assert generated_module("y = 1\n").__name__ != old.__name__
