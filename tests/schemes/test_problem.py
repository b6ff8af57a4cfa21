"""Problems that make no sense are refused by name."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear.boundaries import Box
from sphear.boundaries.shapes import Rectangle
from sphear.errors import SphearError
from sphear.schemes.base import flow_of
from sphear.schemes.incompressible.settings import IncompressibleSettings
from sphear.schemes.problem import Problem
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings

X = np.stack(np.meshgrid(np.arange(8) + 0.5, np.arange(8) + 0.5), axis=-1).reshape(-1, 2) / 8


def problem(**changes: Any) -> Problem:
    box = Box((0.0, 0.0), (1.0, 1.0), ("periodic", "periodic"))
    given: dict[str, Any] = {
        "positions": X, "velocities": np.zeros_like(X), "box": box, "body_force": (0.0, 0.0), "spacing": 0.125,
        "density": 1.0, "kinematic_viscosity": 0.1, "speed": 1.0, "length": 1.0,
    }  # fmt: skip
    return Problem(**{**given, **changes})


WRONG: dict[str, tuple[dict[str, Any], str]] = {
    "density": ({"density": -1.0}, "the density of a problem must be positive, not -1.0"),
    "viscosity": ({"kinematic_viscosity": -1.0}, "the kinematic viscosity of a problem must not be negative, not -1.0"),
    "no number": (
        {"kinematic_viscosity": np.nan},
        "the kinematic viscosity of a problem must not be negative, not nan",
    ),
    "speed": ({"speed": 0.0}, "the speed of a problem must be positive, not 0.0"),
    "length": ({"length": np.inf}, "the length of a problem must be positive, not inf"),
    "force": ({"body_force": (0.0, 0.0, 0.0)}, "the body force of a problem has 2 finite numbers"),
    "infinite force": ({"body_force": (0.0, np.inf)}, "the body force of a problem has 2 finite numbers"),
    "velocities": ({"velocities": np.zeros((3, 2))}, "a problem has a velocity for each position"),
    "flat": ({"positions": X[:, 0]}, r"the positions of a problem are numbers of shape \(N, d\), not of shape"),
    "solid box": (
        {"box": Box((0.0,) * 3, (1.0,) * 3, ("periodic",) * 3), "body_force": (0.0,) * 3},
        "the positions of a problem have 2 coordinates and its box has 3",
    ),
    "thin box": (
        {"box": Box((0.0,), (1.0,), ("periodic",)), "body_force": (0.0,)},
        "the positions of a problem have 2 coordinates and its box has 1",
    ),
    "text": ({"positions": [["a", "b"]]}, "the positions of a problem are numbers of shape"),
}


@pytest.mark.parametrize("what", WRONG)
def test_what_makes_no_sense_is_named(what: str) -> None:
    changes, message = WRONG[what]
    with pytest.raises(SphearError, match=message):
        problem(**changes)


def test_lists_are_as_good_as_arrays() -> None:
    given = problem(positions=X.tolist(), velocities=np.zeros_like(X).tolist())
    np.testing.assert_array_equal(given.positions, X)


@pytest.mark.parametrize("settings", [WeaklyCompressibleSettings(), IncompressibleSettings()])
def test_a_flow_needs_particles(settings: WeaklyCompressibleSettings | IncompressibleSettings) -> None:
    nothing = np.empty((0, 2))
    with pytest.raises(SphearError, match=r"^the problem has no particles$"):
        flow_of(problem(positions=nothing, velocities=nothing), settings)


BOTH: list[WeaklyCompressibleSettings | IncompressibleSettings] = [
    WeaklyCompressibleSettings(threads=1),
    IncompressibleSettings(threads=1),
]
MASKED = np.ma.MaskedArray(X, mask=np.arange(X.size).reshape(X.shape) == 3)

NOT_A_NUMBER: dict[str, tuple[dict[str, Any], str]] = {
    "array": ({"kinematic_viscosity": np.full(64, 0.1)}, "the kinematic viscosity of a problem is one finite number"),
    "text as number": ({"spacing": "a"}, "the spacing of a problem is one finite number, not 'a'"),
    "none": ({"density": None}, "the density of a problem is one finite number, not None"),
    "truth": ({"speed": True}, "the speed of a problem is one finite number, not True"),
    "imaginary": ({"length": 1j}, "the length of a problem is one finite number, not 1j"),
    "huge whole number": ({"length": 10**400}, "the length of a problem must be positive"),
    "tiny": ({"spacing": 1e-100}, "the spacing of a problem is from 1e-50 to 1e\\+50, .* not 1e-100"),
    "complex": ({"velocities": X + 0j}, "the velocities of a problem are numbers .* this ndarray of complex128 is not"),
    "masked": ({"positions": MASKED}, "the positions of a problem are numbers .* none of them masked"),
    "objects": ({"positions": X.astype(object)}, "the positions of a problem are numbers .* of object is not"),
    "truths": ({"velocities": X > 0}, "the velocities of a problem are numbers .* of bool is not"),
    "ragged": ({"positions": [[0.0, 1.0], [2.0]]}, "the positions of a problem are numbers .* this list is not"),
    "durations": ({"velocities": X.astype("timedelta64[s]")}, "the velocities of a problem are numbers"),
    "force of text": ({"body_force": ("a", "b")}, "the body force of a problem has 2 finite numbers"),
    "force of none": ({"body_force": None}, "the body force of a problem has 2 finite numbers, not None"),
    "no box": ({"box": "box"}, "the box of a problem is a Box, not 'box'"),
    "no shape": ({"shape": "circle"}, "the shape of a problem is a shape"),
    "no function": ({"force": 3.0}, "the force of a problem is a function"),
}


@pytest.mark.parametrize("what", NOT_A_NUMBER)
def test_what_is_not_of_its_kind_is_named(what: str) -> None:
    changes, message = NOT_A_NUMBER[what]
    with pytest.raises(SphearError, match=message) as told:
        problem(**changes)
    assert "\n" not in str(told.value)
    assert len(str(told.value)) < 300


def test_a_mask_without_masked_values_and_numbers_of_other_kinds_are_honoured() -> None:
    plain = problem()
    given = problem(
        positions=np.ma.MaskedArray(X), velocities=np.zeros(X.shape, np.float32), spacing=np.float32(0.125),
        density=np.array(1), body_force=np.zeros(2),
    )  # fmt: skip
    np.testing.assert_array_equal(given.positions, plain.positions)
    assert (given.spacing, given.density, given.body_force) == (0.125, 1.0, (0.0, 0.0))


WALLED = Box((0.0, 0.0), (1.0, 1.0), ("periodic", "walls"))
TWICE = np.concatenate((X[:-1], X[5:6]))
WRONG_STARTS: dict[str, tuple[dict[str, Any], str]] = {
    "twice the spacing": ({"spacing": 0.25}, "64 of them there are 0.125 apart, not 0.25"),
    "half the spacing": ({"spacing": 0.0625}, "nearest neighbours at 0.125, not at 0.0625"),
    "beyond a wall": (
        {"box": WALLED, "positions": X + np.array([0.0, 0.5])},
        r"particle 32 at \(0.0625, 1.0625\) starts behind a wall",
    ),
    "at one place": ({"positions": TWICE}, r"particles 5 and 63 are both at \(0.6875, 0.0625\) at the start"),
    "at one place, a period on": ({"positions": TWICE + (np.arange(64) > 62)[:, None]}, "particles 5 and 63 are both"),
}


@pytest.mark.parametrize("settings", BOTH, ids=lambda chosen: chosen.scheme)
@pytest.mark.parametrize("what", WRONG_STARTS)
def test_a_start_that_cannot_be_is_refused_by_both_schemes(
    what: str, settings: WeaklyCompressibleSettings | IncompressibleSettings
) -> None:
    changes, message = WRONG_STARTS[what]
    with pytest.raises(SphearError, match=message):
        flow_of(problem(**changes), settings)


@pytest.mark.parametrize("settings", BOTH, ids=lambda chosen: chosen.scheme)
def test_starts_that_are_allowed(settings: WeaklyCompressibleSettings | IncompressibleSettings) -> None:
    """A lattice that is stretched by a tenth along one axis, particles a period away, and those on a wall's side."""
    stretched = Box((0.0, 0.0), (1.1, 1.0), ("periodic", "periodic"))
    flow_of(problem(positions=X * np.array([1.1, 1.0]), box=stretched), settings)
    flow_of(problem(positions=X + np.array([3.0, -2.0])), settings)
    flow_of(problem(positions=X, box=WALLED), settings)


