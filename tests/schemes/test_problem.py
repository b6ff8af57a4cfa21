"""Problems that make no sense are refused by name."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear.boundaries import Box
from sphear.errors import SphearError
from sphear.schemes.base import flow_in_time
from sphear.schemes.incompressible.settings import IncompressibleSettings
from sphear.schemes.problem import Problem
from sphear.schemes.settings import FlowSettings

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


@pytest.mark.parametrize("settings", [FlowSettings(), IncompressibleSettings()])
def test_a_flow_needs_particles(settings: FlowSettings | IncompressibleSettings) -> None:
    nothing = np.empty((0, 2))
    with pytest.raises(SphearError, match=r"^the problem has no particles$"):
        flow_in_time(problem(positions=nothing, velocities=nothing), settings)
