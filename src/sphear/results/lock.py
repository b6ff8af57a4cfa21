"""One run in a folder at a time."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from platform import node

from sphear.errors import SphearError
from sphear.whole import is_running

try:
    import fcntl
except ImportError:  # not on every system
    fcntl = None  # type: ignore[assignment]


@contextmanager
def locked(path: Path, what: str) -> Iterator[None]:
    """Hold a lock file, which says who holds it, and remove it afterwards.

    The system drops the lock of a process that ends, however that happens; where it has no locks, or its disks have
    not, the process that the file names decides.

    Args:
        path: of the file.
        what: is locked, in a few words.

    Raises:
        SphearError: another process holds it.
        OSError: the file cannot be written.
    """
    descriptor = _taken(path, what)
    try:
        os.ftruncate(descriptor, 0)
        os.lseek(descriptor, 0, os.SEEK_SET)
        os.write(descriptor, f"{os.getpid()} {node()}\n".encode())
        yield
    finally:
        if os.name != "posix":  # which cannot remove an open file
            os.close(descriptor)
        with suppress(OSError):
            path.unlink()
        if os.name == "posix":
            os.close(descriptor)


def _taken(path: Path, what: str) -> int:
    while True:
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o644)
        try:
            free = _lock(descriptor)
            there = path.stat().st_ino == os.fstat(descriptor).st_ino
        except FileNotFoundError:  # whoever held it has just removed it
            os.close(descriptor)
            continue
        if free and there:
            return descriptor
        holder = _holder(descriptor)
        os.close(descriptor)
        if there:
            by = f"process {holder[0]} on {holder[1]}" if len(holder) == 2 else "another process"
            known = os.name == "posix" and holder[1:] in ([], [node()])
            gone = "" if known else f"; if that process is gone, delete {path}"
            raise SphearError(f"{what} is being computed by {by}: wait for its end or take another --out{gone}")


def _lock(descriptor: int) -> bool:
    """Lock an open file; whether nobody else has."""
    if fcntl is not None:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            if error.errno in (errno.EWOULDBLOCK, errno.EACCES):
                return False
        else:
            return True
    holder = _holder(descriptor)
    if len(holder) != 2 or not holder[0].isdigit():
        return True
    return holder[1] == node() and not is_running(int(holder[0]))


def _holder(descriptor: int) -> list[str]:
    """The number and the machine of the process that a lock file names."""
    os.lseek(descriptor, 0, os.SEEK_SET)
    return os.read(descriptor, 300).decode(errors="replace").split()
