"""Errors a user can cause: one sentence that says what was wrong with what, and what is allowed."""

from __future__ import annotations

LONGEST = 80  # characters of what a message quotes
ENDING = 20  # of these at its end
WHOLE = 1200  # characters of a message


class SphearError(ValueError):
    """A mistake in the input; the message is one sentence, shown by the command line without a traceback.

    Examples:
        >>> import sphear
        >>> sphear.CubicSpline(h=-1.0)
        Traceback (most recent call last):
            ...
        sphear.errors.SphearError: the smoothing length h must be positive, not -1.0
    """

    def __init__(self, message: str = "") -> None:
        super().__init__(shortened(message, WHOLE))


class TooFewNeighboursError(SphearError):
    """Some particles have too few (or too badly placed) neighbours for a correction or a fit.

    Examples:
        >>> import sphear
        >>> in_line = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0)]
        >>> sphear.gradient(in_line, [0.0, 1.0, 2.0], spacing=1.0, correction="renormalised")
        Traceback (most recent call last):
            ...
        sphear.errors.TooFewNeighboursError: 3 of 3 particles have too few neighbours for correction 'renormalised', ...
        >>> sphear.gradient(in_line, [0.0, 1.0, 2.0], spacing=1.0, correction="renormalised", fallback="nan").shape
        (3, 2)
    """


class OutputError(SphearError):
    """A file of results that could not be written, by no mistake in the input."""


class SphearWarning(UserWarning):
    """An input that can be computed but is hardly meant; the message is one sentence.

    Examples:
        >>> import warnings
        >>> import sphear
        >>> warnings.simplefilter("error", sphear.SphearWarning)  # to be stopped by one
        >>> sphear.laplacian([(0.0, 0.0), (1.0, 0.0), (9.0, 9.0)], [0.0, 1.0, 2.0], spacing=1.0)
        Traceback (most recent call last):
            ...
        sphear.errors.SphearWarning: 1 of 3 particles have no neighbour within the support of 3.14, ...
    """


class Interrupted(Exception):
    """A signal in the midst of what can go on later; the message is one sentence that says how.

    Attributes:
        status: exit status of the command line, 128 and the number of the signal: 130 of Ctrl-C.
    """

    def __init__(self, sentence: str, status: int = 130) -> None:
        super().__init__(sentence)
        self.status = status


def quoted(value: object) -> str:
    """The value as Python writes it, on one line and shortened where it is long, to be quoted by a message."""
    try:
        text = repr(value[: WHOLE + 1] + value[-ENDING:] if isinstance(value, str) and len(value) > WHOLE else value)
    except (ValueError, TypeError, AttributeError, RecursionError):  # of a whole number with thousands of digits, say
        return f"a value of the type {type(value).__name__}"
    return shortened(" ".join(text.split()) if not isinstance(value, str) else text)


def shortened(text: str, longest: int = LONGEST) -> str:
    """The text itself, or its beginning and end if it has more characters than `longest`."""
    return text if len(text) <= longest else f"{text[: longest - ENDING - 3]}...{text[-ENDING:]}"
