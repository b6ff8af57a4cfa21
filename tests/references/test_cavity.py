"""References of the lid-driven cavity: known values, walls, corrections, and the sources against each other."""

from __future__ import annotations

import dataclasses
import math
import re
from importlib.resources import files
from pathlib import PurePosixPath
from typing import Any

import numpy as np
import pytest

from sphear.errors import SphearError
from sphear.references import cavity
from sphear.references.cavity import (
    GHIA_REYNOLDS,
    MAC_TIMES,
    MARCHI_REYNOLDS,
    OPENFOAM_TIMES,
    CavityFlow,
    Curve,
    botella_peyret,
    cavity_cylinder,
    extrema,
    ghia,
    mac,
    marchi,
    openfoam,
)

FLOWS: dict[str, CavityFlow] = {
    **{f"ghia {n}": ghia(n) for n in GHIA_REYNOLDS},
    **{f"marchi {n}": marchi(n) for n in MARCHI_REYNOLDS},
    "botella_peyret": botella_peyret(),
    **{f"openfoam {n}, {e}": openfoam(n, extrapolated=e) for n in OPENFOAM_TIMES for e in (True, False)},
    **{f"mac {n} {t}, {e}": mac(n, t, extrapolated=e) for n, s in MAC_TIMES.items() for t in s for e in (True, False)},
    **{f"cylinder, {e}": cavity_cylinder(extrapolated=e) for e in (True, False)},
}
every_flow = pytest.mark.parametrize("name", FLOWS)
computed = pytest.mark.parametrize("name", [name for name, flow in FLOWS.items() if flow.energy is not None])


@every_flow
def test_profiles_reach_from_wall_to_lid(name: str) -> None:
    flow = FLOWS[name]
    for profile, lid in ((flow.u, 1.0), (flow.v, 0.0)):
        assert (profile.stations[0], profile.stations[-1]) == (0.0, 1.0)
        assert (profile.values[0], profile.values[-1]) == (0.0, lid)
        assert (np.diff(profile.stations) > 0).all()
        assert np.isfinite(profile.values).all()
        assert not np.signbit(profile.values[profile.values == 0.0]).any()
        assert profile.stations.shape == profile.values.shape
        assert -0.6 < profile.values.min() < -0.1 < 0.1 < profile.values.max() <= 1.0


@every_flow
def test_a_flow_says_what_it_is(name: str) -> None:
    flow = FLOWS[name]
    assert len(flow.source) > 20
    assert (flow.energy is None) == (flow.time == math.inf)
    assert ("extrapolated" in flow.source) == name.endswith(", True")


@every_flow
def test_no_net_flow_crosses_the_centrelines(name: str) -> None:
    """The integrals of u and v along them vanish, as well as each table's stations allow."""
    flow = FLOWS[name]
    for profile in (flow.u, flow.v):
        pieces = [(0.0, 1.0)] if profile.gap is None else [(0.0, profile.gap[0]), (profile.gap[1], 1.0)]
        total = 0.0
        for a, b in pieces:
            x = np.linspace(a, b, 4001)
            total += float(np.trapezoid(profile.at(x), x))
        if flow.energy is not None:
            assert total == pytest.approx(0.0, abs=2e-4)
        elif flow.reynolds <= 1000:
            assert total == pytest.approx(0.0, abs=1e-2)


@computed
def test_energies_start_at_zero_and_increase(name: str) -> None:
    flow = FLOWS[name]
    assert flow.energy is not None
    assert (flow.energy.stations[0], flow.energy.values[0]) == (0.0, 0.0)
    assert (np.diff(flow.energy.values) > 0).all()
    assert flow.energy.stations[-1] >= flow.time


