"""Figures 5 and 8 to 10 and the findings: what is made of results, here of ones made up by hand."""

from __future__ import annotations

import json
import math
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sphear.errors import SphearError
from sphear.references.cavity import mac
from sphear.results import OutputFolder
from sphear.studies import ITEMS
from sphear.studies.basa2009 import figure_5, figure_8, figure_9, figure_10, robustness_results
from sphear.studies.basa2009.robustness import TERMS
from sphear.studies.kept import as_text, kept
from sphear.studies.result import StudyResult
from sphear.sweeps import SweepResult

Row = dict[str, Any]


def drawn(result: StudyResult, folder: Path) -> None:
    files = OutputFolder(folder)
    for name, draw in result.figures.items():
        files.write_figure(name, draw())
    assert files.files
    assert min(path.stat().st_size for path in files.files) > 5000


@pytest.mark.parametrize("item", ITEMS["basa2009"])
def test_every_item_can_be_run_or_computed_and_presented(item: str) -> None:
    module = import_module(f"sphear.studies.basa2009.{item.replace('-', '_')}")
    assert callable(getattr(module, "run", None)) != callable(getattr(module, "compute", None))
    assert callable(getattr(module, "present", None)) == hasattr(module, "compute")


@pytest.mark.parametrize(("paper", "item"), [("basa2009", "figure-99"), ("zheng2018", "table-1")])
def test_what_is_not_kept_is_said_in_a_sentence(paper: str, item: str) -> None:
    with pytest.raises(SphearError, match=f"^no results of {paper} {item} are kept: compute them with --rerun$"):
        kept(paper, item)


def test_kept_text_is_json_with_a_line_an_entry() -> None:
    data = {"settings": {"a": [1, 2]}, "runs": [{"x": 1.5}, {"x": None}], "empty": [], "text": "é \"'\n"}
    text = as_text(data)
    assert json.loads(text) == data
    assert ' {"x": 1.5},\n  {"x": null}\n' in text


def test_what_is_not_finite_is_kept_as_nothing() -> None:
    assert json.loads(as_text({"runs": [{"x": math.nan}], "y": (math.inf, 1)})) == {
        "runs": [{"x": None}],
        "y": [None, 1],
    }


def channel(reynolds: float, end: str, history: list[tuple[float, float | None]], **settings: Any) -> SweepResult:
    chosen = {"equation_of_state": "batchelor_tait", "correction": "none", "viscosity": "morris", "resolution": 20}
    rows = [{"time": time, "steps": 10 * k, "rms_error": error} for k, (time, error) in enumerate(history, 1)]
    return SweepResult(
        "poiseuille", {**chosen, "reynolds": reynolds, "time_step": 1e-3, **settings}, rows[-1], end, {}, rows
    )


@pytest.mark.parametrize(
    ("history", "time"),
    [
        ([(1.0, 0.01), (2.0, 0.119), (3.0, 0.12), (4.0, 0.9)], 3.0),  # the paper's 12 %
        ([(1.0, 0.01), (2.0, None), (3.0, 5.0)], 2.0),  # no number
        ([(0.02, 0.2), (1.0, 0.01), (2.0, 0.3)], 2.0),  # the shear layer is not resolved at first
        ([(0.02, 0.6), (1.0, 0.7)], 0.02),  # but this is a breakdown
        ([(1.0, 0.01), (2.0, 0.02)], 2.0),  # failed otherwise
    ],
)
def test_a_run_has_failed_at_the_first_output_beyond_the_threshold(history: Any, time: float) -> None:
    (row,) = robustness_results.entries([channel(3.0, "failed: so", history)])["runs"]
    assert row["time"] == time


def test_a_run_that_did_not_fail_ends_with_its_last_output() -> None:
    found = robustness_results.entries([channel(0.5, "steady", [(1.0, 0.2), (27.7, 0.01)])])
    (row,) = found["runs"]
    assert (row["end"], row["time"], row["steps"], row["rms_error"]) == ("steady", 27.7, 20, 0.01)
    assert row["history"] == [[1.0, 0.2], [27.7, 0.01]]
    assert found["settings"] == {"resolution": 20}


