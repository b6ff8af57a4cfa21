"""Nobody is told where a computation stands, unless someone asks to be."""

from __future__ import annotations


def no_progress(*told: object) -> None:
    """Tell nobody."""
