"""Files that machine code depends on: an edit of one of them, and of no other, makes compiled code stale."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from sphear.engine.cache import stamp

FILES = {
    "cells.py": (
        "from sphear.cache import compiled\nfrom sphear.sizes import (\n    REACH,\n)\n\n@compiled\ndef f(): ...\n"
    ),
    "lanes.py": "from sphear import numbers\n\n\ndef adder():\n    @intrinsic\n    def add(typingctx, a): ...\n",
    "numbers.py": "ZERO = 0.0\n",
    "sizes.py": "from sphear.units import CELL\n\nREACH = 2 * CELL\n",
    "units/__init__.py": "CELL = 1\n",
    "cache.py": "def compiled(f): ...\n",
    "scheme.py": "from sphear.cells import f\n\n\nclass Scheme: ...\n",
}
NEEDED = {"cells.py", "lanes.py", "numbers.py", "sizes.py", "units/__init__.py", "cache.py"}


@pytest.fixture
def package(tmp_path: Path) -> Path:
    for name, text in FILES.items():
        path = tmp_path / "sphear" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return tmp_path / "sphear"


def test_compiled_modules_and_what_they_import_count(package: Path) -> None:
    assert set(stamp.sources(package)) == NEEDED


@pytest.mark.parametrize("name", FILES)
def test_the_stamp_changes_with_what_counts_alone(package: Path, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stamp, "PACKAGE", package)
    stamp.stamp.cache_clear()
    before = stamp.stamp()
    (package / name).write_text(FILES[name] + "\nMORE = 1\n", encoding="utf-8")
    stamp.stamp.cache_clear()
    assert (stamp.stamp() != before) == (name in NEEDED)
    stamp.stamp.cache_clear()


def test_what_types_and_functions_import_does_not_count(package: Path) -> None:
    later = "if TYPE_CHECKING:\n    from sphear.scheme import Scheme\n"
    (package / "sizes.py").write_text(FILES["sizes.py"] + later, encoding="utf-8")
    assert set(stamp.sources(package)) == NEEDED


def test_all_modules_that_numba_compiles_for_are_found() -> None:
    found = stamp.sources(stamp.PACKAGE)
    numba = re.compile(rb"^from (numba|llvmlite)\b", re.MULTILINE)
    using = {path for path in stamp.PACKAGE.rglob("*.py") if numba.search(path.read_bytes())}
    names = {path.relative_to(stamp.PACKAGE).as_posix() for path in using}
    assert names - set(found) == {"engine/cuda.py"}  # whose machine code is not kept
    assert "schemes/weakly_compressible/settings.py" not in found
    assert not [name for name, content in found.items() if re.search(rb"^import sphear", content, re.MULTILINE)]
