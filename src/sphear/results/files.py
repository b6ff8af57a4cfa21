"""The folder that results are written into."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from sphear.errors import OutputError, SphearError
from sphear.results.table import Table
from sphear.whole import remove_partial, whole

if TYPE_CHECKING:
    from matplotlib.figure import Figure


SHOWN = 80  # letters of a name that cannot be


class OutputFolder:
    """A folder in which every file is complete: each is written beside its name and put there in one step.

    A folder that cannot be written is refused at once, before anything is computed for it; it is made when the first
    file is written. What processes that were killed left half-written is removed.

    Attributes:
        path: The folder.
        files: The files written so far, in order.
    """

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.files: list[Path] = []
        try:
            self.path = Path(path)
            with suppress(FileNotFoundError, NotADirectoryError):  # it is made later, or refused below
                self.path.lstat()
            folders = (self.path, *self.path.absolute().parents)
            broken = next((link for link in folders if link.is_symlink() and not link.exists()), None)
        except (TypeError, ValueError, OSError) as error:  # no text, or a name that no file can have
            why = getattr(error, "strerror", None) or str(error)
            raise SphearError(f"{repr(path)[:SHOWN]} cannot be an output folder: {why}") from None
        if broken is not None:
            raise SphearError(f"{self.path} cannot be an output folder: {broken} is a link that leads nowhere")
        existing = next(folder for folder in folders if os.access(folder, os.F_OK))
        if not existing.is_dir():
            raise SphearError(f"{self.path} cannot be an output folder: {existing} is a file")
        if not os.access(existing, os.W_OK | os.X_OK):
            raise SphearError(f"{self.path} cannot be an output folder: {existing} is not writable")
        remove_partial(self.path)

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
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            with whole(path) as partial:
                yield partial
        except OSError as error:
            raise OutputError(f"{path} cannot be written: {error.strerror or error}") from error
        self.files.append(path)
