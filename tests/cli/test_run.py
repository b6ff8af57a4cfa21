"""`sphear run`: one document, files, and one sentence for each mistake."""

from __future__ import annotations

import json
import platform
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
import numpy as np
import pytest

from sphear import __version__

Run = Callable[..., Any]


def test_json_is_one_document(sphear: Run) -> None:
    result = sphear("run", "poiseuille", "--preset", "basa2009", "--until", "0.1", "--json").json()
    assert list(result) == ["case", "settings", "metrics", "warnings", "versions", "performance"]
    assert result["case"] == "poiseuille"
    assert result["settings"]["until"] == 0.1
    assert result["metrics"]["end"] == "time"
    assert result["performance"]["particles"] == 400


def test_a_result_says_what_computed_it(sphear: Run) -> None:
    found = sphear("run", "poiseuille", "--resolution", "10", "--set", "max_steps=1", "--json").json()["versions"]
    assert found == {
        "sphear": __version__, "python": platform.python_version(), "numpy": np.__version__, "numba": numba.__version__
    }  # fmt: skip


def test_settings_by_option_and_by_set(sphear: Run) -> None:
    command = (
        "run",
        "poiseuille",
        "--preset",
        "basa2009",
        "--json",
        "--set",
        "until=0.05",
        "--set",
        "sound-speed = 50",
    )
    settings = sphear(*command, "--resolution", "10", "-v", "E", "--reynolds", "0.25").json()["settings"]
    assert (settings["until"], settings["sound_speed"], settings["resolution"]) == (0.05, 50.0, 10)
    assert (settings["viscosity"], settings["reynolds"]) == ("morris", 0.25)


def test_a_table_says_what_is_computed_and_how_it_ended(sphear: Run) -> None:
    outcome = sphear("run", "couette", "--preset", "basa2009", "--until", "0.01", "--resolution", "10")
    assert (outcome.status, outcome.err) == (0, "")
    for text in ("couette: 100 particles, Re = 1", "sound speed", "time step", "rms error", "End: time.", "a second"):
        assert text in outcome.out


def test_underscores_do_for_hyphens(sphear: Run) -> None:
    command = ("run", "taylor_green", "--resolution", "10", "--set", "max_steps=2", "--json")
    assert sphear(*command).json()["case"] == "taylor-green"


def test_files(sphear: Run) -> None:
    outcome = sphear("run", "poiseuille", "--preset", "basa2009", "--until", "0.1", "--json", "--out", "results")
    files = {path.name for path in Path("results").iterdir()}
    assert {"poiseuille.json", "poiseuille.csv", "poiseuille.png", "poiseuille.svg"} <= files
    written = json.loads(Path("results/poiseuille.json").read_text())
    history = written.pop("history")
    assert written == outcome.json()
    assert history[-1]["rms_error"] == written["metrics"]["rms_error"]
    assert len(Path("results/poiseuille.csv").read_text().splitlines()) > 5


def test_particles_are_written_for_other_programs(sphear: Run) -> None:
    sphear(
        "run", "couette", "--preset", "basa2009", "--resolution", "10", "--until", "0.01", "--json", "--out", "results"
    )
    heading, *lines = Path("results/couette-particles.csv").read_text().splitlines()
    assert heading == "x0,x1,u0,u1,density,pressure"
    rows = [[float(number) for number in line.split(",")] for line in lines]
    assert len(rows) == 100
    assert all(0.99 < row[4] < 1.01 for row in rows)
    fastest = max(rows, key=lambda row: row[2])
    assert fastest[1] == max(row[1] for row in rows)  # beside the wall that moves


def test_the_cavity_has_its_numbers_and_profiles(sphear: Run) -> None:
    result = sphear("run", "cavity", "--preset", "basa2009", "--resolution", "12", "--until", "0.05", "--json").json()
    assert list(result) == ["case", "settings", "metrics", "profiles", "warnings", "versions", "performance"]
    assert set(result["metrics"]) == {
        "time", "steps", "kinetic_energy", "kinetic_energy_error", "u_min", "reference_missing", "mach",
        "density_deviation", "smallest_distance", "end", "failure_time",
    }  # fmt: skip
    assert result["metrics"]["end"] == "time"
    assert result["metrics"]["reference_missing"].startswith("no profiles are known at t = 0.05")
    assert result["settings"]["walls"] == "fixed"
    stations = result["profiles"]["stations"]
    assert 0 < stations[0] < stations[-1] < 1
    assert len(stations) == len(result["profiles"]["u"]) == len(result["profiles"]["v"])


def test_a_forced_time_step_is_said(sphear: Run) -> None:
    outcome = sphear(
        "run", "poiseuille", "--preset", "basa2009", "--set", "time_step=0.002", "--set", "max_steps=1", "--force"
    )
    assert outcome.status == 0
    assert "warning: the time step is beyond its limit" in outcome.out


def test_a_failure_is_reported_and_not_hidden(sphear: Run) -> None:
    command = ("run", "poiseuille", "--preset", "basa2009", "--set", "sound_speed=0.2", "--until", "5", "--json")
    outcome = sphear(*command)
    assert (outcome.status, outcome.err) == (3, "")
    result = json.loads(outcome.out)
    assert result["metrics"]["end"].startswith("failed: ")
    assert result["metrics"]["failure_time"] > 0


