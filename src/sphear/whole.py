"""Files that are whole or not there: written beside their name, put there in one step, and safe from a power cut."""

from __future__ import annotations

import os
import re
import zlib
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from platform import node

HOST = f"{zlib.crc32(node().encode()):08x}"
_PARTIAL = re.compile(r"^\.(?P<name>.+)\.(?P<host>[0-9a-f]{8})-(?P<process>\d+)\.partial$")


@contextmanager
def whole(path: Path, *, before: Path | None = None) -> Iterator[Path]:
    """Lend a path to write to, and give the file its name once it is whole and on the disk.

    Args:
        path: the name.
        before: what the file of that name is called from then on; without it, it is replaced.

    Raises:
        OSError: it cannot be written; what had the name has it still, or is `before`.
    """
    partial = path.with_name(f".{path.name}.{HOST}-{os.getpid()}.partial")
    try:
        yield partial
        _sync(partial)
        if before is not None:
            with suppress(FileNotFoundError):
                path.replace(before)
        partial.replace(path)
        with suppress(OSError):  # not every system can do that with a folder
            _sync(path.parent)
    finally:
        with suppress(OSError):
            partial.unlink()


def _sync(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY if path.is_dir() else os.O_RDWR)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def remove_partial(folder: Path, prefix: str = "") -> None:
    """Remove what processes of this machine left half-written when they were killed.

    Args:
        folder: where; it need not be there.
        prefix: of the names that the files would have had.
    """
    with suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            found = _PARTIAL.match(entry.name)
            if found is None or found["host"] != HOST or not found["name"].startswith(prefix):
                continue
            if not is_running(int(found["process"])):
                with suppress(OSError):
                    Path(entry.path).unlink()


def is_running(process: int) -> bool:
    """True if a process of this machine is there; where that cannot be asked, it is."""
    if os.name != "posix":
        return True
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except OSError:  # of another user
        return True
    return True
