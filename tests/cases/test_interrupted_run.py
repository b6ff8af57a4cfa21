"""Ctrl-C where it really comes: in the compiled loop; and files that were damaged."""

from __future__ import annotations

import json
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sphear.cases.flow import FLOWS, CaseRun
from sphear.errors import SphearError
from sphear.schemes.presets import PRESETS
from sphear.simulation.saved import checksum, earlier, forget, read, recover

CASE = FLOWS["poiseuille"]
SCHEMES: dict[str, dict[str, Any]] = {
    "midpoint": {},
    "kick drift kick": {"integrator": "kick_drift_kick"},
    "a gas": {"equation_of_state": "ideal_gas"},
}


def start(scheme: str = "midpoint") -> CaseRun:
    return CaseRun(CASE, CASE.settings(**{**PRESETS["basa2009"], **SCHEMES[scheme]}, resolution=10, until=0.1))


class Interrupted:
    """A compiled program that Ctrl-C meets in one of its runs: Python raises it as the run returns."""

    def __init__(self, program: Any, call: int) -> None:
        self.program, self.left = program, call

    def run(self, *arguments: Any) -> Any:
        made = self.program.run(*arguments)
        self.left -= 1
        if self.left == 0:
            raise KeyboardInterrupt
        return made


def interrupted(run: CaseRun, call: int, path: Path) -> CaseRun:
    run.flow.__dict__["_program"] = Interrupted(run.flow.__dict__["_program"], call)
    with pytest.raises(KeyboardInterrupt):
        run.run(keep=path)
    return run


