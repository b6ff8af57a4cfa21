"""The parts of the benchmark to an error: icoFoam's case and profiles, the search, the curve, runs that are kept."""

from __future__ import annotations

import importlib
import json
import math
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

BENCHMARKS = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture(scope="module", autouse=True)
def _scripts_find_each_other() -> Any:
    sys.path.insert(0, str(BENCHMARKS))
    yield
    sys.path.remove(str(BENCHMARKS))


def script(name: str) -> Any:
    return importlib.import_module(name)


def run(side: int, deviation: float, seconds: float | None = None) -> Any:
    taken = 1e-3 * side**3 if seconds is None else seconds
    return script("_error_search").Computed("a", "a 1", "here", 100, side, 10 * side, taken, deviation)


def search(constant: float = 1.0, **options: Any) -> tuple[Any, list[int]]:
    """A search in a program of second order, and the resolutions that it computes."""
    computed: list[int] = []

    def compute(side: int) -> Any:
        computed.append(side)
        return run(side, constant / side**2)

    return script("_error_search").Search({}, compute, **options), computed


@pytest.mark.parametrize("deviation", [0.005, 0.002, 0.0012, 1e-4])
def test_the_search_finds_the_coarsest_that_is_close_enough(deviation: float) -> None:
    made, _ = search(first=8)
    found = made.coarsest(deviation)
    exact = deviation**-0.5
    assert exact <= found.side <= max(exact + 4, 1.07 * exact)
    assert found.deviation <= deviation


def test_what_one_deviation_has_computed_serves_the_next() -> None:
    made, computed = search(first=8)
    for deviation in (0.005, 0.002, 0.005):
        made.coarsest(deviation)
    assert len(set(computed)) == len(computed)


def test_no_run_is_begun_that_would_take_too_long() -> None:
    made, computed = search(first=8, longest=20.0)
    assert made.coarsest(1e-4) is None
    assert max(computed) in (24, 28)  # 14 and 22 seconds


def test_a_program_that_is_close_enough_at_once_is_not_searched_further() -> None:
    made, computed = search(first=20, constant=0.01)
    assert made.coarsest(0.005).side == 20
    assert computed == [20]


def test_runs_that_fail_are_passed() -> None:
    made, _ = search(first=8)
    made.runs[8] = run(8, math.inf)
    assert made.coarsest(0.01).side >= 10


def test_the_curve_is_interpolated_in_logarithms_and_leaves_slow_runs_out() -> None:
    time_to = script("_error_search").time_to
    runs = [run(10, 0.01, 1.0), run(20, 0.0025, 8.0)]
    assert time_to(runs, 0.005) == pytest.approx(math.sqrt(8.0))
    assert time_to([*runs, run(15, 0.02, 3.0), run(16, math.inf, 2.0)], 0.005) == pytest.approx(math.sqrt(8.0))
    assert time_to(runs, 0.0025) == pytest.approx(8.0)
    assert time_to(runs, 0.02) is None
    assert time_to(runs, 0.001) is None


def test_the_table_has_ratios_where_both_reach_a_deviation() -> None:
    lines = script("_error_search").table({"a": [2.0, 3.0], "b": [5.0, None]}, (0.01, 0.001), "a")
    assert lines[1].split() == ["a", "2", "3"]
    assert lines[2].split() == ["b", "5", "(2.5", "x)", "not", "reached"]


def test_runs_are_kept_by_program_version_processor_and_reynolds_number(tmp_path: Path) -> None:
    kept_in = script("_error_search").Kept
    kept = kept_in(tmp_path / "runs.json")
    rows = [run(20, 0.01), run(12, math.inf), replace(run(20, 0.01), version="a 2")]
    rows += [replace(run(20, 0.01), reynolds=1000), replace(run(20, 0.01), processor="there")]
    for row in rows:
        kept.add(row)
    again = kept_in(tmp_path / "runs.json")
    assert again.of("a", "a 1", "here", 100) == {20: rows[0], 12: rows[1]}
    again.drop("a", "here")
    assert again.runs == [rows[-1]]


def test_the_case_of_icofoam_has_whole_steps_of_its_courant_number(tmp_path: Path) -> None:
    icofoam = script("_icofoam")
    assert icofoam.write_case(tmp_path, 20, 1000.0, 40.0, courant=0.5) == 1600
    control = (tmp_path / "system" / "controlDict").read_text()
    assert "endTime 40.0; deltaT 0.025;" in control
    assert "writeInterval 1600;" in control
    assert "nu 0.001;" in (tmp_path / "constant" / "transportProperties").read_text()
    assert "(20 20 1)" in (tmp_path / "system" / "blockMeshDict").read_text()
    for file in icofoam.FILES:
        text = (tmp_path / file).read_text()
        assert text.count("{") == text.count("}") > 0


