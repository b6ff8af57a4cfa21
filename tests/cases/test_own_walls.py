"""Cases around a solid of the user's own."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear.boundaries.shapes import written
from sphear.cases.flow import FLOWS, CaseRun
from sphear.errors import SphearError


def start(name: str, **changes: Any) -> CaseRun:
    chosen = FLOWS[name]
    return CaseRun(chosen, chosen.settings(**{"scheme": "incompressible", "resolution": 24, **changes}))


def test_a_cylinder_of_ones_own_is_that_of_the_case_with_a_cylinder() -> None:
    known = start("cavity-cylinder", reynolds=100.0, diameter=0.4, centre_x=0.45, spin=0.3, max_steps=5).run()
    own = start("cavity", solid="Circle((0.45, 0.5), 0.2, spin=0.3)", max_steps=5).run()
    np.testing.assert_allclose(own.flow.positions, known.flow.positions, rtol=0, atol=1e-12)
    np.testing.assert_allclose(own.flow.velocities, known.flow.velocities, rtol=0, atol=1e-12)


SOLIDS = {
    "cavity": "Circle((0.3, 0.5), 0.12) | Polygon(((0.6, 0.25), (0.85, 0.25), (0.7, 0.6)))",
    "cavity-cylinder": "Rectangle((0.0, 0.0), (1.0, 0.1))",
    "taylor-green": "Rectangle((0.35, 0.3), (0.65, 0.7))",
    "poiseuille": "Circle((0.5, 0.0), 0.15)",
    "couette": "Circle((0.5, 0.5), 0.15)",
    "dam-break": "Rectangle((2.0, -1.0), (2.5, 0.5))",  # stands on the floor
}


@pytest.mark.parametrize("name", SOLIDS)
def test_every_case_flows_around_a_solid(name: str) -> None:
    solid = written(SOLIDS[name])
    changes = {"resolution": 12} if name == "dam-break" else {}
    run = start(name, solid=SOLIDS[name], max_steps=12, **changes).run()
    assert run.end == "steps"
    assert solid.distance(run.flow.positions).max() < 0.0
    assert set(run.history[-1]) > {"kinetic_energy", "greatest_speed", "smallest_distance"}
    assert "profiles" not in run.as_dict()
    behind = run.flow.discretisation.walls  # type: ignore[attr-defined]
    dx = run.flow.problem.spacing
    depth = np.abs(solid.distance(behind.dummies.positions))
    assert (depth < 3.5 * dx).sum() > 20


ON_THE_LATTICE = {**SOLIDS, "taylor-green": "Rectangle((0.25, 0.25), (0.75, 0.75))"}  # its vortices run into it at once


@pytest.mark.parametrize("name", ["cavity", "cavity-cylinder", "taylor-green", "poiseuille"])
def test_the_explicit_scheme_flows_around_solids_too(name: str) -> None:
    solid = written(ON_THE_LATTICE[name])
    run = start(name, scheme="explicit", solid=ON_THE_LATTICE[name], max_steps=12, threads=1).run()
    assert run.end == "steps"
    assert solid.distance(run.flow.positions).max() < 0.0
    assert set(run.history[-1]) >= {"kinetic_energy", "greatest_speed"}
    assert run.as_dict()["settings"]["walls"] == "fixed"
    fields = run.flow._fields  # type: ignore[attr-defined]
    standing = fields["position"][run.flow.count :]
    assert ((solid.distance(standing) > 0) & (solid.distance(standing) < 3.5 * run.flow.problem.spacing)).sum() > 20


@pytest.mark.parametrize(
    ("solid", "place", "distance"),
    [
        ("Rectangle((-0.2, -1.0), (0.2, -0.2))", (0.95, -0.45), -0.15),  # an image of it stands there
        ("Rectangle((0.3, -1.0), (0.7, -0.2))", (0.5, -0.1), 0.1),
        ("Circle((0.5, -0.5), 0.2)", (0.5, -0.35), -0.05),
    ],
)
def test_a_solid_stands_on_the_walls_of_a_channel(solid: str, place: tuple[float, float], distance: float) -> None:
    run = start("poiseuille", solid=solid, max_steps=6).run()
    assert run.end == "steps"
    region = run.flow.discretisation.region  # type: ignore[attr-defined]
    assert region.distance([place])[0] == pytest.approx(distance)
    assert region.distance(run.flow.positions).min() > 0.0


def test_a_lattice_loses_what_the_solid_takes() -> None:
    problem = start("cavity", solid="Rectangle((0.25, 0.25), (0.5, 0.5))").flow.problem
    assert len(problem.positions) == len(problem.velocities) == 24**2 - 6**2


@pytest.mark.parametrize(
    ("name", "solid", "message"),
    [
        ("cavity", "Rectangle((-1, -1), (2, 2))", "leaves no particle of the fluid"),
        ("cavity", "Circle((0.3, 0.5), 0.27)", "narrower than the support of the kernel"),
        ("taylor-green", "Circle((0.5, 0.5), 0.6)", "cannot repeat along the periodic axis x"),
        ("cavity", "Circle(0.5)", "has missing a required argument: 'radius'"),
    ],
)
def test_a_solid_that_does_not_fit_is_named(name: str, solid: str, message: str) -> None:
    with pytest.raises(SphearError, match=message) as told:
        start(name, solid=solid)
    assert len(str(told.value).splitlines()) == 1


def test_a_channel_around_a_solid_ends_when_the_channel_does() -> None:
    run = start("poiseuille", solid=SOLIDS["poiseuille"], resolution=16, reynolds=0.01)
    assert run.case.ended(run.settings, run.flow, {}) is None
    run.flow.time = 40.0 * run.unit
    assert run.case.ended(run.settings, run.flow, {}) == "time"


@pytest.mark.parametrize(
    ("name", "solid"),
    [
        ("cavity", "Circle((5, 5), 0.2)"),
        ("cavity", "Circle((1.3, 0.5), 0.2)"),
        ("cavity", "Circle((0.7, 0.7), 0.15) & Circle((0.2, 0.2), 0.15)"),
        ("poiseuille", "Circle((0.5, 3), 0.2)"),
        ("taylor-green", "Circle((0.2, 0.2), 0.1) & Circle((0.7, 0.7), 0.1)"),
    ],
)
def test_a_solid_that_is_nowhere_in_the_fluid_is_refused(name: str, solid: str) -> None:
    with pytest.raises(SphearError, match="is nowhere in the fluid"):
        start(name, solid=solid)
