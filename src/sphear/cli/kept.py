"""The folder of `sphear run --out DIR`: taken over, computed and written so that nothing of it is lost."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

from sphear.cli.output import progress
from sphear.cli.signals import Signals
from sphear.errors import Interrupted, OutputError, SphearError

if TYPE_CHECKING:
    from pathlib import Path

    from sphear.cases.flow import CaseRun
    from sphear.results import OutputFolder


def say(sentence: str) -> None:
    """Say something on stderr, if anybody is there."""
    with suppress(OSError):
        print(f"sphear: {sentence}", file=sys.stderr)


def state_of(name: str, files: OutputFolder) -> Path:
    """The file that the state of a case is kept in."""
    return files.path / f"{name}-state.npz"


@contextmanager
def kept_in(files: OutputFolder | None, run: CaseRun, *, resume: bool, overwrite: bool) -> Iterator[None]:
    """The folder for this run alone: gone on with, or empty of a run of that case.

    Args:
        files: the folder; None where no files are wanted.
        run: set to where it goes on.
        resume: go on with the run that is there.
        overwrite: replace it.

    Raises:
        SphearError: another process computes it, it holds another run, or it holds none to go on with.
    """
    if resume and files is None:
        raise SphearError("--resume goes on with the run of a folder: name it by --out DIR")
    if resume and overwrite:
        raise SphearError("--resume goes on with the run of the folder and --overwrite replaces it: choose one")
    if files is None:
        yield
        return
    from sphear.results.lock import locked
    from sphear.simulation.saved import forget, recover
    from sphear.whole import remove_partial

    name, state = run.case.name, state_of(run.case.name, files)
    made = not files.path.exists()
    if resume and made:
        run.restore(state)  # says that there is none
    try:
        files.path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise SphearError(f"{files.path} cannot be an output folder: {error.strerror or error}") from None
    try:
        with locked(files.path / f".{name}.lock", f"{name} in {files.path}"):
            remove_partial(files.path)
            if resume:
                if said := recover(state):
                    say(said)
                run.restore(state)
            elif overwrite:
                forget(state)
            else:
                _check_empty(name, files)
            yield
    finally:
        if made:
            with suppress(OSError):  # which is not empty, most often
                files.path.rmdir()


def _check_empty(name: str, files: OutputFolder) -> None:
    from sphear.simulation.saved import earlier, read

    state = state_of(name, files)
    try:
        end = read(state)[0].end
    except SphearError:
        end = ""
    if (state.exists() or earlier(state).exists()) and not end:
        raise SphearError(
            f"{state} holds a run that was interrupted: --resume goes on with it; a new one needs another --out, or"
            " --overwrite"
        )
    if end or (files.path / f"{name}.json").exists():
        raise SphearError(
            f"{files.path} holds the results of a run of {name}: --resume goes on with that, --overwrite replaces it,"
            " another --out keeps both"
        )


def compute(run: CaseRun, files: OutputFolder | None, signals: Signals) -> None:
    """Run to the end; a signal keeps the state and says how to go on.

    Raises:
        Interrupted: a signal came.
    """
    keep = None if files is None else state_of(run.case.name, files)
    with progress(run.case.name) as tell:
        try:
            run.run(tell, keep, stopped=signals.heard, warn=say)
        except KeyboardInterrupt:
            raise Interrupted(_interrupted(run, files), signals.status) from None


def _interrupted(run: CaseRun, files: OutputFolder | None) -> str:
    now = run.flow.time / run.unit
    where = f"interrupted at {run.case.time_name} = {now:.4g}"
    if files is None:
        return f"{where}; nothing is kept: with --out DIR the run could be gone on with"
    if run.saved is None:
        return f"{where}; nothing is kept, as the state cannot be saved in {files.path}"
    at = "" if run.saved == now else f" of {run.case.time_name} = {run.saved:.4g}"
    return f"{where}; the state{at} is in {files.path}, and the same command with --resume goes on from there"


def finish(run: CaseRun, files: OutputFolder | None, steps: Sequence[Callable[[], None]], signals: Signals) -> None:
    """Gather and write the results of a run that has ended, step by step; its state is kept until they are there.

    That of a run that can be extended stays with them.

    Raises:
        OutputError: one cannot be written.
        Interrupted: a signal came.
    """
    ended = f"the run has ended at {run.case.time_name} = {run.flow.time / run.unit:.4g}"
    if files is None:
        later = f"{ended}, and nothing is kept without --out DIR"
    elif run.saved is None:
        later = f"{ended}, and its state could not be saved either: it has to be computed again, where there is room"
    else:
        state = state_of(run.case.name, files)
        later = f"{ended} and its state is in {state}: the same command with --resume writes the results"
    try:
        for step in steps:
            if signals.heard():
                raise KeyboardInterrupt
            step()
    except KeyboardInterrupt:
        raise Interrupted(f"interrupted while results are written; {later}", signals.status) from None
    except OutputError as error:
        raise OutputError(f"{error}; {later}") from None
    if files is None:
        return
    from sphear.simulation.saved import earlier, forget

    state = state_of(run.case.name, files)
    with suppress(OSError):
        if run.end.startswith("failed"):
            forget(state)
        else:
            earlier(state).unlink(missing_ok=True)
    if signals.heard():
        raise Interrupted(f"interrupted, when all results were written to {files.path}", signals.status)
