"""The search for the settings of Zheng, Ma & Shao 2018: the readings, what is kept of them and what is said of it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sphear.kernels import CubicSpline, Kernel, WendlandC2
from sphear.results import OutputFolder
from sphear.studies import reproduce
from sphear.studies.kept import as_text, kept
from sphear.studies.zheng2018 import settings
from sphear.studies.zheng2018.cavities import UNTIL
from sphear.studies.zheng2018.settings_combinations import BY_NAME, FINE, LONG, QUICK, READINGS, STATED
from sphear.studies.zheng2018.settings_growth import growth
from sphear.studies.zheng2018.settings_rows import growth_of, identity, merged
from sphear.studies.zheng2018.settings_runs import Tried, compute_reading, tried


def test_readings_are_settings_and_no_two_are_the_same() -> None:
    assert len(BY_NAME) == len(READINGS)
    assert {*FINE, *LONG, *QUICK} <= BY_NAME.keys()
    runs = [each.run() for each in tried()]
    assert len({run.key for run in runs}) == len(runs)
    stated = Tried(STATED, 40, UNTIL).run().given
    assert (stated["gradient"], stated["alpha"], stated["time_step"]) == ("symmetric", 0.01, 0.001)
    for reading in READINGS:
        assert all(stated[key] != value for key, value in reading.changes.items()), reading.name


def test_kept_numbers_are_of_the_readings_as_they_are() -> None:
    data = kept("zheng2018", "settings")
    assert merged(data, {}) == data  # none of a reading that has changed, in their order
    there = [identity(row) for row in data["runs"]]
    assert len(set(there)) == len(there)
    for row in data["runs"]:
        reached = row["time"] >= row["until"] * (1 - 1e-9)
        assert row["end"] == "time" if reached else row["end"].startswith("failed")
    result = settings.present(data)
    (stated,) = (row for row in result.rows if identity(row) == (STATED, 40, 2.0))
    assert stated["time"] < 0.2
    assert len(result.tables[0].rows) == len(data["runs"])
    assert len(result.tables[1].rows) == len(READINGS)


def test_kept_numbers_are_drawn(tmp_path: Path) -> None:
    folder = OutputFolder(tmp_path)
    for name, draw in reproduce("zheng2018", "settings").figures.items():
        folder.write_figure(name, draw())
    assert [path.name for path in folder.files] == ["settings.png", "settings.svg"]


def a_row(name: str, size: int, until: float, time: float, deviation: float | None = None) -> dict[str, Any]:
    return {
        "reading": name, "resolution": size, "until": until, "time": time, "growth": None, "predicted": None,
        "end": "time" if time == until else "failed: so", "deviation": deviation, "kinetic_energy_error": -0.1,
    }  # fmt: skip


def test_the_verdict_is_of_readings_within_the_text_at_both_sizes() -> None:
    rows = [a_row(STATED, 40, 2.0, 0.1)]
    said, agrees = settings.finding(rows)
    assert agrees == "no"
    assert "as stated it fails at t = 0.1 with 40" in said
    beyond = [*rows, *(a_row("least zero + alpha 0.1", size, UNTIL, UNTIL, 0.01) for size in (40, 100))]
    assert settings.finding(beyond)[1] == "partly"
    within = [*rows, *(a_row("negative cut", size, UNTIL, UNTIL, 0.01) for size in (40, 100))]
    assert settings.finding(within)[1] == "yes"
    assert settings.finding(within[:-1])[1] == "partly"  # at one size only
    off = [*rows, *(a_row("negative cut", size, UNTIL, UNTIL, 0.03) for size in (40, 100))]
    assert settings.finding(off)[1] == "no"  # another flow


def test_a_growth_is_the_slope_of_the_logarithm() -> None:
    times = 0.005 * np.arange(1, 20)
    history = [{"time": t, "disorder": np.exp(30 * t), "least_pressure": -t} for t in times.tolist()]
    assert growth_of(history, 40) == {"growth": 30.0, "least_pressure": -0.04}
    assert growth_of(history[:4], 40)["growth"] is None


@pytest.mark.parametrize("kernel", [CubicSpline(1.2), WendlandC2(1.6)])
def test_displaced_lattices_are_pulled_as_the_growth_says(kernel: Kernel) -> None:
    """Rows that are displaced against each other along themselves, which the divergence does not see."""
    points = np.stack(np.meshgrid(*[np.arange(-4.0, 5.0)] * 2), axis=-1).reshape(-1, 2)
    off = 1e-5
    moved = points + np.array((off, 0.0)) * np.cos(np.pi * points[:, 1:])  # row by row to either side
    apart = moved[40] - np.delete(moved, 40, axis=0)
    near = apart[(apart**2).sum(axis=1) < kernel.radius**2]
    pull = -2.0 * -1.0 * sum(kernel.gradient(tuple(d), d @ d)[0] for d in near) / off  # p = -1 over a density of 1
    assert growth(kernel, 1.0, -1.0, 0.0) ** 2 >= pull * (1 - 1e-4)
    assert growth(kernel, 1.0, -4.0, 0.0) == pytest.approx(2 * growth(kernel, 1.0, -1.0, 0.0))
    assert growth(kernel, 1.0, -1.0, 0.1) < growth(kernel, 1.0, -1.0, 0.0)
    finer = type(kernel)(kernel.h / 2)
    assert growth(finer, 0.5, -1.0, 0.0) == pytest.approx(2 * growth(kernel, 1.0, -1.0, 0.0))


def test_under_positive_pressure_a_lattice_of_the_preset_is_stable() -> None:
    assert growth(CubicSpline(1.2), 1.0, 1.0, 0.0) == 0.0
    assert growth(CubicSpline(1.0), 1.0, 1.0, 0.0) > 0.0  # that of tables 1 and 2 is not


def test_a_run_goes_on_where_a_shorter_one_ended(own_store: Path) -> None:
    short, longer = (Tried("least zero + alpha 0.1", 10, until).run() for until in (0.02, 0.03))
    first = compute_reading("cavity", short.given)
    assert (first["end"], first["history"][-1]["disorder"] > 0) == ("time", True)
    whole = compute_reading("cavity", longer.given)
    assert whole["history"][: len(first["history"])] == first["history"]
    assert whole["metrics"]["steps"] == 30
    assert json.loads(as_text({"runs": whole["history"]}))["runs"] == whole["history"]
