"""Versions of the programs that a result was computed with."""

from __future__ import annotations

import platform
from functools import cache


def versions() -> dict[str, str]:
    """The versions of sphear, Python, NumPy and Numba, none of which is imported for it."""
    from sphear import __version__

    return {"sphear": __version__, "python": platform.python_version(), "numpy": _of("numpy"), "numba": _of("numba")}


@cache
def _of(package: str) -> str:
    from importlib.metadata import PackageNotFoundError, version  # takes long: commands come here at their end

    try:
        return version(package)
    except PackageNotFoundError:
        return "unknown"
