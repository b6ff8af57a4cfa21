"""`sphear run` and `sphear sweep` of incompressible flows."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from sphear.cases.flow import CaseRun
from sphear.cases.flow.history import CaseHistory
from sphear.schemes.incompressible.settings import IncompressibleSettings
from sphear.schemes.presets import preset_settings

Run = Callable[..., Any]

CAVITY = ("run", "cavity", "--scheme", "incompressible", "--resolution", "12")
CYLINDER = ("run", "cavity-cylinder", "--resolution", "24", "--set", "diameter=0.4", "-v", "oger")


@pytest.mark.parametrize("command", [CAVITY, CYLINDER])
def test_json_is_one_document_with_all_settings_resolved(command: tuple[str, ...], sphear: Run) -> None:
    result = sphear(*command, "--set", "max_steps=3", "--json").json()
    assert list(result) == ["case", "settings", "metrics", "profiles", "warnings", "versions", "performance"]
    settings = result["settings"]
    assert set(IncompressibleSettings.model_fields) <= set(settings)
    assert [key for key, value in settings.items() if value is None] == []
    assert settings["scheme"] == "incompressible"
    assert settings["time_step"] == pytest.approx(result["metrics"]["time"] / 3)
    assert {"u_min", "divergence", "pressure_iterations", "end", "failure_time"} <= set(result["metrics"])
    assert result["metrics"]["end"] == "steps"
    assert result["performance"]["steps"] == 3


def test_names_are_the_registered_ones(sphear: Run) -> None:
    names = ("-v", "VISC-04", "--set", "kernel=cubic", "--set", "preconditioner=diagonal", "--set", "laplacian=E")
    settings = sphear(*CAVITY, *names, "--set", "max_steps=1", "--json").json()["settings"]
    found = [settings[key] for key in ("viscosity", "kernel", "preconditioner", "laplacian")]
    assert found == ["oger", "cubic_spline", "jacobi", "morris"]


@pytest.mark.parametrize("preset", ["zheng2018", "Zheng2018"])
@pytest.mark.parametrize("command", [CAVITY, CYLINDER])
def test_presets_of_the_scheme(preset: str, command: tuple[str, ...], sphear: Run) -> None:
    settings = sphear(*command, "--preset", preset, "--set", "max_steps=1", "--json").json()["settings"]
    chosen = preset_settings(preset, "incompressible")
    assert {key: settings[key] for key in chosen} == chosen
    assert settings["resolution"] == int(command[command.index("--resolution") + 1])


def test_a_preset_of_the_other_scheme(sphear: Run) -> None:
    outcome = sphear("run", "cavity", "--scheme", "incompressible", "--preset", "basa2009")
    assert (outcome.status, outcome.out) == (2, "")
    assert "there is no preset named 'basa2009'" in outcome.err


def test_a_table_says_what_is_computed_and_how_it_ended(sphear: Run) -> None:
    outcome = sphear(*CAVITY, "--until", "0.1")
    assert (outcome.status, outcome.err) == (0, "")
    for text in (
        "cavity: 144 particles, Re = 100", "incompressible scheme", "preconditioner grid, walls mirror_points",
        "time step", "divergence", "smallest", "End: time.", "u min", "a second",
    ):  # fmt: skip
        assert text in outcome.out


def test_files_and_particles(sphear: Run) -> None:
    outcome = sphear(*CYLINDER, "--set", "max_steps=2", "--json", "--out", "results")
    files = {path.name for path in Path("results").iterdir()}
    assert files == {
        f"cavity-cylinder{end}" for end in (".json", ".csv", "-particles.csv", ".png", ".svg", "-state.npz")
    }
    written = json.loads(Path("results/cavity-cylinder.json").read_text())
    assert len(written.pop("history")) == 2
    assert written == outcome.json()


def test_a_failure_is_reported_with_files_and_without_warnings(sphear: Run) -> None:
    command = (*CAVITY, "--set", "time_step=1e200", "--force", "--json", "--out", "results")
    outcome = sphear(*command)
    assert (outcome.status, outcome.err) == (3, "")
    assert json.loads(outcome.out)["metrics"]["end"].startswith("failed: the flow failed at t = 0")
    assert Path("results/cavity.png").exists()
    assert not Path("results/cavity-state.npz").exists()  # there is nothing to go on with


def test_an_interrupted_run_is_gone_on_with(sphear: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    watch, short = CaseHistory.watch, (*CAVITY, "--set", "max_steps=6")

    def watched(history: CaseHistory, run: CaseRun) -> None:
        watch(history, run)
        if len(run.history) == 3:
            raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(CaseHistory, "watch", watched)
        stopped = sphear(*short, "--out", "results", "--json")
    assert (stopped.status, stopped.out) == (130, "")
    assert "--resume goes on from there" in stopped.err
    refused = sphear(*short, "--out", "results", "--resume", "--set", "alpha=0.2")
    assert (refused.status, "has alpha = None, not 0.2" in refused.err) == (2, True)
    resumed = sphear(*short, "--out", "results", "--resume", "--json").json()
    assert resumed["metrics"] == sphear(*short, "--json").json()["metrics"]


WRONG: dict[str, tuple[tuple[str, ...], str]] = {
    "scheme": (("cavity", "--scheme", "implicit"), "there is no scheme named 'implicit': did you mean"),
    "explicit": (("dam-break", "--scheme", "explicit"), "dam-break is computed by the scheme incompress"),
    "setting of the other scheme": (
        ("cavity", "--scheme", "incompressible", "--set", "sound_speed=10"),
        "the setting sound_speed is one of scheme=explicit, and this is scheme=incompressible",
    ),
    "diameter": (("cavity-cylinder", "--set", "diameter=1.5"), "the setting diameter should be less than 1, not"),
    "spin": (("cavity-cylinder", "--set", "spin=inf"), "the setting spin should be a finite number"),
    "alpha": (("cavity-cylinder", "--set", "alpha=2"), "the setting alpha should be less than or equal to 1"),
    "two gradients": (
        ("cavity-cylinder", "--set", "gradient=symmetric"),
        "gradient=symmetric conserves momentum and gradient_correction=renormalised does not: take",
    ),
    "wall": (("cavity-cylinder", "--set", "walls=sdfi"), "the setting walls is to be a wall model"),
    "preconditioner": (("cavity-cylinder", "--set", "preconditioner=grd"), "no preconditioner named 'grd'"),
    "time step": (("cavity-cylinder", "--set", "time_step=1"), "the time step of 1 is beyond the cfl limit of"),
}


@pytest.mark.parametrize("mistake", WRONG)
def test_a_mistake_is_one_sentence(mistake: str, sphear: Run) -> None:
    arguments, message = WRONG[mistake]
    outcome = sphear("run", *arguments)
    assert (outcome.status, outcome.out) == (2, "")
    assert message in outcome.err
    assert len(outcome.err.strip().splitlines()) == 1


def test_a_sweep_over_settings_of_the_scheme(sphear: Run) -> None:
    """On a process of its own; the cylinder's own settings are settings too."""
    over = ("--over", "walls=natural,mirror_points", "--set", "max_steps=2", "--set", "resolution=24")
    command = (
        "sweep",
        "cavity-cylinder",
        *over,
        "--set",
        "viscosity=oger",
        "--set",
        "diameter=0.4",
        "--out",
        "results",
        "--json",
    )
    found = sphear(*command).json()
    assert [row["settings"]["walls"] for row in found["runs"]] == ["natural", "mirror_points"]
    assert {row["end"] for row in found["runs"]} == {"steps"}
    assert all(row["settings"]["threads"] == 1 and row["settings"]["diameter"] == 0.4 for row in found["runs"])
    assert len(list(Path("results/runs").iterdir())) == 2
