"""Flows against their exact solutions, and what a run reports."""

from __future__ import annotations

from typing import Any

import pytest

import sphear
from sphear.cases.flow import CaseRun
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings


def run(case: str, **settings: Any) -> CaseRun:
    return sphear.flow(case, preset="basa2009", **settings).run()


# an independent program found these; a fifth is left for what the paper does not state
@pytest.mark.parametrize(("viscosity", "error"), [("morris", 0.022), ("violeau", 0.061), ("cleary_4.24", 0.0105)])
def test_poiseuille_errors(viscosity: str, error: float) -> None:
    done = run("poiseuille", viscosity=viscosity, reynolds=0.5, resolution=20, until=5.0)
    assert done.end == "time"
    assert done.history[-1]["time"] == pytest.approx(5.0, rel=1e-2)
    assert done.history[-1]["rms_error"] == pytest.approx(error, rel=0.2)


def test_morris_reaches_the_steady_flow() -> None:
    done = run("poiseuille", reynolds=0.5, resolution=20)
    assert done.end == "steady"
    # 32 / pi^3 exp(-t*) is 1e-12 at t* = 27.66; the next output is at most 1000 steps later
    assert 27.66 <= done.history[-1]["time"] <= 27.66 + done.flow.time_step * 1000 / done.unit
    assert done.history[-1]["kinetic_energy"] == pytest.approx(1.0, abs=0.05)


def test_takeda_fails_uncorrected_and_level_0_cures_it() -> None:
    alone = run("poiseuille", viscosity="takeda", until=2.0)
    assert alone.end.startswith("failed: the RMS error")
    assert alone.as_dict()["metrics"]["failure_time"] == alone.history[-1]["time"] < 2.0
    cured = run("poiseuille", viscosity="takeda", correction="shepard", until=2.0)
    assert cured.end == "time"
    assert cured.history[-1]["rms_error"] < 0.12


def test_a_run_that_breaks_down_keeps_what_it_found() -> None:
    done = run("poiseuille", sound_speed=0.2, until=5.0)
    assert "speed of sound" in done.end
    assert len(done.history) >= 1
    assert done.as_dict()["metrics"]["end"] == done.end


def test_a_relaxed_start_is_not_taken_for_a_breakdown() -> None:
    done = run("poiseuille", initial="relaxed", resolution=10, until=1.0)
    assert done.end == "time"
    assert done.history[0]["rms_error"] > 0.5  # stirred, of a flow that hardly moves yet
    assert done.history[-1]["rms_error"] < 0.12


def test_couette_errors_fall_with_the_spacing() -> None:
    errors = [run("couette", resolution=n, until=0.2).history[-1]["rms_error"] for n in (10, 20, 40)]
    assert errors[0] < 0.01
    assert errors[0] > errors[1] > errors[2]


def test_taylor_green_decays_as_it_should() -> None:
    done = run("taylor-green", resolution=50, until=0.1)
    last = done.history[-1]
    assert last["time"] == pytest.approx(0.1, rel=0.02)
    assert last["kinetic_energy_ratio"] == pytest.approx(1.0, abs=0.02)
    assert last["l2_error"] < 0.02
    energies = [0.25, *(row["kinetic_energy"] for row in done.history)]
    # sound waves carry energy to and fro: falling over any ten outputs, not from each to the next
    assert all(later < earlier for earlier, later in zip(energies[:-10], energies[10:], strict=True))


def test_max_steps_ends_a_run() -> None:
    done = run("couette", max_steps=7)
    assert done.end == "steps"
    assert done.flow.steps == 7


def test_as_dict_has_case_resolved_settings_metrics_and_performance() -> None:
    done = run("poiseuille", viscosity="E", correction="uncorrected", continuation="linear", until=0.1)
    result = done.as_dict()
    assert list(result) == ["case", "settings", "metrics", "warnings", "versions", "performance"]
    assert result["case"] == "poiseuille"
    settings = result["settings"]
    expected = {
        "viscosity": "morris", "correction": "none", "kernel": "cubic_spline", "equation_of_state": "batchelor_tait",
        "pressure_reduction": "mean", "continuation": "linear", "reynolds": 0.5, "resolution": 20, "until": 0.1,
        "max_steps": 500_000, "force": False, "kinematic_viscosity": 1.0,
        "h_over_dx": pytest.approx(1 / 0.637), "sound_speed": done.flow.resolved()["sound_speed"],
        "time_step": done.flow.time_step,
    }  # fmt: skip
    assert {key: settings[key] for key in expected} == expected
    assert set(WeaklyCompressibleSettings.model_fields) <= set(settings)
    assert settings["momentum"] == "squares"  # resolved: that of the summed density
    metrics = result["metrics"]
    assert set(metrics) == {
        "time", "steps", "rms_error", "kinetic_energy", "mach", "density_deviation", "smallest_distance", "end",
        "failure_time",
    }  # fmt: skip
    assert (metrics["end"], metrics["failure_time"]) == ("time", None)
    performance = result["performance"]
    assert performance["particles"] == 400
    assert performance["steps"] == metrics["steps"] == done.flow.steps
    assert performance["particle_steps_per_second"] == pytest.approx(400 * done.flow.steps / performance["seconds"])
