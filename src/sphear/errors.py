"""Errors a user can cause: one sentence that says what was wrong with what, and what is allowed."""

from __future__ import annotations


class SphearError(ValueError):
    """A mistake in the input; the message is one sentence, shown by the command line without a traceback."""


class TooFewNeighboursError(SphearError):
    """Some particles have too few (or too badly placed) neighbours for a correction or a fit."""


class OutputError(SphearError):
    """A file of results that could not be written, by no mistake in the input."""


class Interrupted(Exception):
    """A signal in the midst of what can go on later; the message is one sentence that says how.

    Attributes:
        status: exit status of the command line, 128 and the number of the signal: 130 of Ctrl-C.
    """

    def __init__(self, sentence: str, status: int = 130) -> None:
        super().__init__(sentence)
        self.status = status
