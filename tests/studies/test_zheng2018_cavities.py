"""Figures 7 to 14 of Zheng, Ma & Shao 2018: what is kept of the cavities, and what is said of it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sphear.cases.flow import FLOWS, CaseRun
from sphear.errors import SphearError
from sphear.references.cavity import cavity_cylinder, ghia, mac
from sphear.results import OutputFolder
from sphear.studies import is_long, study_of
from sphear.studies.kept import as_text, kept, store
from sphear.studies.result import StudyResult
from sphear.studies.zheng2018 import cavities
from sphear.studies.zheng2018.cavities import CASES, SIZES, TERMS, Study, Wanted, compute_run, selected, wanted
from sphear.studies.zheng2018.cavity_errors import falling, leads, limit, order
from sphear.studies.zheng2018.cavity_rows import curves, data_of, deviations, identity, least, merged, scores
from sphear.studies.zheng2018.cavity_shown import FOUR, capped, lacking, listed
from sphear.sweeps.sweep import SweepWarning

ITEMS = {f"figure-{number}": CASES[number > 10] for number in range(7, 15)}
STATIONS = {"cavity": np.linspace(0, 1, 66)[1:-1]}
STATIONS["cavity-cylinder"] = STATIONS["cavity"][abs(STATIONS["cavity"] - 0.5) > 0.25]


def present(item: str, data: dict[str, Any]) -> StudyResult:
    study = study_of("zheng2018", item)
    assert is_long(study)
    return study.present(data)


def made_up(case: str, term: str, size: int, error: float, end: str = "time") -> dict[str, Any]:
    """A run whose profiles are those of the reference times 1 - error."""
    flow = mac(1000, 40) if case == "cavity" else cavity_cylinder()
    at = STATIONS[case].tolist()
    lines = {"stations": at} if case == "cavity" else {"x": at, "y": at}
    values = {name: ((1 - error) * curve.at(at)).tolist() for name, curve in (("u", flow.u), ("v", flow.v))}
    row = {
        "preset": "defaults", "reynolds": 1000.0, "resolution": size, "viscosity": term, "until": 40.0, "end": end,
        "time": 40.0 if end == "time" else 3.0, "steps": 100 * size, "seconds": 1.0, "particles": size**2,
        "kinetic_energy": 0.04, "kinetic_energy_error": -error, "iterations_mean": 3.0,
        "energy": [[0.4, 0.01], [40.0, 0.04]],
        "watched": {
            "time": [40.0], "pressure_iterations": [3.0], "divergence": [0.1], "density_deviation": [0.01],
            "smallest_distance": [0.6], "largest_gap": [0.8],
        },
        "profiles": {**lines, **values} if end == "time" else {},
    }  # fmt: skip
    if term == "oger" and end == "time":
        row |= {"field_u": [0.1] * 1600, "field_v": [0.0] * 1600}
    return row | scores(case, row)


def data(case: str, factors: dict[str, float], sizes: tuple[int, ...] = SIZES) -> dict[str, Any]:
    """Runs of terms whose errors are a factor over the number of particles a side."""
    rows = [made_up(case, term, size, factor / size) for size in sizes for term, factor in factors.items()]
    return {**data_of(case, {}), "runs": rows}


ALIKE = dict.fromkeys(TERMS, 1.0)


def test_ghia_is_no_limit_of_a_converging_method() -> None:
    """Its Err tends to the difference of the true least u at t = 40 and that of the table."""
    assert limit("cavity") == pytest.approx(0.0044, abs=5e-5)
    assert least(mac(1000, 40).u) == pytest.approx(-0.38726, abs=1e-5)
    assert ghia(1000).u.values.min() == -0.38289
    assert limit("cavity-cylinder") == pytest.approx(
        least(cavity_cylinder(extrapolated=False).u) - least(cavity_cylinder().u)
    )


@pytest.mark.parametrize("case", CASES)
def test_the_reference_itself_has_no_error_but_the_papers(case: str) -> None:
    row = made_up(case, "oger", 100, 0.0)
    assert abs(row["u_min_error"]) < 2e-5
    assert row["deviation"] < 1e-6
    assert row["paper_err"] == pytest.approx(limit(case), abs=2e-5)


@pytest.mark.parametrize("case", CASES)
def test_deviations_are_those_put_in(case: str) -> None:
    row, known = made_up(case, "oger", 100, 0.1), mac(1000, 40) if case == "cavity" else cavity_cylinder()
    means = [float(abs(0.1 * curve.at(STATIONS[case])).mean()) for curve in (known.u, known.v)]
    assert (row["u_deviation"], row["v_deviation"]) == pytest.approx(means, rel=1e-4)
    assert row["deviation"] == pytest.approx(np.mean(means), rel=1e-4)
    assert row["u_min_error"] == pytest.approx(-0.1 * least(known.u), rel=2e-3)


def test_tables_are_compared_at_their_own_stations() -> None:
    off = deviations(curves("cavity", made_up("cavity", "oger", 100, 0.0))["u"], ghia(1000).u)
    assert len(off) == 15
    assert 0.001 < off.mean() < 0.006


def test_a_run_that_ends_at_another_time_is_not_compared() -> None:
    row = {**made_up("cavity", "oger", 20, 0.1), "time": 4.0}
    assert set(scores("cavity", row)) == {"u_min"}


def test_errors_fall_and_have_an_order() -> None:
    points = [(40, 0.4), (80, 0.1), (160, 0.025)]
    assert falling(points)
    assert not falling([*points, (200, 0.025)])
    assert order(points) == pytest.approx(2.0)


def test_who_leads() -> None:
    each = {term: [(40, 1.0 + k), (80, 1.0 + k)] for k, term in enumerate(FOUR)}
    assert leads(each) == (0, 2)
    assert leads({**each, "oger": [(40, 0.5), (80, 2.0)], "fatehi_manzari": [(40, 0.1)]}) == (1, 2)
    assert leads({"oger": [(40, 1.0)]}) == (0, 0)


@pytest.mark.parametrize(("item", "case"), ITEMS.items())
def test_nothing_computed_is_said_and_drawn(item: str, case: str, tmp_path: Path) -> None:
    result = present(item, data_of(case, {}))
    assert "not computed" in result.finding
    assert result.agrees == "partly"
    folder = OutputFolder(tmp_path)
    for name, draw in result.figures.items():
        folder.write_figure(name, draw())
    assert [path.name for path in folder.files] == [f"{item}.png", f"{item}.svg"]


@pytest.mark.parametrize(("item", "case"), ITEMS.items())
def test_what_was_computed_is_shown_with_what_was_not(item: str, case: str, tmp_path: Path) -> None:
    some = data(case, dict.fromkeys(("morris", "oger"), 1.0), (40, 100))
    some["runs"].append(made_up(case, "gotoh", 40, 0.0, "failed: so"))
    result = present(item, some)
    assert result.agrees in ("partly", "yes" if item in ("figure-8", "figure-12") else "partly")
    if item[-2:] in ("-9", "10", "13", "14"):
        assert "not computed: 80, 160 and 200 particles a side" in result.finding
        assert "not computed at 40: schwaiger and fatehi_manzari" in result.finding
        assert "failed: gotoh at 40 (t = 3)" in result.finding
    folder = OutputFolder(tmp_path)
    for name, draw in result.figures.items():
        folder.write_figure(name, draw())
    assert min(path.stat().st_size for path in folder.files) > 10_000


@pytest.mark.parametrize("item", ["figure-9", "figure-13", "figure-10", "figure-14"])
@pytest.mark.parametrize(
    ("factors", "agrees"),
    [
        ({**ALIKE, "oger": 0.5}, ("yes", "yes")),
        ({**ALIKE, "oger": 1.02}, ("partly", "partly")),
        ({**ALIKE, "oger": 2.0}, ("no", "partly")),
    ],
)
def test_the_verdict_follows_the_numbers(item: str, factors: dict[str, float], agrees: tuple[str, str]) -> None:
    """Of the profiles who is the nearest; of the errors also whether they fall, which they do here."""
    result = present(item, data(ITEMS[item], factors))
    assert result.agrees == agrees[item in ("figure-10", "figure-14")]


@pytest.mark.parametrize("item", ["figure-10", "figure-14"])
def test_errors_that_grow_contradict(item: str) -> None:
    growing = data(ITEMS[item], {})
    growing["runs"] = [
        made_up(ITEMS[item], term, size, (2.0 if term == "oger" else 1.0) * size / 4000)
        for size in SIZES
        for term in TERMS
    ]
    result = present(item, growing)
    assert result.agrees == "no"
    assert "falls with every refinement for no term" in result.finding
    assert "oger has the least of the paper's four at 0 of 5 sizes" in result.finding


@pytest.mark.parametrize("case", CASES)
def test_sentences_give_the_numbers_of_the_rows(case: str) -> None:
    whole = data(case, {**ALIKE, "oger": 0.5})
    profiles, errors = (item for item, its in ITEMS.items() if its == case and item[-2:] in ("-9", "10", "13", "14"))
    last = [row for row in whole["runs"] if row["resolution"] == 200]
    for row in last:
        assert f"{row['viscosity']} {row['deviation']:.4f}" in present(profiles, whole).finding
        assert f"{row['viscosity']} {row['paper_err']:.4f} (200)" in present(errors, whole).finding
    assert f"which tends to {limit(case):.4f} and not to 0" in present(errors, whole).finding
    assert "of the paper's four oger is the nearest" in present(profiles, whole).finding


def test_unfinished_work_confirms_nothing_whole() -> None:
    assert capped("yes", data("cavity", ALIKE, (40, 80))) == "partly"
    assert capped("yes", data("cavity", ALIKE)) == "yes"
    assert capped("no", data("cavity", ALIKE, (40, 80))) == "no"
    assert lacking(data("cavity", ALIKE)) == ""
    assert [listed(words) for words in ([], ["a"], ["a", "b"], ["a", "b", "c"])] == ["", "a", "a and b", "a, b and c"]


@pytest.mark.parametrize("case", CASES)
def test_kept_runs_are_of_the_plan_and_scored_as_now(case: str) -> None:
    whole = kept("zheng2018", case)
    plan = [identity(each._asdict()) for each in wanted(case)]
    found = [identity(row) for row in whole["runs"]]
    assert found == [each for each in plan if each in found]
    for row in whole["runs"]:
        assert bool(row["profiles"]) == (row["end"] == "time")
        for name, value in scores(case, row).items():
            assert row[name] == pytest.approx(value, abs=2e-5), (identity(row), name)
        assert len(row["energy"]) <= 100
        drawn = row["viscosity"] == "oger" and row["preset"] == "defaults" and row["reynolds"] == 1000
        assert ("field_u" in row) == drawn
        if drawn:
            assert len(row["field_u"]) == len(row["field_v"]) == cavities.POINTS**2


def test_kept_runs_are_small() -> None:
    assert sum(len(as_text(kept("zheng2018", case))) for case in CASES) < 1_000_000


@pytest.mark.parametrize("item", ITEMS)
def test_what_is_kept_is_presented(item: str) -> None:
    result = present(item, kept("zheng2018", ITEMS[item]))
    assert result.rows or "not computed" in result.finding
    assert not result.finding.endswith(".")
    assert "nan" not in result.finding


def test_new_rows_replace_old_ones_and_keep_the_rest() -> None:
    old, new = data("cavity", {"morris": 1.0, "oger": 1.0}, (40,)), data("cavity", {"gotoh": 1.0, "oger": 2.0}, (40,))
    both = merged("cavity", old, new)
    assert [row["viscosity"] for row in both["runs"]] == ["morris", "gotoh", "oger"]
    assert both["runs"][2] == new["runs"][1]
    assert merged("cavity", None, new) == new


def test_runs_are_chosen_by_size_and_term() -> None:
    few = selected(["cavity"], at_most=50, terms=("oger",))
    assert {(each.resolution, each.reynolds, each.preset) for each in few} == {
        (40, 1000.0, "defaults"), (40, 1000.0, "zheng2018"), (40, 1000.0, "zheng2018 with shifting"),
        (50, 100.0, "defaults"),
    }  # fmt: skip
    assert len(selected(CASES)) == len(set(selected(CASES))) == sum(len(wanted(case)) for case in CASES)
    assert {each.resolution for each in wanted("cavity", quick=True)} == set(cavities.QUICK_SIZES)


def test_the_papers_own_settings_are_the_preset_with_its_time_step() -> None:
    settings = Wanted("cavity", "gotoh", 40, preset="zheng2018").run().given
    assert (settings["time_step"], settings["alpha"], settings["shifting"]) == (0.001, 0.01, "none")
    assert (settings["viscosity"], settings["walls"], settings["gradient"]) == ("gotoh", "sfdi", "symmetric")
    shifted = Wanted("cavity", "gotoh", 40, preset=cavities.SHIFTED).run().given
    assert {name for name in settings if settings[name] != shifted[name]} == {"shifting", "shifting_strength"}
    assert shifted["shifting_strength"] == 1.0  # as its source has it


def test_the_papers_own_settings_are_said_to_fail_and_to_hold() -> None:
    own = {"preset": "zheng2018", "end": "failed: so", "time": 0.17, "profiles": {}}
    shifted = made_up("cavity", "oger", 40, 0.1) | {"preset": cavities.SHIFTED}
    whole = data("cavity", ALIKE)
    whole["runs"] += [{**shifted, **own}, {**shifted, **own, "resolution": 100, "time": 0.09}, shifted]
    for item in ("figure-7", "figure-9", "figure-10"):
        found = present(item, whole).finding
        assert "own settings at 40 and 100 particles a side 2 of 2 runs failed, at t = 0.09 to 0.17" in found
        assert f"these with particle shifting, oger: mean deviation {shifted['deviation']:.4f} at 40" in found


@pytest.mark.parametrize("case", CASES)
def test_runs_are_computed_kept_and_presented(case: str, own_store: Path) -> None:
    runs = [Wanted(case, term, 14, until=0.3) for term in ("oger", "morris")]
    told: list[str] = []
    study = Study(runs)
    assert study.kept() == {}
    results = study.compute(1, told.append)
    assert told
    assert study.kept() == results
    whole = data_of(case, results, quick=True)
    assert json.loads(as_text(whole)) == whole
    assert [(row["viscosity"], row["end"], row["resolution"]) for row in whole["runs"]] == [
        ("oger", "time", 14), ("morris", "time", 14),
    ]  # fmt: skip
    oger, morris = whole["runs"]
    assert "field_u" not in morris
    assert (None in oger["field_u"]) == (case == "cavity-cylinder")
    assert oger["watched"]["smallest_distance"][-1] > 0.3
    again: list[str] = []
    assert Study(runs).compute(1, again.append) == results
    assert len(again) == 1  # nothing was left to do
    for item, its in ITEMS.items():
        if its == case:
            assert present(item, {**whole, "sizes": [14]}).agrees == "partly"


def test_a_result_of_other_defaults_is_computed_again(own_store: Path) -> None:
    each = Wanted("cavity", "morris", 10, until=0.05)
    study = Study([each])
    (result,) = study.compute(1).values()
    place = store("zheng2018").path(study.runs[each])
    old = json.loads(place.read_text(encoding="utf-8"))
    place.write_text(json.dumps({**old, "settings": {**old["settings"], "tolerance": 0.1}}), encoding="utf-8")
    assert study.kept() == {}
    with pytest.warns(SweepWarning, match="1 stored result is not its run's and is computed again"):
        again = Study([each]).compute(1)[each].profiles
    assert again.keys() == result.profiles.keys()
    for name, values in result.profiles.items():  # code just compiled and code from the cache may round differently
        np.testing.assert_allclose(np.array(again[name], float), np.array(values, float), rtol=0, atol=1e-9)


def test_an_interrupted_run_goes_on_where_it_was_saved(own_store: Path) -> None:
    run = Wanted("cavity", "morris", 10, until=0.4).run()
    straight = compute_run(run.case, run.given)
    half = CaseRun(FLOWS["cavity"], run.settings.model_copy(update={"until": 0.2, "threads": 1})).run()
    saved = own_store / "zheng2018" / f"{run.key}.npz"
    half.save(saved)
    on = compute_run(run.case, run.given)
    assert not saved.exists()
    assert on["metrics"]["steps"] == straight["metrics"]["steps"]
    np.testing.assert_allclose(on["profiles"]["u"], straight["profiles"]["u"], rtol=0, atol=1e-9)
    assert [row["steps"] for row in on["history"][:2]] == [row["steps"] for row in half.history[:2]]
    other = half.settings.model_copy(update={"seed": 5})
    CaseRun(FLOWS["cavity"], other).run().save(saved)  # of other settings: not gone on with
    assert compute_run(run.case, run.given)["metrics"] == straight["metrics"]


def test_an_unknown_term_is_no_run() -> None:
    with pytest.raises(SphearError, match="morriss"):
        Wanted("cavity", "morriss", 10).run()
