"""The lid-driven cavity: what is read off it, what it is compared with, and a short run."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from sphear.cases.flow import FLOWS, CaseRun
from sphear.cases.flow import cavity as case
from sphear.cases.flow import cavity_cylinder as cylinder
from sphear.references import cavity as references
from sphear.schemes.weakly_compressible.flow import WeaklyCompressibleFlow
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings
from sphear.simulation.interpolation import interpolated

Array = np.ndarray[Any, Any]

N = 16
CAVITY = FLOWS["cavity"]


def cavity(**changes: Any) -> tuple[WeaklyCompressibleSettings, WeaklyCompressibleFlow]:
    settings = CAVITY.explicit(**{**CAVITY.preset("basa2009", "explicit"), **changes}, resolution=N)
    return settings, WeaklyCompressibleFlow(CAVITY.problem(settings), settings)


def parabolas(x: Array) -> Array:
    a, b = x[..., 0], x[..., 1]
    return np.stack((1 + 2 * a - b + 3 * a**2 - 4 * a * b + 5 * b**2, -2 + a * b - b**2), axis=-1)


POINTS = {
    "inside": [(0.5, 0.5), (0.53, 0.31), (0.27, 0.71)],
    "walls": [(0.5, 0.0), (0.5, 1.0), (0.0, 0.4), (1.0, 0.6), (0.5, 1 / 65), (64 / 65, 0.5)],
    "corners": [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (0.01, 0.99)],
}


@pytest.mark.parametrize("initial", ["lattice", "staggered"])
@pytest.mark.parametrize("where", POINTS)
def test_interpolation_is_exact_for_quadratic_fields(where: str, initial: str) -> None:
    _, flow = cavity(initial=initial)
    flow.velocities[:] = parabolas(flow.positions)
    points = np.array(POINTS[where])
    np.testing.assert_allclose(interpolated(flow, points), parabolas(points), rtol=0, atol=1e-11)


def test_interpolation_is_exact_where_particles_have_left_a_hole() -> None:
    _, flow = cavity()
    off = flow.positions - 0.5
    distance = np.hypot(*off.T)[:, None]
    inside = distance < 3.5 / N
    flow.positions[:] += np.where(inside, off / distance * (2.7 / N - 0.75 * distance), 0)
    flow.velocities[:] = parabolas(flow.positions)
    centre = np.array([[0.5, 0.5]])
    np.testing.assert_allclose(interpolated(flow, centre), parabolas(centre), rtol=0, atol=1e-9)


@pytest.mark.parametrize("radius", [2.0, 3.2])  # spacings, within the reach of the fit and beyond it
def test_interpolation_is_exact_where_the_nearest_particles_lie_on_a_circle(radius: float) -> None:
    _, flow = cavity()
    off = flow.positions - 0.5
    distance = np.hypot(*off.T)[:, None]
    flow.positions[:] += np.where(distance < 3.5 / N, off / distance * (radius / N - distance), 0)
    near = np.sort(np.hypot(*(flow.positions - 0.5).T))[:20]
    assert np.ptp(near) < 1e-12
    flow.velocities[:] = parabolas(flow.positions)
    centre = np.array([[0.5, 0.5]])
    np.testing.assert_allclose(interpolated(flow, centre), parabolas(centre), rtol=0, atol=1e-9)


def test_particles_at_rest_have_no_energy_and_the_time_zero_no_error() -> None:
    settings, flow = cavity()
    assert CAVITY.metrics(settings, flow) == {"kinetic_energy": 0.0}


@pytest.mark.parametrize("resolution", [10, 20])
def test_the_energy_is_the_integral_over_the_cavity(resolution: int) -> None:
    """u = (3, 4) everywhere: |u|^2 / 2 over the area 1."""
    settings = CAVITY.explicit(**CAVITY.preset("basa2009", "explicit"), resolution=resolution)
    flow = WeaklyCompressibleFlow(CAVITY.problem(settings), settings)
    flow.velocities[:] = (3.0, 4.0)
    assert CAVITY.metrics(settings, flow)["kinetic_energy"] == pytest.approx(12.5)


@pytest.mark.parametrize("time", [1.0, 20.0])
def test_the_energy_error_is_relative_to_the_reference_at_the_same_time(time: float) -> None:
    settings, flow = cavity(reynolds=100)
    curve = references.mac(100).energy
    assert curve is not None
    flow.time = time
    flow.velocities[:] = (np.sqrt(2 * 1.25 * float(curve.at(time))), 0.0)
    assert CAVITY.metrics(settings, flow)["kinetic_energy_error"] == pytest.approx(0.25)


@pytest.mark.parametrize("reynolds", [400, 123])
def test_no_energy_error_without_a_reference_in_time(reynolds: float) -> None:
    settings, flow = cavity(reynolds=reynolds)
    flow.time = 1.0
    assert set(CAVITY.metrics(settings, flow)) == {"kinetic_energy"}


def test_profiles_are_u_along_y_and_v_along_x() -> None:
    settings, flow = cavity()
    x, y = flow.positions.T
    flow.velocities[:] = np.stack((y**2 + x, x**2 - y), axis=1)
    kept = CAVITY.profiles(settings, flow)
    stations = np.array(kept["stations"])
    assert 0 < stations[0] < stations[-1] < 1
    np.testing.assert_allclose(kept["u"], stations**2 + 0.5, atol=1e-11)
    np.testing.assert_allclose(kept["v"], stations**2 - 0.5, atol=1e-11)


def test_the_summary_of_a_known_flow() -> None:
    """u = y everywhere along x = 1/2: the deviations are those of the straight line from the reference."""
    settings, flow = cavity(reynolds=100)
    flow.time = 20.0
    flow.velocities[:] = np.stack((flow.positions[:, 1], np.zeros(N * N)), axis=1)
    found = CAVITY.summary(settings, flow)
    y, known = case.STATIONS, references.mac(100, 20)
    off_u, off_v = np.abs(y - known.u.at(y)), np.abs(known.v.at(y))
    assert found == {
        "u_min": pytest.approx(y[0]),
        "reference_time": 20.0,
        "u_mean_deviation": pytest.approx(off_u.mean()),
        "u_max_deviation": pytest.approx(off_u.max()),
        "v_mean_deviation": pytest.approx(off_v.mean()),
        "v_max_deviation": pytest.approx(off_v.max()),
    }


def test_published_tables_are_compared_at_their_own_stations() -> None:
    """u = y, which is read off exactly anywhere: Marchi's 15 stations k / 16 inside."""
    settings, flow = cavity(reynolds=400)
    flow.time = 80.0  # steady by then
    flow.velocities[:] = np.stack((flow.positions[:, 1], np.zeros(N * N)), axis=1)
    found = CAVITY.summary(settings, flow)
    curve = references.marchi(400).u
    off = np.abs(curve.stations - curve.values)[1:-1]
    assert len(off) == 15
    assert found["reference_time"] == np.inf
    assert (found["u_mean_deviation"], found["u_max_deviation"]) == pytest.approx((off.mean(), off.max()))


