"""Stored results that are not what their file's name says: none is believed, and none makes a traceback."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from typing import Any

import pytest

from sphear.sweeps import Run, Store, SweepResult, plan
from sphear.sweeps.store import LARGEST
from sphear.sweeps.trusted import FORMAT

RUN = plan("poiseuille", {"resolution": [10]}, {"until": 0.05})[0]
OTHER = plan("poiseuille", {"resolution": [10]}, {"until": 0.05, "reynolds": 3.0})[0]

Record = dict[str, Any]


def record(run: Run = RUN) -> Record:
    """A stored result, as a flow leaves it."""
    row = {"time": 0.05, "steps": 97, "rms_error": 0.01}
    return {
        "format": FORMAT,
        "case": run.case,
        "settings": {**run.given, "h_over_dx": 1.57, "sound_speed": 3.5, "time_step": 1e-3, "momentum": "squares"},
        "metrics": {**row, "end": "time", "failure_time": None},
        "end": "time",
        "performance": {"particles": 100, "steps": 97, "seconds": 0.1},
        "history": [row],
    }


def put(store: Store, text: str) -> None:
    store.folder.path.mkdir(exist_ok=True)
    store.path(RUN).write_text(text)


def test_what_a_flow_leaves_is_believed(store: Store) -> None:
    put(store, json.dumps(record()))
    result, fault = store.read(RUN)
    assert fault is None
    assert result is not None
    assert result.metrics["rms_error"] == 0.01


def test_a_result_from_before_formats_and_newer_settings_is_believed(store: Store) -> None:
    old = record()
    del old["format"], old["settings"]["shifting_strength"]
    put(store, json.dumps(old))
    assert store.read(RUN)[1] is None


def changed(*path: str, to: Any) -> Callable[[], Record]:
    def change() -> Record:
        whole = json.loads(json.dumps(record()))
        place = whole
        for key in path[:-1]:
            place = place[key]
        place[path[-1]] = to
        return dict(whole)

    return change


def ending(end: str) -> Callable[[], Record]:
    return lambda: {**record(), "end": end, "metrics": {**record()["metrics"], "end": end}}


FORGED: dict[str, tuple[Callable[[], Any], str]] = {
    "another run's": (lambda: record(OTHER), "its reynolds is 3.0, not 0.5"),
    "another case's": (changed("case", to="couette"), "it is of couette"),
    "no settings": (changed("settings", to={}), "its resolution is 20, not 10"),
    "a setting of another type": (changed("settings", "resolution", to="10"), "its resolution is 10, not 10"),
    "true for one": (changed("settings", "reynolds", to=True), "its reynolds is True"),
    "a nested setting": (changed("settings", "h_over_dx", to=[1]), "its h_over_dx is a list"),
    "no metrics": (changed("metrics", to={}), "its end and that of its metrics differ"),
    "no time": (changed("metrics", to={"end": "time"}), "its metrics lack the time"),
    "text for a number": (changed("metrics", "rms_error", to="0.01"), "the rms_error of its metrics is 0.01"),
    "a list for a number": (changed("metrics", "rms_error", to=[0.01]), "the rms_error of its metrics is a list"),
    "true for a number": (changed("metrics", "rms_error", to=True), "the rms_error of its metrics is True"),
    "any end": (ending("well"), "its end is well"),
    "an end of another case": (ending("the front is at the wall"), "its end is the front is at the wall"),
    "two ends": (changed("end", to="steady"), "its end and that of its metrics differ"),
    "another format": (changed("format", to=2), "its format is 2, and this sphear writes 1"),
    "rows that are none": (changed("history", to=[1]), "its history has more than rows"),
    "text in a row": (changed("history", to=[{"time": "now"}]), "the time of its history is now"),
    "profiles that are none": (changed("profiles", to={"u": 1}), "its profiles are no lists"),
    "text in a profile": (changed("profiles", to={"u": [0.0, "a"]}), "the 1 of its profile u is a"),
    "nested performance": (changed("performance", "seconds", to={}), "its performance has more than numbers"),
    "a list": (list, "it is no result"),
    "more parts": (changed("more", to=1), "it has not the parts of a result"),
    "long text": (changed("metrics", "rms_error", to="x" * 10_000), "xxx..."),
}


@pytest.mark.parametrize("what", FORGED)
def test_what_is_forged_is_not_believed(what: str, store: Store) -> None:
    forged, sentence = FORGED[what]
    put(store, json.dumps(forged()))
    result, fault = store.read(RUN)
    assert result is None
    assert fault is not None
    assert sentence in fault
    assert len(fault) < 200
    assert store.get(RUN) is None


@pytest.mark.parametrize("text", ["[" * 100_000, '{"case": NaN}', "1e999", "\x00", json.dumps(record())[:-3]])
def test_what_is_no_json_is_not_whole(text: str, store: Store) -> None:
    put(store, text)
    result, fault = store.read(RUN)
    assert result is None
    assert fault in ("it is not whole", "it is no result")


def test_a_file_too_large_is_not_read(store: Store) -> None:
    put(store, "")
    os.truncate(store.path(RUN), LARGEST + 1)
    assert store.read(RUN) == (None, "it is too large for a result")


def test_a_folder_in_place_of_a_result_is_set_aside(store: Store) -> None:
    whole = SweepResult(**{key: value for key, value in record().items() if key != "format"})
    for number in range(2):
        if number:
            store.path(RUN).unlink()
        store.path(RUN).mkdir(parents=True)
        (store.path(RUN) / "mine").touch()
        assert store.read(RUN) == (None, "it is a folder")
        store.put(RUN, whole)
        assert store.get(RUN) == whole
    kept = sorted(path.name for path in store.folder.path.rglob("*") if path.is_dir())
    assert kept == [f"{RUN.key}.json.aside", f"{RUN.key}.json.aside-2"]
    assert len(list(store.folder.path.rglob("mine"))) == 2