@pytest.mark.parametrize("side", [7, 8])
def test_profiles_are_read_from_the_file_of_icofoam(side: int, tmp_path: Path) -> None:
    icofoam = script("_icofoam")
    centres = (np.arange(side) + 0.5) / side
    y, x = np.meshgrid(centres, centres, indexing="ij")
    u, v = y**2 * (1 + x - 0.5), x * (1 - x) * (1 + y - 0.5)  # splines and means over the line have them exactly
    rows = "\n".join(f"({a:.12g} {b:.12g} 0)" for a, b in zip(u.ravel(), v.ravel(), strict=True))
    for time in ("0", "2.5"):
        (tmp_path / time).mkdir()
    text = f"dimensions [0 1 -1 0 0 0 0];\ninternalField   nonuniform List<vector> \n{side**2}\n(\n{rows}\n)\n;\n"
    (tmp_path / "2.5" / "U").write_text(text)
    stations = np.linspace(0.05, 0.95, 7)
    lines = icofoam.profiles(tmp_path, side, 2.5, stations)
    np.testing.assert_allclose(lines["u"][1], stations**2, atol=1e-11)
    np.testing.assert_allclose(lines["v"][1], stations * (1 - stations), atol=1e-11)
    with pytest.raises(SystemExit, match=r"last time is 2\.5 and not 3"):
        icofoam.profiles(tmp_path, side, 3.0, stations)


def test_the_time_of_icofoam_is_the_last_that_it_says() -> None:
    said = "Time = 1\nExecutionTime = 0.5 s  ClockTime = 2 s\n\nTime = 2\nExecutionTime = 1.25 s  ClockTime = 4 s\n"
    assert script("_icofoam").execution_time(said) == 1.25


def test_deviations_are_those_that_a_run_of_the_cavity_reports() -> None:
    programs = script("_cavity_programs")
    known = programs.references.mac(100, 20)
    lines = {
        name: (programs.STATIONS, getattr(known, name).at(programs.STATIONS) + by)
        for name, by in (("u", 0.01), ("v", -0.02))
    }
    assert programs.deviation(100, 20, lines) == pytest.approx(0.015)
    lines["u"][1][3] = np.nan
    assert programs.deviation(100, 20, lines) == math.inf


def test_particles_of_other_programs_are_read_off_as_those_of_sphear() -> None:
    ticks = (np.arange(20) + 0.5) / 20
    positions = np.stack(np.meshgrid(ticks, ticks), -1).reshape(-1, 2)
    x, y = positions.T
    lines = script("_cavity_programs").read_off(positions, np.stack((y**2 + x, x * y), 1), 0.05)
    stations = lines["u"][0]
    np.testing.assert_allclose(lines["u"][1], stations**2 + 0.5, atol=1e-9)
    np.testing.assert_allclose(lines["v"][1], 0.5 * stations, atol=1e-9)


def test_the_whole_benchmark_searches_tells_keeps_and_draws(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Programs of second order, one of which takes twelve times as long; the others are not installed."""
    whole, programs = script("to_an_error"), script("_cavity_programs")
    slow = {programs.Sphear: 1.0, programs.IcoFoam: 12.0}
    for program, cost in slow.items():
        monkeypatch.setattr(program, "version", lambda self: "1")
        monkeypatch.setattr(
            program, "compute", lambda self, _, side, __, cost=cost: (1, cost * side**3, 10.0 / side**2)
        )
    monkeypatch.setattr(programs.PySPH, "version", lambda self: None)
    files = {name: str(tmp_path / name) for name in ("runs.json", "told.json", "picture.png")}
    arguments = ["--runs", files["runs.json"], "--json", files["told.json"], "--picture", files["picture.png"]]
    monkeypatch.setattr(sys, "argv", ["to_an_error.py", "--longest", "1e9", *arguments])
    whole.main()
    said = capsys.readouterr().out
    assert said.count(programs.PySPH.missing) == 1
    assert "MISSED" not in said
    assert (tmp_path / "picture.png").read_bytes()[1:4] == b"PNG"
    told = json.loads((tmp_path / "told.json").read_text())["results"]
    ratios = [row["value"] for row in told if "time" in row["what"]]
    assert ratios == pytest.approx([12.0] * 2 * len(whole.DEVIATIONS))
    monkeypatch.setattr(programs.IcoFoam, "compute", None)  # all are known
    whole.main()


def test_the_script_of_sphear_prints_what_is_kept() -> None:
    steps, seconds, deviation = script("_cavity_programs").Sphear().compute(100, 8, 0.5)
    assert steps > 3
    assert seconds > 0
    assert deviation == math.inf  # no profiles are known at this time


@pytest.mark.skipif("not __import__('shutil').which('icoFoam')")
def test_icofoam_computes_a_cavity() -> None:
    steps, seconds, deviation = script("_cavity_programs").IcoFoam().compute(100, 12, 20)
    assert steps == 240
    assert seconds > 0
    assert 0.01 < deviation < 0.05
