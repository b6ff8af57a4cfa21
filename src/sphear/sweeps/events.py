"""Events that whoever computes runs tells of them, as they happen."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphear.sweeps.plan import Run


LONGEST = 300  # letters of a reason


@dataclass(frozen=True)
class Started:
    """A run is with a worker."""

    run: Run


@dataclass(frozen=True)
class Finished:
    """A run has come to its end."""

    run: Run
    record: dict[str, Any]


@dataclass(frozen=True)
class Lost:
    """A run will not come to its end."""

    run: Run
    reason: str
    of_itself: bool = False  # by an exception, which will come again, and not because its worker was killed


Event = Started | Finished | Lost


def unexpected(run: Run, error: BaseException) -> Lost:
    """A run that ended with an exception; one of memory or files may be the machine's and no fault of the run."""
    reason = f"{type(error).__name__}: {' '.join(str(error).split())}".removesuffix(": ")
    return Lost(run, reason[:LONGEST], of_itself=not isinstance(error, MemoryError | OSError))
