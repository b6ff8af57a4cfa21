"""The result of a study: the numbers, what the paper claims of them and what was found."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

from sphear.versions import versions

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from sphear.results.table import Table

Progress = Callable[[str], None]
Agreement = Literal["yes", "partly", "no"]


@dataclass(frozen=True)
class StudyResult:
    """One table or figure of a paper, computed again.

    Attributes:
        claim: what the paper says, in one sentence.
        finding: what was found, in one sentence, with its numbers.
        agrees: whether the finding supports the claim.
        rows: the numbers.
        tables: how they are shown.
        figures: how they are drawn, by file name; called only when a figure is wanted.
        other_readings: rows of the same kind for other readings of an unclear definition.
    """

    claim: str
    finding: str
    agrees: Agreement
    rows: list[dict[str, Any]]
    tables: list[Table]
    figures: Mapping[str, Callable[[], Figure]] = field(default_factory=dict)
    other_readings: list[dict[str, Any]] = field(default_factory=list)

    def as_dict(self, study: str, item: str) -> dict[str, Any]:
        """The object that `--json` prints."""
        result: dict[str, Any] = {"study": study, "item": item, "versions": versions(), "rows": self.rows}
        if self.other_readings:
            result["other_readings"] = self.other_readings
        return {**result, "claim": self.claim, "finding": self.finding, "agrees": self.agrees}
