"""A flow by its name and settings by theirs."""

from __future__ import annotations

from typing import Any

import pytest

import sphear
from sphear.errors import SphearError


def test_a_flow_runs_to_its_end_with_the_settings_that_were_given() -> None:
    run = sphear.flow("taylor_green", viscosity="E", reynolds=50, resolution=12, until=0.02)
    assert (run.end, run.history) == ("", [])
    assert run.run().end == "time"
    settings = run.as_dict()["settings"]
    assert (settings["viscosity"], settings["reynolds"], settings["resolution"]) == ("morris", 50.0, 12)
    assert run.flow.velocities.shape == (144, 2)


MORE: tuple[dict[str, Any], ...] = ({}, {"preset": "basa2009"}, {"preset": "basa2009", "kernel": "quintic"})


def test_what_is_given_goes_before_a_preset_and_that_before_the_defaults_of_the_case() -> None:
    plain, whole, part = (sphear.flow("cavity", resolution=12, **more).settings.model_dump() for more in MORE)
    assert whole["kernel"] != plain["kernel"]
    assert {name for name in whole if whole[name] != part[name]} == {"kernel"}
    incompressible = sphear.flow(
        "cavity", preset="zheng2018", scheme="incompressible", resolution=12
    ).settings.model_dump()
    assert incompressible["walls"] == "sfdi"


WRONG: dict[str, tuple[str, dict[str, Any], str]] = {
    "case": ("cavitty", {}, "no case named 'cavitty': did you mean cavity"),
    "preset": ("cavity", {"preset": "base2009"}, "no preset named 'base2009': did you mean basa2009"),
    "setting": ("cavity", {"reynold": 5}, "no setting named 'reynold': did you mean reynolds"),
    "value": ("cavity", {"reynolds": -1}, "the setting reynolds"),
    "kind": ("cavity", {"resolution": "many"}, "the setting resolution"),
    "scheme": ("dam-break", {"scheme": "explicit"}, "explicit"),
}


@pytest.mark.parametrize("what", WRONG)
def test_a_mistake_is_one_sentence(what: str) -> None:
    case, settings, sentence = WRONG[what]
    with pytest.raises(SphearError) as raised:
        sphear.flow(case, **settings)
    assert sentence in str(raised.value)
    assert "\n" not in str(raised.value)
