"""The words that a class says of itself."""

from __future__ import annotations


def in_words(kind: type) -> str:
    """The first line of a class's own docstring; nothing where it has none, or the one of a dataclass."""
    text = (vars(kind).get("__doc__") or "").strip().partition("\n")[0].rstrip(".")
    return "" if text.startswith(f"{kind.__name__}(") else text