@pytest.mark.parametrize(("spacing", "said"), [(0.25, "at 0.125, not at 0.25"), (0.0625, "at 0.125, not at 0.0625")])
def test_the_spacing_of_a_fluid_with_a_surface_is_that_of_its_nearest_particles(spacing: float, said: str) -> None:
    tank = Box((0.0, 0.0), (3.0, 2.0), ("walls", "walls"))
    with pytest.raises(SphearError, match=said):
        flow_of(problem(box=tank, free_surface=True, spacing=spacing), IncompressibleSettings(threads=1))


def test_fluid_that_a_solid_cuts_in_two_is_refused_at_the_start() -> None:
    fine = np.stack(np.meshgrid(*[(np.arange(24) + 0.5) / 24] * 2, indexing="ij"), axis=-1).reshape(-1, 2)
    wall = Rectangle((-1.0, 0.3), (2.0, 0.7))
    room = Rectangle((0.0, 0.0), (1.0, 1.0))
    left = fine[np.abs(fine[:, 1] - 0.5) > 0.2]
    cut = problem(
        positions=left, velocities=0 * left, box=Box((0.0, 0.0), (1.0, 1.0), ("walls", "walls")), shape=room & ~wall,
        spacing=1 / 24,
    )  # fmt: skip
    with pytest.raises(
        SphearError, match=r"falls into 2 parts without a common neighbour.* nothing fixes the pressure"
    ):
        flow_of(cut, IncompressibleSettings(threads=1))


def test_no_particle_moves_further_than_a_share_of_a_spacing_in_a_step() -> None:
    usual = flow_of(problem(), IncompressibleSettings(threads=1, reynolds=1e5, resolution=8))
    assert usual.limits["cfl"] == min(usual.limits["cfl"], usual.limits["spacing"])
    wide = problem(kinematic_viscosity=0.0)
    far = flow_of(wide, IncompressibleSettings(threads=1, h_over_dx=3, resolution=8, shifting="none"))
    assert far.time_step == far.limits["spacing"] == pytest.approx(0.63 * 0.125)
