"""Long studies: the protocol they follow, and that quick ones compute what is then presented."""

from __future__ import annotations

import inspect
import json
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sphear import studies
from sphear.progress import no_progress
from sphear.results import OutputFolder
from sphear.studies.basa2009 import figure_5, figure_8, figure_9, figure_10
from sphear.studies.basa2009.robustness import BEST_REYNOLDS
from sphear.studies.kept import LongStudy, ShortStudy, as_text, kept
from sphear.sweeps import plan

ITEMS = [(paper, item) for paper, named in studies.ITEMS.items() for item in named]
LONG = [(paper, item) for paper, item in ITEMS if studies.is_long(studies.study_of(paper, item))]


def signature(function: Any) -> list[tuple[str, Any, Any]]:
    """Name, kind and default of each parameter but the object itself."""
    parameters = inspect.signature(function).parameters.values()
    return [(each.name, each.kind, each.default) for each in parameters if each.name != "self"]


@pytest.mark.parametrize(("paper", "item"), LONG)
def test_a_long_study_is_called_as_the_protocol_says(paper: str, item: str) -> None:
    study = studies.study_of(paper, item)
    assert studies.is_long(study)
    assert signature(study.compute) == signature(LongStudy.compute)
    assert signature(study.present) == signature(LongStudy.present)


@pytest.mark.parametrize(("paper", "item"), sorted(set(ITEMS) - set(LONG)))
def test_a_short_study_runs_at_once(paper: str, item: str) -> None:
    study = studies.study_of(paper, item)
    assert not studies.is_long(study)
    assert signature(study.run) == signature(ShortStudy.run)


def test_items_of_one_module_are_its_studies_by_their_numbers() -> None:
    for paper, modules in studies.TOGETHER.items():
        for module, together in modules.items():
            found = import_module(f"sphear.studies.{paper}.{module}").STUDIES
            assert tuple(found) == together
            assert [f"figure-{study.number}" for study in found.values()] == list(together)
            assert set(together) <= set(studies.ITEMS[paper])


def test_the_figures_of_the_channel_and_the_cavity_are_long() -> None:
    assert {item for paper, item in LONG if paper == "basa2009"} >= {"figure-5", "figure-8", "figure-9", "figure-10"}


ENTRIES = st.dictionaries(st.text(), st.none() | st.integers() | st.floats(allow_nan=False, allow_infinity=False))
KEPT = st.dictionaries(st.text(), ENTRIES | st.lists(ENTRIES) | st.lists(st.integers()) | st.text(), min_size=1)


@given(KEPT)
def test_what_is_kept_comes_back(data: dict[str, Any]) -> None:
    assert json.loads(as_text(data)) == data


def test_an_unknown_item_is_named_with_the_nearest() -> None:
    with pytest.raises(ValueError, match="no item of basa2009 named 'figure-55': did you mean figure-5"):
        studies.reproduce("basa2009", "figure-55")


def test_the_channels_are_computed_and_presented(own_store: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    short: dict[str, Any] = {"resolution": 10, "until": 0.05}
    over = {"viscosity": ("violeau", "morris"), "reynolds": (0.3, 0.5)}
    monkeypatch.setattr(figure_5, "runs", lambda quick: plan("poiseuille", over, short, preset="basa2009"))
    monkeypatch.setattr(
        figure_5, "best_runs", lambda quick: plan("poiseuille", {"reynolds": (0.5,)}, short, preset="basa2009")
    )
    told: list[str] = []
    data = figure_5.compute(quick=True, workers=1, progress=told.append)
    assert told
    assert [(row["viscosity"], row["reynolds"], row["end"]) for row in data["runs"]] == [
        ("violeau", 0.3, "time"), ("violeau", 0.5, "time"), ("morris", 0.3, "time"), ("morris", 0.5, "time"),
    ]  # fmt: skip
    assert ["history" in row for row in data["runs"]] == [False, True, False, True]
    assert (data["settings"]["resolution"], data["settings"]["initial"]) == (10, "lattice")
    assert not {"until", "viscosity", "reynolds", "threads"} & set(data["settings"])
    assert json.loads(as_text(data)) == data
    again: list[str] = []
    assert figure_5.compute(quick=True, workers=1, progress=again.append) == data  # the runs are kept
    assert len(list(own_store.rglob("*.json"))) == 4  # that of the best settings is one of the others here
    assert figure_5.present(data).agrees == "partly"


def test_the_best_channels_reach_the_steady_state_at_every_reynolds_number() -> None:
    data = kept("basa2009", "figure-5")
    assert {row["reynolds"]: row["end"] for row in data["best"]} == dict.fromkeys(BEST_REYNOLDS, "steady")
    assert max(BEST_REYNOLDS) == 1000
    assert max(row["rms_error"] for row in data["best"]) < 2e-4
    assert (data["best_settings"]["resolution"], data["best_settings"]["wall_divergence"]) == (20, "continued")


def test_no_best_channel_that_reached_the_steady_state_is_said() -> None:
    data = kept("basa2009", "figure-5")
    lost = [{**row, "end": "failed: so"} for row in data["runs"][:1]]
    assert "up to Re = 0, errors at most failed" in figure_5.present({**data, "best": lost}).finding


def test_the_cavity_is_computed_and_presented_by_both_of_its_figures(own_store: Path) -> None:
    data = figure_9.compute(quick=True, workers=1, progress=no_progress)
    (row,) = data["runs"]
    assert (row["viscosity"], row["reynolds"], row["end"]) == ("morris", 100.0, "time")
    assert row["time"] == pytest.approx(2.0, rel=1e-2)
    assert -0.3 < row["kinetic_energy_error"] < 0.1
    assert {name: len(values) for name, values in row["profiles"].items()} == {"stations": 64, "u": 64, "v": 64}
    assert row["energy"][0][1] < row["energy"][-1][1] == pytest.approx(row["kinetic_energy"], rel=1e-4)
    assert json.loads(as_text(data)) == data
    assert figure_10.compute(quick=True, workers=1, progress=no_progress) == data  # the run is kept
    folder = OutputFolder(own_store / "figures")
    for figure in (figure_9, figure_10):
        result = figure.present(data)
        assert result.agrees == "partly"
        for name, draw in result.figures.items():
            folder.write_figure(name, draw())
    assert [path.name for path in folder.files] == [
        "figure-9.png", "figure-9.svg", "figure-10.png", "figure-10.svg",
    ]  # fmt: skip


def test_the_vortex_below_the_lid_is_found_soon_after_the_start() -> None:
    data = figure_8.compute(quick=True, workers=1, progress=no_progress)
    assert json.loads(as_text(data)) == data
    (row,) = figure_8.present(data).rows
    assert (row["end"], row["time"]) == ("time", pytest.approx(1.0, rel=1e-2))
    # it starts below the lid in the corner that the lid moves to, and turns about a point in the upper half
    assert 0.5 < row["y"] < 1
    assert 0.5 < row["x"] < 1


@pytest.mark.parametrize("item", ["figure-5", "figure-8", "figure-9", "figure-10"])
def test_kept_numbers_are_presented_and_drawn(item: str, tmp_path: Path) -> None:
    """Warnings are errors in all tests."""
    result = studies.reproduce("basa2009", item)
    assert result.rows
    assert result.tables
    folder = OutputFolder(tmp_path)
    for name, draw in result.figures.items():
        folder.write_figure(name, draw())
    assert min(path.stat().st_size for path in folder.files) > 10_000
