"""A stamp of all that compiled code depends on besides its own text."""

from __future__ import annotations

import hashlib
import sys
from functools import cache
from pathlib import Path

import llvmlite
import numba

# where functions stand that generated code and other compiled functions call
FOLDERS = (
    "engine",
    "engine/backends/cpu",
    "engine/cache",
    "neighbours",
    "boundaries",
    "schemes",
    "pressure",
    "pressure/preconditioners",
)


@cache
def stamp() -> str:
    """A hash of the sources of all compiled functions, and of the versions below them."""
    digest = hashlib.sha256(f"{numba.__version__} {llvmlite.__version__} {sys.version}".encode())
    package = Path(__file__).parents[2]
    for folder in FOLDERS:
        for path in sorted((package / folder).glob("*.py")):
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


@cache
def source_stamp(path: str) -> str:
    """A hash of a source file; empty where it cannot be read."""
    try:
        return hashlib.sha256(Path(path).read_bytes()).hexdigest()
    except OSError:
        return ""
