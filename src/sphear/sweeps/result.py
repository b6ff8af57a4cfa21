"""What is kept of a run: its end, its metrics and a history that is short enough to keep."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any

from sphear.results.finite import finite

if TYPE_CHECKING:
    from sphear.cases.flow import FlowRun
    from sphear.sweeps.plan import Run

HISTORY = 100  # rows at most
OPTIONAL = {"profiles", "versions"}  # what a record may lack


@dataclass(frozen=True)
class SweepResult:
    """The result of one run of a sweep; numbers that are not finite are None.

    Attributes:
        case: name of the flow.
        settings: resolved.
        metrics: the last row of the history, "end" and "failure_time"; empty where the run was lost.
        end: "steady", "time", "steps", "failed: ..." (the flow broke down, which is a result) or "lost: ..." (there is
            no result).
        performance: particles, steps and speed.
        history: at most 100 rows, the first and the last among them.
        profiles: along lines, at the end, where the case keeps any.
        versions: of the programs that computed it, where they said so.
    """

    case: str
    settings: dict[str, Any]
    metrics: dict[str, Any]
    end: str
    performance: dict[str, Any] = field(default_factory=dict)
    history: list[dict[str, Any]] = field(default_factory=list)
    profiles: dict[str, list[float]] = field(default_factory=dict)
    versions: dict[str, str] = field(default_factory=dict)

    @property
    def failed(self) -> bool:
        """Whether the flow broke down."""
        return self.end.startswith("failed")

    @property
    def lost(self) -> bool:
        """Whether there is no result, because a worker was killed or something unexpected happened."""
        return self.end.startswith("lost")

    def as_dict(self) -> dict[str, Any]:
        """All of it, as it is stored."""
        return {key: value for key, value in asdict(self).items() if value or key not in OPTIONAL}


def of_record(record: Any) -> SweepResult | None:
    """The result that a record holds, as it was stored or came from a worker; None if it is not whole."""
    kinds = {"case": str, "settings": dict, "metrics": dict, "end": str, "performance": dict, "history": list}
    if not isinstance(record, dict) or set(record) - OPTIONAL != set(kinds):
        return None
    if not all(isinstance(record[key], kind) for key, kind in kinds.items()):
        return None
    return SweepResult(**finite(record))


def lost(run: Run, reason: str) -> SweepResult:
    """What stands for a run without a result."""
    return SweepResult(run.case, run.given, {}, f"lost: {reason}")


def record(run: FlowRun) -> dict[str, Any]:
    """What is kept of a run that has ended."""
    rows, last = run.history, len(run.history) - 1
    kept = sorted({round(number * last / (HISTORY - 1)) for number in range(HISTORY)})
    whole: dict[str, Any] = finite({**run.as_dict(), "end": run.end, "history": [rows[number] for number in kept]})
    return whole
