"""Sweeps over settings of more than one scheme."""

from __future__ import annotations

import pytest

from sphear.errors import SphearError
from sphear.sweeps import Store, plan, run_sweep


def test_schemes_are_gone_through_like_any_setting() -> None:
    explicit, incompressible = plan("cavity", {"scheme": ["explicit", "incompressible"]}, {"resolution": 12})
    assert (explicit.settings.scheme, incompressible.settings.scheme) == ("explicit", "incompressible")
    assert incompressible.key.startswith("cavity-incompressible-fatehi_manzari-none-re100-n12-")
    assert explicit.key.startswith("cavity-fatehi_manzari-bonet_lok-re100-n12-")
    assert incompressible.cost > 0


def test_aliases_and_what_does_not_matter_leave_the_key_alone() -> None:
    fixed = {"scheme": "incompressible", "resolution": 12}
    keys = [
        plan("cavity", {"threads": [1]}, {**fixed, **changes})[0].key
        for changes in (
            {"viscosity": "oger"}, {"viscosity": "VISC-04"}, {"viscosity": "oger", "preconditioner": "spectral"},
            {"viscosity": "oger", "laplacian": "E"}, {"viscosity": "oger", "force": True},
            {"viscosity": "oger", "preconditioner": "amg"}, {"viscosity": "oger", "alpha": 0.1},
        )
    ]  # fmt: skip
    assert len(set(keys[:5])) == 1
    assert len(set(keys)) == 3


def test_settings_that_do_not_go_together_are_refused_before_the_first_run() -> None:
    with pytest.raises(SphearError, match="narrower than the support"):
        plan("cavity-cylinder", {"diameter": [0.5, 0.95]}, {"resolution": 24})
    with pytest.raises(SphearError, match="no setting named 'diametre'"):
        plan("cavity-cylinder", {"diametre": [0.5]})
    with pytest.raises(SphearError, match="no setting named 'diameter'"):
        plan("cavity", {"diameter": [0.5]}, {"scheme": "incompressible"})


def test_runs_are_computed_by_workers_and_kept(store: Store) -> None:
    runs = plan("cavity", {"alpha": [0.0, 0.1]}, {"scheme": "incompressible", "resolution": 12, "max_steps": 2})
    results = run_sweep(runs, store)
    assert [result.end for result in results] == ["steps", "steps"]
    assert [result.settings["alpha"] for result in results] == [0.0, 0.1]
    assert {"u", "v", "stations"} == set(results[0].profiles)
    assert [store.get(run) for run in runs] == results