def test_histories_are_kept_of_the_reynolds_number_whose_errors_are_drawn() -> None:
    (row,) = robustness_results.entries([channel(3.0, "steady", [(1.0, 0.2)])])["runs"]
    assert "history" not in row


@pytest.mark.parametrize(
    ("ends", "highest"),
    [
        ({0.1: "steady", 0.5: "steady", 1.0: "steady"}, 1.0),
        ({1.0: "failed: x", 0.1: "steady", 3.0: "steady"}, 0.1),
        ({0.1: "steady", 1.0: "steps"}, 0.1),
        ({0.1: "failed: x", 1.0: "steady"}, 0.0),
        ({}, 0.0),
    ],
)
def test_the_highest_steady_number_has_only_steady_ones_below(ends: dict[float, str], highest: float) -> None:
    assert (
        robustness_results.highest_steady([{"reynolds": number, "end": end} for number, end in ends.items()]) == highest
    )


def test_the_error_at_a_time_is_that_of_the_nearest_output_and_infinite_after_a_failure() -> None:
    row: Row = {"end": "steady", "time": 9.0, "history": [[1.0, 0.1], [4.8, 0.2], [9.0, None]]}
    assert robustness_results.error_at(row, 5.0) == 0.2
    assert robustness_results.error_at({**row, "end": "failed: x", "time": 4.9}, 5.0) == math.inf
    assert robustness_results.error_at({"end": "steady", "time": 9.0}, 5.0) == math.inf


# what the paper says: the Re up to which each term is steady uncorrected and with level 0, and its error at Re = 0.5
AS_THE_PAPER = {
    "takeda": (0.0, 3.0, 0.09), "two_pass": (0.5, 0.5, 0.02), "violeau": (3.0, 3.0, 0.06), "cleary": (3.0, 3.0, 0.03),
    "cleary_4.24": (3.0, 3.0, 0.01), "cleary_4.96333": (3.0, 3.0, 0.04), "morris": (3.0, 3.0, 0.02),
}  # fmt: skip


def robustness(changes: dict[str, tuple[float, float, float]]) -> Row:
    """As it would be kept."""
    results = []
    for term in TERMS:
        plain, zeroth, error = (AS_THE_PAPER | changes)[term]
        for correction, highest in (("none", plain), ("shepard", zeroth), ("bonet_lok", zeroth)):
            for reynolds in (0.5, 3.0):
                end, at = ("steady", 28.0) if reynolds <= highest else ("failed: so", 6.0)
                history: list[tuple[float, float | None]] = [(5.0, error), (at, error if end == "steady" else 0.5)]
                results.append(channel(reynolds, end, history, viscosity=term, correction=correction))
    return robustness_results.entries(results)


@pytest.mark.parametrize(
    ("changes", "verdict"),
    [
        ({}, "yes"),
        ({"takeda": (3.0, 3.0, 0.09)}, "partly"),
        ({"two_pass": (3.0, 3.0, 0.02), "morris": (0.5, 3.0, 0.02)}, "partly"),
        ({"violeau": (3.0, 3.0, 0.001)}, "partly"),
        ({"takeda": (3.0, 3.0, 0.09), "violeau": (0.0, 3.0, 0.001)}, "no"),
    ],
)
def test_figure_5_agrees_with_the_paper_as_far_as_the_numbers_do(changes: Any, verdict: str) -> None:
    assert figure_5.present(robustness(changes)).agrees == verdict