@pytest.mark.parametrize(
    ("command", "said"),
    [
        (
            ["poiseuille", "--set", "transport=none", "--set", "shifting_strength=3"],
            "shifting_strength has no effect with transport=none",
        ),
        (
            ["poiseuille", "--preset", "basa2009", "--set", "diffusion_form=antuono"],
            "diffusion_form has no effect with density_diffusion=0",
        ),
        (["couette", "--set", "walls=adami", "--set", "continuation=linear"], "no effect with walls=adami"),
        (["poiseuille", "--set", "initial_pressure=5"], "no effect with equation_of_state=batchelor_tait"),
        (
            [
                "cavity",
                "--scheme",
                "incompressible",
                "--set",
                "shifting=none",
                "--set",
                "shifting_strength=2",
                "--reynolds",
                "10",  # whose layers are resolved
            ],
            "shifting=none",
        ),
    ],
)
def test_a_setting_without_effect_is_a_warning(sphear: Run, command: list[str], said: str) -> None:
    out = sphear("run", *command, "--resolution", "10", "--set", "max_steps=1").out
    assert out.count("warning: ") == 1
    assert said in out
    assert "warning" not in sphear("run", "poiseuille", "--resolution", "10", "--set", "max_steps=1").out


WRONG: dict[str, tuple[list[str], str]] = {
    "no case": ([], "missing argument 'CASE'"),
    "unknown case": (["poisseuille"], "there is no case named 'poisseuille': did you mean poiseuille"),
    "unknown key": (["poiseuille", "--set", "kernl=cubic"], "no setting named 'kernl': did you mean kernel"),
    "no value": (["poiseuille", "--set", "kernel"], "--set takes KEY=VALUE"),
    "unknown term": (["poiseuille", "-v", "moris"], "no viscosity named 'moris': did you mean morris"),
    "unknown kernel": (["poiseuille", "--set", "kernel=cubix"], "no kernel named 'cubix'"),
    "unknown wall": (["poiseuille", "--set", "continuation=liner"], "no continuation named 'liner'"),
    "unknown state": (["poiseuille", "--set", "equation_of_state=tate"], "the setting equation_of_state should be"),
    "no number": (["poiseuille", "--set", "reynolds=some"], "the setting reynolds should be a valid number"),
    "Re is zero": (["poiseuille", "--reynolds", "0"], "the setting reynolds should be greater than 0, not 0"),
    "Re is negative": (["couette", "--reynolds", "-1"], "the setting reynolds should be greater than 0, not -1"),
    "Re is infinite": (["couette", "--reynolds", "inf"], "the setting reynolds should be a finite number"),
    "until is nan": (["couette", "--until", "nan"], "the setting until should be"),
    "too coarse": (["poiseuille", "--resolution", "3"], "the resolution of 3 is too coarse"),
    "time step": (
        ["poiseuille", "--preset", "basa2009", "--set", "time_step=1"],
        "the time step of 1 is beyond the viscous limit of",
    ),
    "diffusion of a sum": (
        ["poiseuille", "--set", "density=summation", "--set", "density_diffusion=0.1"],
        "density=summation has none",
    ),
    "unmatched": (
        ["poiseuille", "--set", "density=summation", "--set", "momentum=products"],
        "density=summation and momentum=products",
    ),
    "two settings of a gas": (
        ["poiseuille", "--set", "equation_of_state=ideal_gas", "--set", "transport=shifting"],
        "transport=shifting moves particles without their energy, which equation_of_state=ideal_gas needs",
    ),
    "slip without mirrors": (
        ["cavity", "--set", "walls=fixed", "--set", "wall_divergence=slipping"],
        "wall_divergence=slipping is about the continuity equation beside mirrors, and not for density=summation with"
        " walls=fixed",
    ),
    "transport of a continuity": (
        ["poiseuille", "--set", "density=continuity", "--set", "transport=transport_velocity"],
        "transport=transport_velocity is made for density=summation, not for density=continuity",
    ),
    "gradients that walls have not": (
        [
            "poiseuille",
            "--set",
            "diffusion_form=antuono",
            "--set",
            "walls=adami",
            "--set",
            "density=continuity",
        ],
        "diffusion_form=antuono needs density gradients in the walls, which walls=adami has not",
    ),
    "sound of a gas": (
        ["poiseuille", "--set", "equation_of_state=ideal_gas", "--set", "sound_speed=50"],
        "sound_speed follows from initial_pressure where equation_of_state=ideal_gas",
    ),
    "particles on no mirror": (
        ["couette", "--set", "walls=adami", "--set", "wall_particles=true"],
        "wall_particles stand on mirroring walls and walls=adami has none",
    ),
    "no folder": (["poiseuille", "--out", " "], "the output folder needs a name"),
    "twice": (
        ["poiseuille", "--reynolds", "1", "--set", "reynolds=2"],
        "the setting reynolds is given by --reynolds and by --set: choose one",
    ),
    "two values": (
        ["poiseuille", "--set", "seed=1", "--set", "seed=2"],
        "--set seed is given twice, as 1 and as 2: choose one",
    ),
    "other scheme": (["cavity", "--set", "shifting=lind"], "shifting is one of scheme=incompressible, and this is"),
    "periodic": (["taylor-green", "--resolution", "2"], "the resolution of 2 is too coarse: the kernel's support of"),
}


@pytest.mark.parametrize("case", WRONG)
@pytest.mark.parametrize("json_too", [False, True])
def test_a_mistake_is_one_sentence(sphear: Run, case: str, json_too: bool) -> None:
    arguments, message = WRONG[case]
    outcome = sphear("run", *arguments, *(["--json"] if json_too else []))
    assert (outcome.status, outcome.out) == (2, "")
    assert message in outcome.err
    assert len(outcome.err.strip().splitlines()) == 1
    assert not list(Path.cwd().iterdir())
