"""Entry points: the extensions that installed packages declare, imported when names are first looked up."""

from __future__ import annotations

import warnings
from importlib.metadata import EntryPoint, entry_points
from threading import RLock

from sphear.errors import SphearWarning, quoted
from sphear.extensions.failure import reason

GROUP = "sphear.extensions"
"""The group of entry points in a package's pyproject.toml; the value of each is a module."""

_lock = RLock()
_done = False


def discover() -> None:
    """Import the modules that installed packages declare, once a process; their decorators register names.

    A module that fails leaves the others and sphear itself alone.

    Warns:
        SphearWarning: a module cannot be imported, with its package and the reason.
    """
    global _done
    if _done:
        return
    with _lock:
        if _done:
            return
        _done = True  # before: extensions look names up too
        for entry in entry_points(group=GROUP):
            _imported(entry)


def _imported(entry: EntryPoint) -> None:
    try:
        entry.load()
    except (Exception, SystemExit) as error:  # noqa: BLE001, whatever others wrote
        package = entry.dist.name if entry.dist else entry.name
        warnings.warn(
            f"the extension {quoted(entry.value)} of the package {package} cannot be imported and its names are"
            f" missing: {reason(error)}",
            SphearWarning,
            stacklevel=5,
        )
