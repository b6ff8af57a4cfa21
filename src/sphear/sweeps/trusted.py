"""Stored results: whether one is whole, and the result of its run, before it is believed."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sphear.sweeps.plan import Run

FORMAT = 1  # of stored results; files that do not say are of the first
ENDS = ("steady", "time", "steps")
SHOWN = 60  # letters of what is refused
_PARTS = {"case": str, "settings": dict, "metrics": dict, "end": str, "performance": dict, "history": list}
_MAY = {"warnings", "profiles", "format", "versions"}


def shape_fault(record: Any) -> str | None:
    """The fault of a record whatever run it is of, a part that lacks or is of another type; None where it is whole."""
    if not isinstance(record, dict):
        return "it is no result"
    if set(record) - _MAY != set(_PARTS):
        return "it has not the parts of a result"
    if record.get("format", FORMAT) != FORMAT:
        return f"its format is {_short(record['format'])}, and this sphear writes {FORMAT}"
    for name, kind in _PARTS.items():
        if not isinstance(record[name], kind):
            return f"its {name} is no {kind.__name__}"
    numbers = {key: value for key, value in record["metrics"].items() if key not in ("end", "reference_missing")}
    if fault := _not_numbers("metrics", numbers):
        return fault
    if not all(value is None or isinstance(value, str | int | float) for value in record["performance"].values()):
        return "its performance has more than numbers"
    for row in record["history"]:
        if not isinstance(row, dict):
            return "its history has more than rows"
        if fault := _not_numbers("history", row):
            return fault
    profiles = record.get("profiles", {})
    if not isinstance(profiles, dict) or not all(isinstance(values, list) for values in profiles.values()):
        return "its profiles are no lists"
    versions = record.get("versions", {})
    if not isinstance(versions, dict) or not all(isinstance(text, str) for text in versions.values()):
        return "its versions are no text"
    warnings = record.get("warnings", [])
    if not isinstance(warnings, list) or not all(isinstance(text, str) for text in warnings):
        return "its warnings are no text"
    for name, values in profiles.items():
        if fault := _not_numbers(f"profile {_short(name)}", dict(enumerate(values))):
            return fault
    return None


def fault(record: Any, run: Run) -> str | None:
    """The reason in a few words why a stored record is not the result of a run; None where it is.

    Args:
        record: as JSON has it.
        run: whose result it should be.
    """
    if wrong := shape_fault(record):
        return wrong
    if record["case"] != run.case:
        return f"it is of {_short(record['case'])}"
    if wrong := _other_settings(record["settings"], run):
        return wrong
    end, metrics = record["end"], record["metrics"]
    if metrics.get("end") != end:
        return "its end and that of its metrics differ"
    if not {"time", "end"} <= metrics.keys():
        return "its metrics lack the time"
    if end.startswith("lost: "):
        return None
    if not (end in (*ENDS, *_own_ends(run)) or end.startswith("failed: ")):
        return f"its end is {_short(end)}"
    return None


def _other_settings(stored: Mapping[str, Any], run: Run) -> str | None:
    """A setting that is not the run's: one resolved is compared where the run chose it."""
    from sphear.sweeps.plan import IMMATERIAL, usual

    for name, wanted in run.given.items():
        if name in IMMATERIAL:
            continue
        value = stored.get(name, usual(type(run.settings))[name])  # a setting that is newer than the result
        if wanted is None:  # resolved, to what follows from the others
            if isinstance(value, bool) or not isinstance(value, str | int | float | None):
                return f"its {name} is {_short(value)}"
        elif not _same(value, wanted):
            return f"its {name} is {_short(value)}, not {_short(wanted)}"
    return None


def _same(stored: Any, wanted: Any) -> bool:
    if isinstance(stored, bool) or isinstance(wanted, bool) or isinstance(stored, str) or isinstance(wanted, str):
        return type(stored) is type(wanted) and bool(stored == wanted)
    try:
        return math.isclose(stored, wanted, rel_tol=1e-9)  # h over dx goes through h and back
    except (TypeError, OverflowError):
        return False


def _not_numbers(what: str, values: Mapping[Any, Any]) -> str | None:
    """The first that is no finite number, and not None, which stands for those that are not finite."""
    for name, value in values.items():
        right = value is None or (isinstance(value, int | float) and not isinstance(value, bool))
        if not right or (isinstance(value, float) and not math.isfinite(value)):
            return f"the {_short(name)} of its {what} is {_short(value)}"
    return None


def _own_ends(run: Run) -> tuple[str, ...]:
    from sphear.cases.flow import FLOWS

    return FLOWS[run.case].ends


def _short(value: Any) -> str:
    """A value in a few letters; what is nested is not written out."""
    if isinstance(value, list | dict):
        return "a list" if isinstance(value, list) else "a mapping"
    text = " ".join(str(value).split()) or "nothing"
    return text if len(text) <= SHOWN else f"{text[: SHOWN - 3]}..."
