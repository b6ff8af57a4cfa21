"""The folder that results are written into."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from glob import escape
from pathlib import Path
from typing import TYPE_CHECKING

from sphear.errors import SphearError
from sphear.results.table import Table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

STALE = 3600.0  # seconds after which a file that is being written is one of a process that was killed


class OutputFolder:
    """A folder in which every file is complete: each is written beside its name and put there in one step.

    A folder that cannot be written is refused at once, before anything is computed for it; it is made when the first
    file is written.

    Attributes:
        path: The folder.
        files: The files written so far, in order.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path)
        self.files: list[Path] = []
        existing = next(folder for folder in (self.path, *self.path.absolute().parents) if os.access(folder, os.F_OK))
        if not existing.is_dir():
            raise SphearError(f"{self.path} cannot be an output folder: {existing} is a file")
        if not os.access(existing, os.W_OK | os.X_OK):
            raise SphearError(f"{self.path} cannot be an output folder: {existing} is not writable")

    def write_text(self, name: str, text: str) -> None:
        """Write a text file."""
        with self._complete(name) as path:
            path.write_text(text, encoding="utf-8")

    def write_table(self, name: str, table: Table) -> None:
        """Write a table as ``name.csv``."""
        with self._complete(f"{name}.csv") as path:
            table.to_csv(path)

    def write_figure(self, name: str, figure: Figure) -> None:
        """Write a figure as ``name.png`` and ``name.svg``."""
        from sphear.results.figure import save

        for suffix in ("png", "svg"):
            with self._complete(f"{name}.{suffix}") as path:
                save(figure, path, suffix)

    @contextmanager
    def _complete(self, name: str) -> Iterator[Path]:
        """Lend a path to write to, and give the file its name only once it is whole."""
        path = self.path / name
        partial = self.path / f".{name}.{os.getpid()}.partial"
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            self._remove_stale(name)
            yield partial
            partial.replace(path)
        except OSError as error:
            raise SphearError(f"{path} cannot be written: {error.strerror or error}") from error
        finally:
            with suppress(OSError):
                partial.unlink()
        self.files.append(path)

    def _remove_stale(self, name: str) -> None:
        """Remove what processes that were killed have left half-written of a file."""
        for partial in self.path.glob(f".{escape(name)}.*.partial"):
            with suppress(OSError):
                if time.time() - partial.stat().st_mtime > STALE:
                    partial.unlink()