@pytest.mark.parametrize(
    ("reynolds", "time", "said"),
    [
        (100, 5.0, "those computed are of t = 20, and steady ones hold from t = 20 on"),
        (1000, 55.0, "those computed are of t = 40 and 80, and steady ones hold from t = 200 on"),
        (400, 20.0, "steady ones hold from t = 80 on"),
    ],
)
def test_no_deviation_where_no_reference_is_of_that_time(reynolds: float, time: float, said: str) -> None:
    settings, flow = cavity(reynolds=reynolds)
    flow.time = time
    assert CAVITY.summary(settings, flow) == {
        "u_min": pytest.approx(0.0),
        "reference_missing": f"no profiles are known at t = {time:g}: {said}",
    }
    assert all(len(profile.reference) == 0 for profile in CAVITY.comparisons(settings, flow).values())


def test_the_cavity_with_the_cylinder_is_compared_at_the_time_of_its_reference_only() -> None:
    settings = FLOWS["cavity-cylinder"].settings()
    assert cylinder.reference(settings, 20.0) is None
    found = cylinder.reference(settings, 40.1)
    assert found is not None
    assert found.time == 40


def test_no_energy_error_where_the_reference_has_hardly_begun_to_move() -> None:
    settings, flow = cavity(reynolds=100)
    flow.time = 1e-13
    assert set(CAVITY.metrics(settings, flow)) == {"kinetic_energy"}


def test_the_summary_without_a_reference_is_what_was_found() -> None:
    settings, flow = cavity(reynolds=123)
    flow.velocities[:] = (-0.25, 0.0)
    assert CAVITY.summary(settings, flow) == {"u_min": pytest.approx(-0.25)}
    assert all(len(profile.reference) == 0 for profile in CAVITY.comparisons(settings, flow).values())


@pytest.mark.parametrize(
    ("reynolds", "time", "source", "at"),
    [
        (100, 20.0, "staggered grid", 20),
        (100, 20.09, "staggered grid", 20),
        (100, 90.0, "staggered grid", 20),
        (1000, 40.0, "staggered grid", 40),
        (1000, 80.3, "staggered grid", 80),
        (1000, 200.0, "Marchi", np.inf),
        (400, 80.0, "Marchi", np.inf),
        (3200, 640.0, "Ghia", np.inf),
    ],
)
def test_the_reference_is_of_equal_time_or_both_are_steady(
    reynolds: float, time: float, source: str, at: float
) -> None:
    known = case.reference(CAVITY.settings(reynolds=reynolds), time)
    assert known is not None
    assert (known.reynolds, known.time) == (reynolds, at)
    assert known.source.startswith(source)


@pytest.mark.parametrize("reynolds", [100.5, 123, 2e4])
def test_most_numbers_have_no_reference(reynolds: float) -> None:
    assert case.reference(CAVITY.settings(reynolds=reynolds), 20.0) is None


@cache
def best() -> CaseRun:
    return CaseRun(CAVITY, CAVITY.settings(resolution=N, until=0.2)).run()


def test_a_short_run_reaches_its_time() -> None:
    assert best().end == "time"
    assert best().history[-1]["time"] == pytest.approx(0.2, abs=best().flow.time_step)


def test_nothing_is_much_faster_than_the_lid() -> None:
    assert 0.1 < np.hypot(*best().flow.velocities.T).max() < 1.5


def test_the_lid_drags_the_fluid_along_and_no_particle_leaves() -> None:
    x, v = best().flow.positions, best().flow.velocities
    assert v[x[:, 1] > 1 - 1 / N, 0].mean() > 0.1
    assert ((x > 0) & (x < 1)).all()