def test_figure_5_says_the_numbers_and_is_drawn(tmp_path: Path) -> None:
    data = robustness({})
    best = robustness_results.entries([channel(0.5, "steady", [(5.0, 0.001), (28.0, 0.0015)])])
    result = figure_5.present({**data, "best_settings": best["settings"], "best": best["runs"]})
    assert "takeda 0 (3)" in result.finding
    assert "violeau 6.00%" in result.finding
    assert "the best settings reach it up to Re = 0.5, errors at most 0.15%" in result.finding
    first = result.tables[0].rows
    assert [row["reynolds"] for row in first] == ["0.5", "3"]
    assert (first[0]["takeda"], first[1]["morris"]) == ("6", "steady 28")
    drawn(result, tmp_path)


def cavity(reynolds: float, term: str, off: float, energy: float = -0.05, end: str = "time", **more: Any) -> Row:
    y = np.linspace(0.1, 0.9, 9).tolist()
    metrics = {} if end.startswith("failed") else {"u_mean_deviation": off, "v_mean_deviation": off}
    return {
        "correction": "none", "viscosity": term, "reynolds": reynolds, "end": end, "time": 20.0, "steps": 10,
        "kinetic_energy": 0.03, "kinetic_energy_error": energy, "energy": [[0.0, 0.0], [20.0, 0.03]],
        "profiles": {"stations": y, "u": y, "v": y}, **metrics, **more,
    }  # fmt: skip


def test_the_energy_is_under_predicted_if_it_is_so_at_the_higher_number() -> None:
    low, high = cavity(100.0, "morris", 0.01), cavity(1000.0, "morris", 0.01)
    assert figure_9.present({"runs": [low, high]}).agrees == "yes"
    assert figure_9.present({"runs": [low, {**high, "kinetic_energy_error": 0.01}]}).agrees == "partly"
    assert figure_9.present({"runs": [low]}).agrees == "partly"


WHOLE = {"takeda": -0.3, "violeau": -0.25, "cleary_4.24": -0.2, "morris": -0.28}


@pytest.mark.parametrize(
    ("term", "changes", "broken"),
    [
        ("takeda", {"kinetic_energy_error": -0.1}, "and than A"),
        ("violeau", {"kinetic_energy_error": -0.1}, "D is closer there than C and E"),
        ("takeda", {"end": "failed: so"}, "A is stable when corrected"),
        ("two_pass", {"end": "time", "kinetic_energy_error": -0.9}, "B fails there when corrected"),
        ("violeau", {"energy": [[0.0, 0.0], [40.0, 0.1], [80.0, 0.03]]}, "E has the largest spikes"),
        ("morris", {"kinetic_energy_error": 0.5}, "all under-predict at Re = 1000"),
    ],
)
def test_each_part_of_the_claim_about_energies_is_judged(term: str, changes: dict[str, Any], broken: str) -> None:
    rows = [
        {
            **cavity(1000.0, name, 0.01, energy),
            "correction": "shepard",
            "energy": [[0.0, 0.0], [40.0, 0.02], [80.0, 0.03]],
        }
        for name, energy in WHOLE.items()
    ]
    rows[-1]["energy"] = [[0.0, 0.0], [40.0, 0.05], [80.0, 0.03]]
    rows.append({**cavity(1000.0, "two_pass", 0.0, end="failed: so"), "correction": "shepard"})
    held, agrees = figure_9.judged(rows)
    assert (all(held.values()), len(held), agrees) == (True, 6, "yes")
    held, agrees = figure_9.judged([{**row, **changes} if row["viscosity"] == term else row for row in rows])
    assert (held[broken], agrees) == (False, "partly")


@pytest.mark.parametrize(("error", "verdict"), [(-0.1, "yes"), (0.1, "no")])
def test_the_energies_are_told_from_the_least_to_the_most(error: float, verdict: str) -> None:
    rows = [cavity(1000.0, "morris", 0.01, -0.2), cavity(1000.0, "takeda", 0.01, error)]
    lost = cavity(1000.0, "two_pass", 0.0, end="failed: so")
    said, agrees = figure_9.under_predicted([*rows, lost])
    assert said == (
        f"at t = 80 from -20.0% (morris, no correction) to {error:+.1%} (takeda, no correction); failed before: 1"
    )
    assert agrees == verdict
    assert figure_9.under_predicted([lost])[1] == "partly"


