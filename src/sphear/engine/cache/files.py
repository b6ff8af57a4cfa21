"""Files of the code cache: private, whole, and believed only where nobody else can have written them.

Machine code is unpickled, which runs whatever stands in the file. So a file is read only if it is a plain file of this
user that no other may write, and what is in it counts only under a checksum and for the very key that it was written
for. Whoever can write files of this user can run code as that user anyway.
"""

from __future__ import annotations

import hashlib
import os
import stat
import tempfile
import time
from contextlib import suppress
from pathlib import Path

LARGEST = 1 << 28  # bytes of a file of the cache; machine code of a time loop has less than a million
STALE = 3600.0  # seconds after which a file that is being written is one of a process that was killed
SUFFIX = ".tmp"

_SEAL = b"sphear machine code 1\n"
_READ = os.O_RDONLY | sum(getattr(os, name, 0) for name in ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC", "O_BINARY"))


def is_private(status: os.stat_result) -> bool:
    """True if a file or folder is of this user, and nobody else may write it; always, where there are no users."""
    if not hasattr(os, "geteuid"):
        return True
    return status.st_uid == os.geteuid() and not status.st_mode & (stat.S_IWGRP | stat.S_IWOTH)


def read(path: Path) -> bytes | None:
    """The content of a file; None where there is none, where it cannot be read and where it may not be believed."""
    try:
        handle = os.open(path, _READ)  # neither follows a link nor waits for the other end of a pipe
    except OSError:
        return None
    with suppress(OSError), os.fdopen(handle, "rb") as file:
        status = os.fstat(handle)
        if stat.S_ISREG(status.st_mode) and is_private(status) and status.st_size <= LARGEST:
            return file.read()
    return None


def write(path: Path, content: bytes) -> None:
    """Write a file for this user alone: beside its name, onto the disk, and only then under its name.

    Another process may write the same file meanwhile: either is right.

    Raises:
        OSError: it cannot be written; nothing is left of it.
    """
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=path.name, suffix=SUFFIX)
    temporary = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(handle)
        if path.is_dir() and not path.is_symlink():
            path.rmdir()  # nobody has put it there for good
        temporary.replace(path)
    except BaseException:
        with suppress(OSError):
            temporary.unlink()
        raise


def sealed(key: str, content: bytes) -> bytes:
    """The content under a checksum of it and of its key."""
    return _SEAL + _checksum(key, content) + content


def unsealed(key: str, content: bytes | None) -> bytes | None:
    """Open what was sealed with this key; None if it was not, or is damaged."""
    begin = len(_SEAL) + hashlib.sha256().digest_size
    if content is None or content[:begin] != _SEAL + _checksum(key, content[begin:]):
        return None
    return content[begin:]


def _checksum(key: str, content: bytes) -> bytes:
    return hashlib.sha256(hashlib.sha256(key.encode()).digest() + content).digest()


def remove_stale(folder: Path, pattern: str = f"*{SUFFIX}") -> None:
    """Remove what processes that were killed have left half-written in a folder."""
    for path in folder.glob(pattern):
        with suppress(OSError):
            if time.time() - path.lstat().st_mtime > STALE:
                path.unlink()
