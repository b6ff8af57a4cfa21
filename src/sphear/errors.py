"""Errors a user can cause: one sentence that says what was wrong with what, and what is allowed."""

from __future__ import annotations


class SphearError(ValueError):
    """A mistake in the input; the message is one sentence, shown by the command line without a traceback."""


class TooFewNeighboursError(SphearError):
    """Some particles have too few (or too badly placed) neighbours for a correction or a fit."""


class SphearWarning(UserWarning):
    """What can be computed but is hardly meant; the message is one sentence."""


class Interrupted(Exception):
    """Ctrl-C in the midst of what can go on later; the message is one sentence that says how."""
