"""A tiny function that is compiled through the code cache, as a process that has just started would find it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from sphear.engine.cache import generated_module
from sphear.engine.notices import notices

TEXT = "from sphear.engine.cache import njit\n\n\n@njit(nogil=True)\ndef double(x):\n    return 2 * x\n"


@dataclass
class Cache:
    """A cache folder, and what was told of it."""

    folder: Path
    compilings: list[Path | None] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)

    def found(self, text: str = TEXT) -> bool:
        """Compute in a module that nobody has imported before; whether its machine code was found in the cache."""
        module = generated_module.__wrapped__(text)
        assert module.double(21) == 42
        return bool(module.double.stats.cache_hits)

    def file(self, suffix: str) -> Path:
        """The one file of the text (.py) or of machine code (.code)."""
        (path,) = self.folder.glob(f"*{suffix}")
        return path

    def names(self) -> list[str]:
        """Of all files."""
        return sorted(path.name for path in self.folder.iterdir())


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Cache]:
    """A new cache, and the listener to what is told of it."""
    monkeypatch.setenv("SPHEAR_CACHE_DIR", str(tmp_path / "cache"))
    made = Cache(tmp_path / "cache")
    notices.listen(made.compilings.append, made.warnings.append)
    yield made
    notices.listen()
