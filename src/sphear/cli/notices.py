"""Notices of the engine as lines on stderr: that it compiles, and what is wrong with its cache."""

from __future__ import annotations

import sys
from pathlib import Path

from sphear.cli.output import is_terminal
from sphear.engine.notices import notices


def say_notices(as_json: bool) -> None:
    """Have them said from now on; that code is compiled is not for programs, who ask for JSON and watch no terminal."""
    if is_terminal(sys.stderr) or not as_json:
        notices.listen(_compiling, _warning)
    else:
        notices.listen(on_warning=_warning)


def _compiling(folder: Path | None) -> None:
    _say("compiling, in this process alone" if folder is None else f"compiling (once; kept in {folder})")


def _warning(sentence: str) -> None:
    _say(f"warning: {sentence}")


def _say(line: str) -> None:
    if sys.stderr is not None:
        print(f"sphear: {line}", file=sys.stderr, flush=True)