def test_known_values() -> None:
    spectral = botella_peyret()
    assert (spectral.reynolds, spectral.time) == (1000, math.inf)
    assert spectral.u.values.min() == -0.3885691
    assert spectral.v.values.min() == -0.5264392
    assert spectral.v.values.max() == 0.3769189
    assert spectral.u.at(0.5) == pytest.approx(-0.0620561, abs=1e-15)
    assert ghia(100).u.values.min() == -0.21090
    assert ghia(1000).u.values.min() == -0.38289
    assert marchi(100).u.at(0.5) == pytest.approx(-0.209149142, abs=1e-15)
    assert mac(1000, 40).u.values.min() == pytest.approx(-0.3872, abs=1e-4)
    assert mac(1000).u.values.min() == pytest.approx(-0.3885, abs=1e-4)


def test_stations_are_where_they_were_computed() -> None:
    """Printed to four digits, they are multiples of 1/128."""
    for flow in (ghia(1000), botella_peyret()):
        for profile in (flow.u, flow.v):
            assert len(profile.stations) == 17
            np.testing.assert_array_equal(profile.stations * 128, np.round(profile.stations * 128))
    assert marchi(400).u.stations.tolist() == [k / 16 for k in range(17)]


def test_misprints_of_ghia_are_corrected() -> None:
    assert ghia(10000).u.at(0.5) == pytest.approx(-0.03111, abs=1e-15)
    assert ghia(3200).u.at(0.453125) == pytest.approx(-0.08664, abs=1e-15)
    assert 0.90625 not in ghia(400).v.stations
    assert len(ghia(400).v.stations) == 16
    assert 0.90625 in ghia(1000).v.stations


@pytest.mark.parametrize(("reynolds", "time"), [(100, 20), (1000, 40)])
def test_both_programs_agree(reynolds: int, time: int) -> None:
    ours, theirs = mac(reynolds, time), openfoam(reynolds, time)
    assert ours.time == theirs.time == time
    assert ours.energy is not None
    assert theirs.energy is not None
    times = theirs.energy.stations[theirs.energy.stations >= 1.0]
    np.testing.assert_allclose(ours.energy.at(times), theirs.energy.at(times), rtol=1e-3)
    for a, b in ((ours.u, theirs.u), (ours.v, theirs.v)):
        np.testing.assert_allclose(a.at(b.stations), b.values, rtol=0, atol=2e-4)


def test_the_long_computation_tends_to_the_published_ones() -> None:
    long = mac(1000, 80)
    for published, error in ((botella_peyret(), 6e-4), (marchi(1000), 6e-4), (ghia(1000), 0.0185)):
        for a, b in ((long.u, published.u), (long.v, published.v)):
            np.testing.assert_allclose(a.at(b.stations), b.values, rtol=0, atol=error)
    for published, error in ((marchi(100), 1e-4), (ghia(100), 0.0095)):
        for a, b in ((mac(100).u, published.u), (mac(100).v, published.v)):
            np.testing.assert_allclose(a.at(b.stations), b.values, rtol=0, atol=error)


def test_meshes_as_they_are_have_less_energy() -> None:
    for name, low in (("openfoam", {100: 0.0031, 1000: 0.01}), ("mac", {100: 0.0031, 1000: 0.0061})):
        for reynolds, error in low.items():
            fine, limit = (getattr(cavity, name)(reynolds, extrapolated=e).energy for e in (False, True))
            assert 1.0 - fine.values[-1] / limit.values[-1] == pytest.approx(error, abs=5e-4)


def test_published_extrema() -> None:
    found = {x.source: x for x in extrema(1000)}
    spectral = found["Botella Peyret 1998"]
    assert (spectral.u_min, spectral.y_u_min) == (-0.3885698, 0.1717)
    assert (spectral.v_max, spectral.v_min, spectral.psi_min) == (0.3769447, -0.5270771, -0.1189366)
    assert spectral.note.startswith("vortex centre")
    assert "Ghia 1982" in found
    marchi_100 = {x.source: x for x in extrema(100)}["Marchi 2009"]
    assert marchi_100.y_u_min is None
    assert marchi_100.psi_min is None
    for reynolds, flow in ((1000, mac(1000)), (100, mac(100))):
        x = np.linspace(0.0, 1.0, 2001)
        for entry in extrema(reynolds):
            assert entry.reynolds == reynolds
            error = 0.013 if entry.source.startswith("Ghia") else 6e-4
            assert entry.u_min == pytest.approx(flow.u.at(x).min(), abs=error)
            assert entry.v_max == pytest.approx(flow.v.at(x).max(), abs=error)
            assert entry.v_min == pytest.approx(flow.v.at(x).min(), abs=error)


