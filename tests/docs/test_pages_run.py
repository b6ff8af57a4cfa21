"""The code that pages show runs, and does what they say."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import sphear

DOCS = Path(__file__).parents[2] / "docs"
MOVE = (DOCS / "how-to" / "move-from-0.1.md").read_text(encoding="utf-8")
BLOCK = re.compile(r"(?P<before>In 0\.1:\n\n)?```python\n(?P<code>.*?)```", re.DOTALL)


@pytest.fixture
def module(monkeypatch: pytest.MonkeyPatch) -> Iterator[ModuleType]:
    """The module that the blocks of a page are run in; names that they register are forgotten."""
    made = ModuleType("shown")
    monkeypatch.setitem(sys.modules, "shown", made)
    yield made
    for name in set(sphear.VISCOSITY) - sphear.VISCOSITY.published:
        sphear.VISCOSITY.remove(name)


def run(page: str, module: ModuleType) -> Iterator[dict[str, Any]]:
    """Run the blocks of a page, but those of 0.1, one after the other; the names that each leaves behind."""
    for block in BLOCK.finditer((DOCS / page).read_text(encoding="utf-8")):
        if not block["before"]:
            exec(compile(block["code"], "shown", "exec", dont_inherit=True), vars(module))
            yield vars(module)


def test_the_tutorial(module: ModuleType, capsys: pytest.CaptureFixture[str]) -> None:
    first, second = (dict(names) for names in run("tutorial.md", module))
    assert first["simulation"].time == pytest.approx(1, abs=first["simulation"].flow.time_step)
    (printed,) = re.findall(r"```text\n(.*?)```", (DOCS / "tutorial.md").read_text(encoding="utf-8"), re.DOTALL)
    assert capsys.readouterr().out.startswith(printed)
    assert len(second["history"].table["time"]) == 11  # at the start and every tenth
    assert second["profile"].values.min() < -0.05


def test_running_a_case(module: ModuleType) -> None:
    (names,) = run("how-to/run-a-case.md", module)
    assert names["run"].end == "time"


def test_composing_a_simulation(module: ModuleType) -> None:
    cylinder, swirl, observer, channel = (dict(names) for names in run("how-to/simulations.md", module))
    assert cylinder["simulation"].end == "time"
    assert len(cylinder["simulation"].history["kinetic_energy"]) == 6
    assert swirl["simulation"].time >= 0.2
    assert issubclass(observer["Largest"], sphear.Observer)
    assert channel["run"].end == "time"


def test_comparing_with_a_reference(module: ModuleType) -> None:
    (names,) = run("how-to/compare-with-a-reference.md", module)
    assert np.abs(names["profile"].values - names["exact"]).max() < 1e-3


def test_what_scripts_of_0_1_become(module: ModuleType) -> None:
    walls, presets, own, channel, watched, names = (dict(found) for found in run("how-to/move-from-0.1.md", module))
    assert walls["run"].settings.walls == "sfdi"
    assert (presets["old"].settings.density, presets["new"].settings.density) == ("summation", "continuity")
    assert len(own["simulation"].history["divergence"]) == 3
    assert channel["simulation"].velocities[:, 0].max() > 0
    assert watched["simulation"].end == "stopped"
    assert 0.2 < watched["simulation"].time < 0.5
    assert len(watched["speeds"].rows) == -(-watched["simulation"].steps // 2)
    x = np.random.default_rng(0).random((300, 2))
    np.testing.assert_allclose(sphear.laplacian(x, x[:, 0], viscosity="mine"), sphear.laplacian(x, x[:, 0]), rtol=1e-9)
    assert names["sphear"].VISCOSITY["gotoh_printed"] == sphear.Gotoh(printed=True)


@pytest.fixture
def small(module: ModuleType, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> ModuleType:
    """The module with a small simulation, which writes into a folder of its own."""
    monkeypatch.chdir(tmp_path)
    made = cavity()
    parts = {"region": made.region, "fluid": made.fluid, "boundaries": made.boundaries}
    vars(module).update(sphear=sphear, simulation=made, **parts)
    return module


def cavity() -> sphear.Simulation:
    return sphear.Simulation(
        sphear.Rectangle((0, 0), (1, 1)),
        spacing=0.1,
        fluid=sphear.Fluid(kinematic_viscosity=0.05),
        boundaries={"upper": sphear.NoSlip(velocity=(1, 0))},
        observers=[sphear.History(every=0.5)],
    )


def test_going_on_with_a_simulation(small: ModuleType) -> None:
    (names,) = run("how-to/resume.md", small)
    assert 10 <= names["simulation"].time < 10 + names["simulation"].flow.time_step
    assert cavity().restore("state.npz").time == pytest.approx(5, abs=names["simulation"].flow.time_step)


def test_reading_results(small: ModuleType, tmp_path: Path) -> None:
    page = (DOCS / "how-to" / "read-results.md").read_text(encoding="utf-8")
    first = small.simulation.run(until=1)
    blocks = [block["code"] for block in BLOCK.finditer(page) if "pandas" not in block["code"]]
    assert len(blocks) == 3
    for block in blocks:
        exec(compile(block, "shown", "exec", dont_inherit=True), vars(small))
    assert np.load("flow.npz")["velocities"].shape == (100, 2)
    history = np.genfromtxt("history.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(history["time"], first.history["time"])
    assert (tmp_path / "flow.png").stat().st_size > 1000


@pytest.mark.parametrize(("old", "new"), re.findall(r"^\| `(\w+=\w+)` \| `(\w+=\w+)` \|$", MOVE, re.MULTILINE))
def test_settings_of_0_1_are_refused_and_the_new_ones_taken(old: str, new: str) -> None:
    (key, value), (name, chosen) = old.split("="), new.split("=")
    with pytest.raises(sphear.SphearError, match=rf"{key} of 0\.1 is called {name}"):
        sphear.flow("cavity", scheme="incompressible", **{key: value})  # type: ignore[arg-type]
    run = sphear.flow("cavity", scheme="incompressible", resolution=12, **{name: chosen})  # type: ignore[arg-type]
    assert getattr(run.settings, name) == chosen


def test_the_presets_of_0_1_are_gone() -> None:
    assert len(re.findall(r"^\| `(\w+=\w+)` \| `(\w+=\w+)` \|$", MOVE, re.MULTILINE)) == 4
    for name in ("modern", "paper"):
        with pytest.raises(sphear.SphearError, match="there is no preset"):
            sphear.flow("cavity", preset=name)
