"""Results of long studies, kept in the package with their settings, so that they are redrawn and not computed."""

from __future__ import annotations

import json
import os
from collections.abc import Collection, Sequence
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from sphear.errors import SphearError
from sphear.results.finite import finite
from sphear.studies.result import Progress, StudyResult

if TYPE_CHECKING:
    from sphear.sweeps import Run, Store, SweepResult

DERIVED = ("sound_speed", "time_step", "kinematic_viscosity", "until", "force", "threads")


class LongStudy(Protocol):
    """A study whose numbers take long: computing them and presenting them are two steps."""

    def compute(self, *, quick: bool, workers: int, progress: Progress) -> dict[str, Any]:
        """All numbers that are shown, as JSON knows them."""

    def present(self, data: dict[str, Any]) -> StudyResult:
        """Tables, figures and the finding."""


class ShortStudy(Protocol):
    """A study that is computed whenever it is asked for."""

    def run(self, *, quick: bool, progress: Progress) -> StudyResult:
        """Tables, figures and the finding."""


def kept(paper: str, item: str) -> dict[str, Any]:
    """The kept numbers of an item.

    Raises:
        SphearError: there are none.
    """
    place = files(f"sphear.studies.{paper}").joinpath("results", f"{item}.json")
    try:
        found = json.loads(place.read_text(encoding="utf-8"))
    except OSError:
        raise SphearError(f"no results of {paper} {item} are kept: compute them with --rerun") from None
    return dict(found)


def as_text(data: dict[str, Any]) -> str:
    """The numbers as they are kept: a line for each entry of the lists at the top, so that changes can be read."""
    lines = []
    for key, value in finite(data).items():
        if isinstance(value, list) and value and isinstance(value[0], dict):
            entries = ",\n  ".join(json.dumps(entry) for entry in value)
            lines.append(f"{json.dumps(key)}: [\n  {entries}\n ]")
        else:
            lines.append(f"{json.dumps(key)}: {json.dumps(value)}")
    return "{\n " + ",\n ".join(lines) + "\n}\n"


def in_common(results: Sequence[SweepResult], varied: Collection[str]) -> dict[str, Any]:
    """The settings that all runs of a study have, without those that are gone through and those that follow from them.

    Args:
        results: of the runs.
        varied: the settings that are gone through.
    """
    return {key: value for key, value in results[0].settings.items() if key not in (*varied, *DERIVED)}


def runs_folder(paper: str) -> Path:
    """The folder of the runs of a paper's studies: `$SPHEAR_RUNS_DIR`, else in the user's cache folder.

    Raises:
        SphearError: there cannot be such a folder.
    """
    from sphear.engine.cache import cache_directory

    chosen = os.environ.get("SPHEAR_RUNS_DIR")
    caches = Path(chosen) if chosen else cache_directory()
    if caches is None:
        raise SphearError("there is no folder to keep runs in: name one in SPHEAR_RUNS_DIR")
    folder = (caches if chosen else caches / "runs") / paper
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise SphearError(f"the folder for runs, {folder}, cannot be used: {error.strerror}") from None
    return folder


def store(paper: str) -> Store:
    """The runs of a paper's studies."""
    from sphear.sweeps import Store

    return Store(runs_folder(paper))


def swept(
    runs: list[Run],
    paper: str,
    workers: int,
    progress: Progress,
    *,
    compute: str | None = None,
    longest_first: bool = True,
) -> list[SweepResult]:
    """The results of runs, each kept as it ends (`runs_folder`): an interrupted study goes on from there.

    Args:
        runs: what to compute.
        paper: whose runs they are.
        workers: processes.
        progress: told where the sweep stands.
        compute: import path of the function that computes a run, where it is not the usual one.
        longest_first: else the short ones.

    Raises:
        SphearError: a run was lost.
    """
    from sphear.sweeps import run_sweep
    from sphear.sweeps.worker import COMPUTE

    results = run_sweep(
        runs,
        store(paper),
        workers=workers,
        progress=lambda state: progress(str(state)),
        compute=compute or COMPUTE,
        longest_first=longest_first,
    )
    lost = [result for result in results if result.lost]
    if lost:
        raise SphearError(
            f"{len(lost)} of {len(runs)} runs were lost ({lost[0].end}): the same command computes them and keeps the"
            " others"
        )
    return results
