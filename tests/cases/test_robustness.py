"""Where default flows hold: the kept map, and a small one that is drawn here."""

from __future__ import annotations

import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

import pytest

from sphear.cases.flow import run as flow_run
from sphear.schemes.watch import CREATED, LARGE_CELL

PATH = Path(__file__).parents[2] / "validation" / "robustness.py"
SPEC = spec_from_file_location("robustness", PATH)
assert SPEC is not None
assert SPEC.loader is not None
robustness = module_from_spec(SPEC)
sys.modules["robustness"] = robustness
SPEC.loader.exec_module(robustness)

KEPT: dict[str, Any] = robustness.known()
BY_DEFAULT = {name: row for name, row in KEPT.items() if " default " in name}
FAILED = {name: row for name, row in KEPT.items() if row["end"].startswith("failed")}


def test_the_map_is_whole() -> None:
    missing = [one for one in robustness.wanted("") if f"{one[0]} {one[1]} {one[2]:g}" not in KEPT]
    assert not missing
    assert not [name for name, row in KEPT.items() if row["end"].startswith("refused")]


def test_no_default_run_fails_below_a_cell_reynolds_number_of_50() -> None:
    assert min(BY_DEFAULT[name]["cell_reynolds"] for name in FAILED if name in BY_DEFAULT) > LARGE_CELL


def test_whatever_fails_by_default_was_told_beforehand() -> None:
    assert not [name for name in FAILED if name in BY_DEFAULT and not BY_DEFAULT[name]["unresolved"]]


def test_nothing_that_ended_well_had_made_energy_or_speed() -> None:
    for name, row in KEPT.items():
        if name not in FAILED:
            assert row["largest_created"] <= CREATED, name
            assert row["speed"] < 1.25, name


@pytest.mark.parametrize("reynolds", [1e-3, 1.0, 100.0, 1e5])
@pytest.mark.parametrize("kind", [kind for kind in robustness.KINDS if kind.endswith("default")])
def test_a_small_map(kind: str, reynolds: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """With 13 particles a side, for as long as a test takes."""
    monkeypatch.setattr(flow_run, "OUTPUTS", flow_run.OUTPUTS)  # the map has its own, which must not stay
    monkeypatch.setattr(robustness, "STEPS", {"explicit": 300, "incompressible": 25})
    row = robustness.run(kind, 13, reynolds)
    assert not row["end"].startswith(("failed", "refused")) or row["unresolved"], row
    assert row["end"].startswith("failed") or row["largest_created"] <= CREATED
