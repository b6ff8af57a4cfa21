"""The parts of the benchmark of incompressible steps: source trees, runs in processes of their own, what is told."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def step() -> Any:
    sys.path.insert(0, str(ROOT / "benchmarks"))
    yield importlib.import_module("incompressible_step")
    sys.path.remove(str(ROOT / "benchmarks"))


class Heard:
    """A report that keeps what it is told."""

    def __init__(self) -> None:
        self.rows: dict[str, float] = {}

    def add(self, what: str, value: float, unit: str = "", **asked: float) -> None:
        self.rows[what.strip()] = value


def test_a_folder_without_the_package_is_refused(step: Any, tmp_path: Path) -> None:
    with pytest.raises(SystemExit, match="has no src/sphear: name the folder of a checkout"):
        step.tree(tmp_path)


def test_the_sphear_of_another_place_is_noticed(step: Any, tmp_path: Path) -> None:
    (tmp_path / "src" / "sphear").mkdir(parents=True)
    (tmp_path / "src" / "sphear" / "__init__.py").write_text("raise ImportError('another sphear')")
    with pytest.raises(SystemExit, match="another sphear"):
        step.run(step.tree(tmp_path), "cavity", 8, 1)


@pytest.mark.parametrize(
    ("case", "side", "steps"), [("cavity", 20, 100), ("cavity", 100, 40), ("dam-break", 100, 20), ("cavity", 400, 10)]
)
def test_large_flows_make_fewer_steps(step: Any, case: str, side: int, steps: int) -> None:
    assert step.steps_of(case, side) == steps


def test_a_run_says_its_package_time_and_memory(step: Any) -> None:
    said = step.run(step.tree(ROOT), "cavity", 8, 1, steps=5)
    assert Path(said["package"]) == ROOT / "src" / "sphear"
    assert said["milliseconds"] > 0
    assert said["particles"] == 64
    assert sys.platform == "win32" or said["memory"] > 2**20


def test_trees_are_compared_by_their_least_times(step: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    times = {("this", 1): [6.0, 4.0], ("other", 1): [9.0, 8.0], ("this", 2): [2.0, 3.0], ("other", 2): [6.0, 5.0]}

    def run(where: dict[str, str], case: str, side: int, threads: int, steps: int | None = None) -> dict[str, float]:
        return {"milliseconds": times[where["name"], threads].pop(0), "particles": side**2, "memory": 1e6}

    monkeypatch.setattr(step, "run", run)
    report = Heard()
    trees = {name: {"name": name} for name in ("this", "other")}
    found = step.measured(report, trees, "cavity", 10, 2)
    assert found[1]["this"]["milliseconds"] == 4.0
    assert report.rows["cavity 10x10, a step on 2 threads, other"] == 5.0
    assert report.rows["speed on two threads over one, this"] == 2.0
    assert report.rows["time of this tree over the other's, 1 thread"] == 0.5
    assert report.rows["time of this tree over the other's, 2 threads"] == 0.4


def test_memory_is_that_beyond_a_small_flow(step: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(step, "run", lambda *_, **__: {"memory": 1000.0, "particles": 400})
    assert step.memory({"this": {}}, {"this": {"memory": 5000.0, "particles": 2400}}) == {"this": 2.0}