@pytest.mark.parametrize("call", [1, 2, 5])  # while it compiles, in the first steps, later
@pytest.mark.parametrize("scheme", SCHEMES)
def test_steps_that_the_clock_does_not_know_are_not_kept(scheme: str, call: int, tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    stopped = interrupted(start(scheme), call, path)
    again = start(scheme)
    again.restore(path)
    assert (again.flow.steps, again.history) == (stopped.flow.steps, stopped.history)
    whole = start(scheme).run()
    assert again.run().history == whole.history
    for name, values in whole.flow.state().items():
        np.testing.assert_array_equal(again.flow.state()[name], values)


def test_an_interrupted_run_stands_at_its_last_output(tmp_path: Path) -> None:
    stopped = interrupted(start(), 5, tmp_path / "state.npz")
    assert len(stopped.history) == 3
    assert stopped.flow.steps == stopped.history[-1]["steps"]
    assert stopped.flow.time == pytest.approx(stopped.history[-1]["time"] * stopped.unit)


@pytest.mark.parametrize("changes", [{}, {"max_steps": 30}])
def test_a_run_that_is_interrupted_at_its_last_output_makes_no_further_step(
    changes: dict[str, Any], tmp_path: Path
) -> None:
    settings = CASE.settings(**{**PRESETS["basa2009"], **changes}, resolution=10, until=0.1)
    path = tmp_path / "state.npz"
    whole = CaseRun(CASE, settings).run()

    def interrupt(text: str) -> None:
        if stopped.flow.steps == whole.flow.steps:
            raise KeyboardInterrupt

    stopped = CaseRun(CASE, settings)
    with pytest.raises(KeyboardInterrupt):
        stopped.run(interrupt, keep=path)
    again = CaseRun(CASE, settings)
    again.restore(path)
    again.run()
    assert (again.end, again.flow.steps, again.history) == (whole.end, whole.flow.steps, whole.history)


DAMAGES: dict[str, Callable[[bytes], bytes]] = {
    "empty": lambda whole: b"",
    "half": lambda whole: whole[: len(whole) // 2],
    "the start alone": lambda whole: whole[:4],
    "a byte changed": lambda whole: whole[: len(whole) // 2] + b"\xff\x00" + whole[len(whole) // 2 + 2 :],
    "another file": lambda whole: b"\x89PNG\r\n",
    "one array": lambda whole: whole[whole.index(b"\x93NUMPY") :],
}


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_file_is_refused_in_one_sentence(damage: str, tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    run = start()
    run.save(path)
    path.write_bytes(DAMAGES[damage](path.read_bytes()))
    with pytest.raises(SphearError, match=r"^there is no saved run in .* that could be gone on with$"):
        run.restore(path)


SPOILS: dict[str, Callable[[dict[str, Any]], dict[str, Any]]] = {
    "a place is not a number": lambda state: {
        **state,
        "position": np.where(state["position"] > 0.5, np.nan, state["position"]),
    },
    "places are text": lambda state: {**state, "position": state["position"].astype(str)},
    "places are complex": lambda state: {**state, "position": state["position"].astype(complex)},
    "the clock is not a number": lambda state: {**state, "clock": np.full(2, np.nan)},
    "no text": lambda state: {key: values for key, values in state.items() if key != "about"},
    "nothing said": lambda state: {**state, "about": np.array("[]")},
}
SAID: dict[str, tuple[str, Any]] = {
    "settings": ("settings", [1]), "no settings": ("settings", None), "case": ("case", 3),
    "seconds": ("seconds", "long"), "time before": ("seconds", -1.0),
    "history": ("history", [{"time": "soon", "steps": 1}]), "rows": ("history", [{}]),
}  # fmt: skip


def damaged(path: Path, spoil: Callable[[dict[str, Any]], dict[str, Any]]) -> None:
    with np.load(path, allow_pickle=False) as file:
        state = spoil({name: values for name, values in file.items() if name != "checksum"})
    np.savez(path, allow_pickle=False, checksum=np.array(checksum(state)), **state)


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("spoil", SPOILS)
def test_numbers_that_make_no_sense_are_refused_in_one_sentence(spoil: str, scheme: str, tmp_path: Path) -> None:
    path, run = tmp_path / "state.npz", start(scheme)
    run.save(path)
    damaged(path, SPOILS[spoil])
    with pytest.raises(SphearError, match=r"^there is no saved run in .* that could be gone on with$"):
        run.restore(path)


@pytest.mark.parametrize("what", SAID)
def test_a_text_that_makes_no_sense_is_refused_in_one_sentence(what: str, tmp_path: Path) -> None:
    path, run = tmp_path / "state.npz", start()
    run.save(path)
    key, value = SAID[what]
    damaged(
        path, lambda state: {**state, "about": np.array(json.dumps({**json.loads(str(state["about"])), key: value}))}
    )
    with pytest.raises(SphearError, match=r"^there is no saved run in .* that could be gone on with$"):
        run.restore(path)


def test_a_saved_run_is_known_by_any_alias(tmp_path: Path) -> None:
    CaseRun(FLOWS["cavity"], FLOWS["cavity"].settings(viscosity="morris", resolution=10)).save(tmp_path / "state.npz")
    CaseRun(FLOWS["cavity"], FLOWS["cavity"].settings(viscosity="E", resolution=10)).restore(tmp_path / "state.npz")


@pytest.mark.parametrize("place", range(0, 1600, 37))
def test_no_changed_byte_is_a_traceback(place: int, tmp_path: Path) -> None:
    path, run = tmp_path / "state.npz", start()
    run.save(path)
    whole = bytearray(path.read_bytes())
    whole[place] ^= 0xFF
    path.write_bytes(bytes(whole))
    with suppress(SphearError):
        run.restore(path)


def test_the_state_of_a_flow_of_another_size_is_refused(tmp_path: Path) -> None:
    state = start().flow.state()
    run = start()
    with pytest.raises(SphearError, match=r"the saved state has no position of the shape \(100, 2\)"):
        run.flow.restore({**state, "position": state["position"][1:]})
    del state["velocity"]
    with pytest.raises(SphearError, match="the saved state has no v"):
        run.flow.restore(state)


def saved_twice(path: Path) -> tuple[bytes, bytes]:
    """The bytes of a state, and of the one three steps later, which has the name now."""
    run = start()
    run.save(path)
    before = path.read_bytes()
    run.flow.advance(3)
    run.save(path)
    return before, path.read_bytes()


def test_saving_again_keeps_the_file_before_and_no_other(tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    before, now = saved_twice(path)
    assert before != now
    assert earlier(path).read_bytes() == before
    start().save(path)
    assert earlier(path).read_bytes() == now
    assert sorted(tmp_path.iterdir()) == sorted([path, earlier(path)])
    forget(path)
    assert list(tmp_path.iterdir()) == []


def test_an_array_that_is_not_the_one_that_was_saved_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    start().save(path)
    with np.load(path, allow_pickle=False) as file:
        members = dict(file)
    np.savez(path, allow_pickle=False, **{**members, "position": np.nextafter(members["position"], np.inf)})
    with pytest.raises(SphearError, match="there is no saved run in"):
        read(path)


@pytest.mark.parametrize("damage", [*DAMAGES, "missing"])
def test_the_state_before_takes_the_place_of_one_that_is_damaged(damage: str, tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    before, now = saved_twice(path)
    if damage == "missing":
        path.unlink()
    else:
        path.write_bytes(DAMAGES[damage](now))
    said = recover(path)
    assert said is not None
    assert said.endswith(f"was {'missing' if damage == 'missing' else 'damaged'}: the one before it is taken")
    assert path.read_bytes() == before
    assert not earlier(path).exists()


def test_a_state_that_is_whole_is_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    before, now = saved_twice(path)
    assert recover(path) is None
    assert (earlier(path).read_bytes(), path.read_bytes()) == (before, now)


def test_where_both_states_are_damaged_nothing_is_taken(tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    saved_twice(path)
    path.write_bytes(b"")
    earlier(path).write_bytes(b"")
    assert recover(path) is None
    assert path.read_bytes() == b""
