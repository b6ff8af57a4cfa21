"""The result of a run: its end, its metrics and a history that is short enough to keep."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, fields
from typing import TYPE_CHECKING, Any

from sphear.results.finite import finite
from sphear.sweeps.trusted import shape_fault

if TYPE_CHECKING:
    from sphear.cases.flow import CaseRun
    from sphear.sweeps.plan import Run

HISTORY = 100  # rows at most
OPTIONAL = {"profiles", "versions", "warnings"}  # what a record may lack


@dataclass(frozen=True)
class SweepResult:
    """The result of one run of a sweep; numbers that are not finite are None.

    Attributes:
        case: name of the flow.
        settings: resolved.
        metrics: the last row of the history, "end" and "failure_time"; empty where the run was lost.
        end: "steady", "time", "steps", "failed: ..." (the flow broke down, which is a result) or "lost: ..." (there is
            no result; one of an exception has the number of "attempts" in its performance).
        performance: particles, steps and speed.
        history: at most 100 rows, the first and the last among them.
        profiles: along lines, at the end, where the case keeps any.
        versions: of the programs that computed it, where they said so.
        warnings: sentences on what is not resolved.
    """

    case: str
    settings: dict[str, Any]
    metrics: dict[str, Any]
    end: str
    performance: dict[str, Any] = field(default_factory=dict)
    history: list[dict[str, Any]] = field(default_factory=list)
    profiles: dict[str, list[float]] = field(default_factory=dict)
    versions: dict[str, str] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)

    @property
    def failed(self) -> bool:
        """True if the flow broke down."""
        return self.end.startswith("failed")

    @property
    def lost(self) -> bool:
        """True if there is no result, because a worker was killed or something unexpected happened."""
        return self.end.startswith("lost")

    @property
    def attempts(self) -> int:
        """The number of times that a run that is lost ended with an exception."""
        said = self.performance.get("attempts") if self.lost else 0
        return said if isinstance(said, int) else 0

    def as_dict(self) -> dict[str, Any]:
        """All of it, as it is stored."""
        return {key: value for key, value in asdict(self).items() if value or key not in OPTIONAL}


def of_record(record: Any) -> SweepResult | None:
    """The result that a record holds, as it was stored or came from a worker; None if it is not whole."""
    whole = finite(record)
    if shape_fault(whole):
        return None
    return SweepResult(**{part.name: whole[part.name] for part in fields(SweepResult) if part.name in whole})


def lost(run: Run, reason: str, attempts: int = 0) -> SweepResult:
    """Stand for a run without a result.

    Args:
        run: which.
        reason: in a few words.
        attempts: how often it ended with an exception; 0 where it was killed, which says nothing of the run itself.
    """
    end = f"lost: {reason}"
    metrics: dict[str, Any] = {"time": None, "end": end} if attempts else {}
    return SweepResult(run.case, run.given, metrics, end, {"attempts": attempts} if attempts else {})


def record(run: CaseRun) -> dict[str, Any]:
    """The result to keep of a run that has ended."""
    rows, last = run.history, len(run.history) - 1
    kept = sorted({round(number * last / (HISTORY - 1)) for number in range(HISTORY)})
    whole: dict[str, Any] = finite({**run.as_dict(), "end": run.end, "history": [rows[number] for number in kept]})
    return whole