def test_the_cylinder_has_no_fluid_in_it() -> None:
    flow = cavity_cylinder()
    assert (flow.reynolds, flow.time) == (1000, 40)
    for profile in (flow.u, flow.v):
        assert profile.gap == (0.25, 0.75)
        for kind in ("cubic", "linear"):
            values = profile.at([0.0, 0.1, 0.25, 0.2500001, 0.5, 0.7499999, 0.75, 0.9], kind)
            np.testing.assert_array_equal(np.isnan(values), [0, 0, 0, 1, 1, 1, 0, 0])
            np.testing.assert_allclose(values[[2, 6]], 0.0, atol=1e-15)
    assert flow.energy is not None
    assert flow.energy.at(40.0) == pytest.approx(0.0250944, abs=1e-12)


CUBE = Curve(np.linspace(0.0, 2.0, 6), np.linspace(0.0, 2.0, 6) ** 3)


def test_interpolation_is_exact_for_cubics_and_lines() -> None:
    x = np.linspace(0.0, 2.0, 31)
    np.testing.assert_allclose(CUBE.at(x), x**3, atol=1e-13)
    np.testing.assert_allclose(CUBE.at([0.2, 1.0], "linear"), [0.032, 0.5 * (0.8**3 + 1.2**3)], rtol=1e-14)
    assert CUBE.at(np.ones((2, 3))).shape == (2, 3)
    assert CUBE.at(1.0).shape == ()
    for kind in ("cubic", "linear"):
        np.testing.assert_allclose(CUBE.at(CUBE.stations, kind), CUBE.values, atol=1e-14)


@pytest.mark.parametrize("station", [-0.1, 2.1, math.nan])
def test_there_is_nothing_outside_of_a_table(station: float) -> None:
    with pytest.raises(SphearError, match=f"known from 0 to 2 and not at {station}$"):
        CUBE.at([1.0, station])


def test_an_unknown_interpolation_is_refused() -> None:
    with pytest.raises(SphearError, match="no interpolation named 'cubical': did you mean cubic"):
        CUBE.at(1.0, "cubical")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("function", "available"),
    [
        (ghia, "100, 400, 1000, 3200, 5000, 7500, 10000"),
        (marchi, "100, 400, 1000"),
        (openfoam, "100, 1000"),
        (mac, "100, 1000"),
        (extrema, "100, 1000"),
    ],
)
@pytest.mark.parametrize("reynolds", [0, 200, 100.5, math.nan])
def test_other_reynolds_numbers_are_refused(function: Any, available: str, reynolds: float) -> None:
    with pytest.raises(SphearError, match=f"no Reynolds number {reynolds}, only {available}$"):
        function(reynolds)


def test_other_times_are_refused() -> None:
    with pytest.raises(SphearError, match=r"Re = 1000 has no profiles at t = 20, only at 40 and 80$"):
        mac(1000, 20)
    with pytest.raises(SphearError, match=r"Re = 100 has no profiles at t = 40, only at 20$"):
        openfoam(100.0, 40.0)


def test_references_cannot_be_changed() -> None:
    flow = ghia(100)
    with pytest.raises(dataclasses.FrozenInstanceError):
        flow.time = 1.0  # type: ignore[misc]
    for array in (flow.u.values, flow.u.stations):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1.0


def test_every_file_says_where_it_comes_from_and_nothing_of_a_machine() -> None:
    names = set()
    for file in files("sphear.references").joinpath("data").iterdir():
        names.add(file.name)
        assert PurePosixPath(file.name).suffix == ".csv"
        header = [line for line in file.read_text(encoding="utf-8").splitlines() if line.startswith("#")]
        assert len(header) >= 2
        assert not re.search(r"(^|\s)[/~][A-Za-z.]|[A-Z]:\\", "\n".join(header))
    assert len(names) == 25
