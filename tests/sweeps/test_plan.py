"""What a sweep computes."""

from __future__ import annotations

from typing import Any

import pytest

from sphear.cases.flow import FLOWS, CaseRun
from sphear.errors import SphearError
from sphear.schemes.presets import PRESETS
from sphear.sweeps import Run, plan


def test_all_combinations_the_last_setting_changes_fastest() -> None:
    runs = plan("couette", {"viscosity": ["morris", "violeau"], "resolution": [10, 20]}, {"until": 0.1})
    found = [(run.settings.viscosity, run.settings.resolution) for run in runs]
    assert found == [("morris", 10), ("morris", 20), ("violeau", 10), ("violeau", 20)]
    assert {run.case for run in runs} == {"couette"}
    assert {run.settings.until for run in runs} == {0.1}


def test_settings_are_those_of_the_case() -> None:
    (run,) = plan("couette", {"resolution": [10]})
    assert run.settings == FLOWS["couette"].settings(resolution=10)


def test_values_may_be_text() -> None:
    assert plan("poiseuille", {"reynolds": ["0.5"]}) == plan("poiseuille", {"reynolds": [0.5]})


def test_aliases_and_repeated_values_are_one_run() -> None:
    runs = plan("poiseuille", {"viscosity": ["morris", "E", "morris"], "resolution": [10, "10"]})
    assert [run.settings.viscosity for run in runs] == ["morris"]


def test_a_run_without_choices_is_one_run() -> None:
    assert len(plan("taylor_green", {})) == 1


def run(**settings: Any) -> Run:
    return Run("poiseuille", FLOWS["poiseuille"].settings(**{**PRESETS["basa2009"], **settings}))


def test_the_key_is_readable_and_changes_with_every_setting_that_matters() -> None:
    assert run().key.startswith("poiseuille-morris-none-re0.5-n20-")
    changed: list[dict[str, Any]] = [
        {}, {"until": 1}, {"kernel": "wendland_c2"}, {"h_over_dx": 1.2}, {"max_steps": 3}, {"continuation": "mirror"},
        {"sound_speed": 50}, {"time_step": 1e-5},
    ]  # fmt: skip
    assert len({run(**settings).key for settings in changed}) == len(changed)
    assert run().key != Run("couette", run().settings).key


def test_the_key_does_not_change_with_what_does_not_matter() -> None:
    assert run(force=True).key == run().key
    assert run(until=1).key == run(until=1.0).key
    assert run(viscosity="E").key == run().key
    assert Run("Poiseuille", run().settings).key == run().key


def test_a_file_can_have_the_key_as_its_name() -> None:
    assert "/" not in run(viscosity="cleary_4.24", reynolds=1e-30).key


def test_longer_runs_cost_more() -> None:
    assert run(until=1).cost < run(until=2).cost < run(until=2, resolution=40).cost
    assert run(max_steps=10).cost == pytest.approx(400 * 10)


def test_the_cost_of_a_run_does_not_know_of_the_others() -> None:
    """Time steps are found without starting each flow; started alone, each gives the same."""
    for case, fixed in (("poiseuille", {}), ("cavity", {"resolution": 12}), ("taylor-green", {"resolution": 16})):
        for scheme in FLOWS[case].defaults:
            over: dict[str, Any] = {"reynolds": [0.5, 300.0], "until": [0.1, 2.0], "time_step": [None, 1e-6]}
            runs = plan(case, over, {"scheme": scheme, **fixed})
            assert len(runs) == 8
            for planned in runs:
                alone = CaseRun(FLOWS[case], planned.settings)
                steps = min(
                    (planned.settings.until or 0.0) * alone.unit / alone.flow.time_step, planned.settings.max_steps
                )
                assert planned.cost == pytest.approx(len(alone.flow.positions) * steps)


def test_a_flow_is_started_once_for_all_reynolds_numbers_times_and_seeds(monkeypatch: pytest.MonkeyPatch) -> None:
    started: list[int] = []
    start = CaseRun.__init__

    def counted(self: CaseRun, case: Any, settings: Any) -> None:
        started.append(settings.resolution)
        start(self, case, settings)

    monkeypatch.setattr(CaseRun, "__init__", counted)
    over: dict[str, Any] = {"reynolds": [0.1, 0.2, 0.3], "resolution": [10, 12], "seed": range(5), "until": [0.1, 0.2]}
    told: list[tuple[int, int]] = []
    assert len(plan("poiseuille", over, {}, lambda planned, of: told.append((planned, of)))) == 60
    assert started == [10, 12]
    assert told == [(0, 60), (20, 60), (40, 60)]


def test_a_time_step_beyond_the_limit_of_one_run_is_refused() -> None:
    with pytest.raises(SphearError, match=r"the time step of 0\.001 is beyond the [a-z]+ limit"):
        plan("taylor-green", {"reynolds": [100.0, 0.01]}, {"time_step": 0.001, "resolution": 16})


WRONG: dict[str, tuple[str, dict[str, Any], dict[str, Any], str]] = {
    "case": ("poisseuille", {"resolution": [10]}, {}, "no case named 'poisseuille': did you mean poiseuille"),
    "key": ("poiseuille", {"resolutoin": [10]}, {}, "no setting named 'resolutoin': did you mean resolution"),
    "fixed key": ("poiseuille", {"resolution": [10]}, {"kernl": 1}, "no setting named 'kernl': did you mean kernel"),
    "no values": ("poiseuille", {"resolution": []}, {}, "the setting resolution needs a list of at least one value"),
    "text": ("poiseuille", {"kernel": "cubic"}, {}, "the setting kernel needs a list"),
    "many": (
        "couette",
        {"seed": range(400), "reynolds": range(1, 401)},
        {},
        "at most 100000 runs, and 400 x 400 values",
    ),
    "both": ("poiseuille", {"reynolds": [1]}, {"reynolds": 2}, "the setting reynolds is both fixed and swept over"),
    "value": ("poiseuille", {"reynolds": [1, -1]}, {}, "the setting reynolds should be greater than 0, not -1"),
    "name": ("poiseuille", {"viscosity": ["morris", "moris"]}, {}, "no viscosity named 'moris': did you mean morris"),
    "together": ("poiseuille", {"resolution": [20, 3]}, {}, "the resolution of 3 is too coarse"),
}


@pytest.mark.parametrize("what", WRONG)
def test_what_is_wrong_is_refused_in_a_sentence(what: str) -> None:
    case, over, fixed, sentence = WRONG[what]
    with pytest.raises(SphearError) as refused:
        plan(case, over, fixed)
    assert sentence in str(refused.value)
