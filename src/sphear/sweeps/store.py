"""The folder of a sweep: one small file a run, written as the run ends, so that nothing is computed twice."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING

from sphear.results import OutputFolder
from sphear.sweeps.result import of_record

if TYPE_CHECKING:
    from sphear.sweeps.plan import Run
    from sphear.sweeps.result import SweepResult


class Store:
    """Results by run, each in a file that is either whole or not there.

    Several sweeps may share a folder: a run has the same file in all of them.

    Args:
        folder: where the files are; made when the first is written.

    Raises:
        SphearError: the folder cannot be written.
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = OutputFolder(folder)

    def path(self, run: Run) -> Path:
        """The file of a run."""
        return self.folder.path / f"{run.key}.json"

    def get(self, run: Run) -> SweepResult | None:
        """The stored result of a run; None where there is no file, or one that another program left half-written."""
        try:
            return of_record(json.loads(self.path(run).read_text(encoding="utf-8")))
        except (OSError, ValueError):
            return None

    def put(self, run: Run, result: SweepResult) -> None:
        """Keep the result of a run.

        Raises:
            SphearError: the file cannot be written.
        """
        self.folder.write_text(self.path(run).name, json.dumps(result.as_dict(), indent=1) + "\n")
