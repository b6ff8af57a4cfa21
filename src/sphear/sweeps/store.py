"""The folder of a sweep: one small file a run, written as the run ends, so that nothing is computed twice."""

from __future__ import annotations

import json
import os
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

from sphear.errors import SphearError
from sphear.results import OutputFolder
from sphear.sweeps.result import of_record
from sphear.sweeps.trusted import FORMAT, fault

if TYPE_CHECKING:
    from sphear.sweeps.plan import Run
    from sphear.sweeps.result import SweepResult

LARGEST = 1 << 28  # bytes of a file that is read


class Store:
    """Results by run, each in a file that is either whole or not there.

    Several sweeps may share a folder: a run has the same file in all of them.

    Args:
        folder: where the files are; made when the first is written.

    Raises:
        SphearError: the folder cannot be written.

    Examples:
        >>> import sphear
        >>> (run,) = sphear.plan("cavity", {"viscosity": ["morris"]}, {"scheme": "incompressible", "resolution": 10})
        >>> store = sphear.Store("results")
        >>> store.path(run).name, store.get(run)
        ('cavity-incompressible-morris-none-re100-n10-....json', None)
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = OutputFolder(folder)

    def path(self, run: Run) -> Path:
        """The file of a run."""
        return self.folder.path / f"{run.key}.json"

    def get(self, run: Run) -> SweepResult | None:
        """The stored result of a run; None where there is no file, or one that is not its whole result."""
        result, _ = self.read(run)
        return None if result is None or result.lost else result

    def read(self, run: Run) -> tuple[SweepResult | None, str | None]:
        """The stored result of a run, or that it was lost, and what is wrong with the file if it is not believed."""
        path = self.path(run)
        try:
            if path.stat().st_size > LARGEST:
                return None, "it is too large for a result"
            record = json.loads(path.read_text(encoding="utf-8"), parse_constant=_no_number)
        except FileNotFoundError:
            return None, None
        except IsADirectoryError:
            return None, "it is a folder"
        except OSError as error:
            return None, f"it cannot be read, {error.strerror or error}"
        except (ValueError, RecursionError):
            return None, "it is not whole"
        wrong = fault(record, run)
        return (None, wrong) if wrong else (of_record(record), None)

    def put(self, run: Run, result: SweepResult) -> None:
        """Keep the result of a run; a folder in its place is set aside, as NAME.aside, NAME.aside-2 and so on.

        Raises:
            SphearError: the file cannot be written.
        """
        path = self.path(run)
        if path.is_dir() and not path.is_symlink():
            _set_aside(path)
        whole: dict[str, Any] = {"format": FORMAT, **result.as_dict()}
        self.folder.write_text(path.name, json.dumps(whole, indent=1) + "\n")

    def forget(self, run: Run) -> None:
        """Remove the file of a run, if there is one."""
        with suppress(OSError):
            self.path(run).unlink()


def _no_number(name: str) -> NoReturn:
    raise ValueError(f"{name} is no number")


def _set_aside(path: Path) -> None:
    number = 1
    while (aside := path.with_name(f"{path.name}.aside{'' if number == 1 else f'-{number}'}")).exists():
        number += 1
    try:
        path.rename(aside)
    except OSError as error:
        raise SphearError(f"{path} is a folder in place of a result, and cannot be set aside: {error}") from error
