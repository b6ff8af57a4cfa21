"""The reason why an extension cannot be imported, and its line, in the words of one sentence."""

from __future__ import annotations

import traceback

from sphear.errors import SphearError


def reason(error: BaseException, file: str | None = None) -> str:
    """The error in a few words, such as `line 3, NameError: name 'x' is not defined`.

    Args:
        error: that ended the import.
        file: of the extension, whose line is named; None for the file that the error came from, which is named too.
    """
    said = " ".join(str(error.msg if isinstance(error, SyntaxError) else error).split())
    if not isinstance(error, SphearError):
        said = f"{type(error).__name__}{f': {said}' if said else ''}"
    where = _place(error, file)
    return f"{where}, {said}" if where else said


def _place(error: BaseException, file: str | None) -> str:
    """The line of the extension that the error came through last."""
    if isinstance(error, SyntaxError) and error.filename and error.lineno:
        frames = [(error.filename, error.lineno)]
    else:
        frames = [(frame.filename, frame.lineno or 0) for frame in traceback.extract_tb(error.__traceback__)]
        frames = [(name, line) for name, line in frames if not (name.startswith("<") or _between(name))]
    own = [(name, line) for name, line in frames if file is None or name == file]
    if not own:
        return ""
    name, line = own[-1]
    return f"line {line}" if name == file else f"{name}, line {line}"


def _between(file: str) -> bool:
    """A file of Python's import or of this package, which is between an extension and its error."""
    return "/importlib/" in file.replace("\\", "/") or file.startswith(__file__.rpartition("extensions")[0])