def test_the_best_term_is_the_one_with_the_least_deviation_at_both_numbers() -> None:
    rows = [
        cavity(number, term, off)
        for number in (100.0, 1000.0)
        for term, off in (("morris", 0.02), ("cleary_4.24", 0.01))
    ]
    assert figure_10.present({"runs": rows}).agrees == "yes"
    rows[-1] = cavity(1000.0, "cleary_4.24", 0.03)
    result = figure_10.present({"runs": rows})
    assert result.agrees == "partly"
    assert "morris (no correction) 0.0200, cleary_4.24 (no correction) 0.0300" in result.finding


@pytest.mark.parametrize("figure", [figure_9, figure_10])
def test_a_failed_run_is_named_and_the_figure_drawn(figure: Any, tmp_path: Path) -> None:
    lost = cavity(1000.0, "two_pass", 0.0, end="failed: so", time=3.0, profiles={})
    result = figure.present({"runs": [cavity(100.0, "morris", 0.01), cavity(1000.0, "morris", 0.01), lost]})
    assert "two_pass" in result.finding
    assert "failed at t = 3" in [row["end"] for row in result.tables[0].rows]
    drawn(result, tmp_path)


def vortex(x: float, y: float, end: str = "time") -> Row:
    """Particles that turn about a point as a solid body."""
    ticks = (np.arange(20) + 0.5) / 20
    positions = np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 2)
    velocities = np.stack((positions[:, 1] - y, x - positions[:, 0]), axis=1)
    return {
        "reynolds": 100.0,
        "time": 20.0,
        "end": end,
        "positions": positions.tolist(),
        "velocities": velocities.tolist(),
    }


@pytest.mark.parametrize(
    ("x", "y", "end", "verdict"),
    [(0.62, 0.73, "time", "yes"), (0.5, 0.5, "time", "partly"), (0.62, 0.73, "failed: so", "no")],
)
def test_the_centre_of_a_vortex_is_found_and_judged(x: float, y: float, end: str, verdict: str, tmp_path: Path) -> None:
    result = figure_8.present({"runs": [vortex(x, y, end)]})
    assert (result.rows[0]["x"], result.rows[0]["y"]) == pytest.approx((x, y))
    assert result.agrees == verdict
    drawn(result, tmp_path)


def findings(monkeypatch: pytest.MonkeyPatch, **runs: list[Row]) -> StudyResult:
    """With the kept channel of figure 5 and the cavity made up, the other items as they are kept."""
    module = import_module("sphear.studies.basa2009.findings")
    made = {"figure-5": robustness({}), "figure-9": {"runs": runs["cavity"]}}
    monkeypatch.setattr(module, "kept", lambda paper, item: made[item] if item in made else kept(paper, item))
    result = module.run(quick=False, progress=lambda text: None)
    assert isinstance(result, StudyResult)
    return result


@pytest.mark.parametrize(("off", "verdict"), [((0.01, 0.01), "yes"), ((0.01, 0.05), "partly"), ((0.05, 0.05), "no")])
def test_the_findings_follow_the_numbers(
    off: tuple[float, float], verdict: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    rows = [cavity(number, "morris", 0.02) for number in (100.0, 1000.0)]
    rows += [cavity(number, "cleary_4.24", least) for number, least in zip((100.0, 1000.0), off, strict=True)]
    result = findings(monkeypatch, cavity=rows)
    assert len(result.rows) == 10
    assert result.rows[-1]["agrees"] == verdict
    assert result.rows[0]["agrees"] == "yes"  # model A is cured by level 0


def test_the_reference_of_the_cavity_has_the_times_that_are_compared() -> None:
    assert (mac(100).time, mac(1000).time) == (20, 80)
