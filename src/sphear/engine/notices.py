"""Events of the engine that someone may want to hear of: code is compiled, the code cache cannot be used.

The library itself prints nothing: that code is compiled goes unsaid, and what is wrong with the cache goes to the log.
Nothing here imports Numba, so that the command line can listen without waiting for it.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

Compiling = Callable[[Path | None], None]
Warned = Callable[[str], None]


def _unsaid(folder: Path | None) -> None:
    pass


@dataclass
class Notices:
    """The listeners, and what they have been told: each event is told once a process.

    Attributes:
        on_compiling: called before the first compilation, with the folder its code is kept in, None for none.
        on_warning: called with one sentence, without a full stop.
    """

    on_compiling: Compiling = _unsaid
    on_warning: Warned = logging.getLogger("sphear").warning
    _told: set[str] = field(default_factory=set)

    def compiling(self, folder: Path | None) -> None:
        """Tell that code is being compiled."""
        if "" not in self._told:
            self._told.add("")
            self.on_compiling(folder)

    def warn(self, sentence: str) -> None:
        """Tell what is wrong."""
        if sentence not in self._told:
            self._told.add(sentence)
            self.on_warning(sentence)

    def listen(self, on_compiling: Compiling = _unsaid, on_warning: Warned | None = None) -> None:
        """Choose the listeners, who are told of all events anew."""
        self.on_compiling = on_compiling
        self.on_warning = on_warning or logging.getLogger("sphear").warning
        self._told.clear()


notices = Notices()
