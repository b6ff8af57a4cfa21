"""What is not compared, because a reference is not of that time or has decayed to nothing, is said."""

from __future__ import annotations

import json
import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from sphear.cases.flow import FLOWS, dam_break, taylor_green
from sphear.cases.flow.run import CaseRun
from sphear.results.finite import finite
from sphear.sweeps.result import of_record, record

VORTEX = FLOWS["taylor-green"]


@pytest.mark.parametrize("scheme", ["explicit", "incompressible"])
def test_a_vortex_that_has_decayed_to_nothing_has_no_relative_error(scheme: str) -> None:
    run = CaseRun(VORTEX, VORTEX.settings(scheme=scheme, reynolds=0.01, resolution=8, max_steps=1, threads=1)).run()
    flow: Any = run.flow
    flow.time = 5.0  # exp(-790 / Re) is no number
    found = VORTEX.metrics(run.settings, flow)
    assert math.isnan(found["l2_error"])
    assert math.isnan(found["kinetic_energy_ratio"])
    assert np.isfinite(found["kinetic_energy"])
    said = VORTEX.summary(run.settings, flow)["reference_missing"]
    assert said.startswith("the exact flow is below 1e-12 of its start from t U / L = 0.0035 on")
    run.history[-1] |= found
    kept = of_record(json.loads(json.dumps(finite(record(run)))))
    assert kept is not None
    assert kept.metrics["l2_error"] is None


def test_a_vortex_that_is_still_there_is_compared() -> None:
    settings = VORTEX.settings(reynolds=1.0, resolution=8)
    flow: Any = CaseRun(VORTEX, settings).flow
    assert VORTEX.metrics(settings, flow)["l2_error"] == 0.0
    assert VORTEX.summary(settings, flow) == {}
    flow.time = -math.log(taylor_green.LEAST_DECAY) / (8 * math.pi**2)
    for share, gone in ((0.99, False), (1.01, True)):
        at: Any = SimpleNamespace(time=share * flow.time)
        assert taylor_green.gone(settings, at) == gone


@pytest.mark.parametrize(("time", "missing"), [(0.1, True), (1.0, False), (5.0, True)])
def test_the_front_of_a_dam_break_is_compared_while_it_was_measured(time: float, missing: bool) -> None:
    case = FLOWS["dam-break"]
    settings = case.settings(resolution=4)
    flow: Any = CaseRun(case, settings).flow
    flow.time = time / dam_break.speed(settings)
    found = case.summary(settings, flow)
    if missing:
        assert found == {"reference_missing": f"the front was measured from T = 0.41 to 3.33, and this is T = {time:g}"}
    else:
        assert found == {
            "front_deviation": pytest.approx(1.0 - np.interp(time, *case.reference_history(settings) or ()))
        }
