"""The folder of the code cache: this user's own, that nobody else may write, or none."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path

from sphear.engine.cache.files import is_private, remove_stale, write
from sphear.engine.interrupts import blocked_signals
from sphear.engine.notices import notices


def cache_directory() -> Path | None:
    """`$SPHEAR_CACHE_DIR`, else the user's cache folder, else one of this user's in the folder for temporary files.

    It is made, with its missing parents, for this user alone. None where there can be no folder: code is then compiled
    in memory, by each process.
    """
    named = os.environ.get("SPHEAR_CACHE_DIR")
    return _usable(Path(named).absolute() if named else _of_the_user(), bool(named))


def _of_the_user() -> Path | None:
    """The platform's folder for caches; None for a user without home and account."""
    try:
        if sys.platform == "win32":
            return Path(os.environ.get("LOCALAPPDATA") or Path.home()) / "sphear" / "cache"
        if sys.platform == "darwin":
            return Path.home() / "Library" / "Caches" / "sphear"
        return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache").absolute() / "sphear"
    except RuntimeError:
        return None


def _of_this_user_among_temporary_files() -> Path | None:
    """One folder a user, not one a process: it is found again, and nothing piles up."""
    user = os.geteuid() if hasattr(os, "geteuid") else ""
    with suppress(OSError):  # where no file can be written anywhere
        return Path(tempfile.gettempdir()).absolute() / f"sphear-{user}".rstrip("-")
    return None


@cache
def _usable(wanted: Path | None, named: bool) -> Path | None:
    fault = "there is no home folder" if wanted is None else _fault(wanted, Path.stat)
    if not fault:
        return wanted
    instead = _of_this_user_among_temporary_files()
    # others know its name and may put a link there first
    if instead is not None and _fault(instead, Path.lstat):
        instead = None
    kept = "each process compiles its own" if instead is None else f"it is kept in {instead}"
    # no home, or none that can be written, is nobody's mistake: it needs no word where there is a way out
    if instead is None or named or not fault.startswith("there is no"):
        notices.warn(f"compiled code is not kept in {wanted or 'the cache folder'}, because {fault}; {kept}")
    return instead


def _fault(folder: Path, status: Callable[[Path], os.stat_result]) -> str:
    """The reason why a folder, which is made if it is not there, cannot be used; empty if it can."""
    try:
        for parent in reversed([folder, *folder.parents]):
            if not parent.exists():
                parent.mkdir(mode=0o700, exist_ok=True)
        found = status(folder)
    except (OSError, RuntimeError, ValueError) as error:  # a loop of links; a name with a zero byte
        return f"there is no such folder ({getattr(error, 'strerror', None) or error})"
    if not folder.is_dir() or (folder.is_symlink() and status is Path.lstat):
        return "there is no such folder (Not a directory)"
    if not is_private(found):
        return "it belongs to another user" if found.st_uid != os.geteuid() else "others may write to it"
    if not os.access(folder, os.R_OK | os.W_OK | os.X_OK):
        return "there is no writing to it"
    return ""


@cache
def _tidy(folder: Path) -> None:
    remove_stale(folder)


def keep(path: Path, content: bytes) -> None:
    """Write a file of the cache if that is possible; say once if it is not."""
    _tidy(path.parent)
    try:
        with blocked_signals():
            write(path, content)
    except OSError as error:
        notices.warn(
            f"compiled code cannot be kept in {path.parent} ({error.strerror or error}): what is missing there is"
            " compiled by each process"
        )
