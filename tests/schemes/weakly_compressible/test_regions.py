"""The explicit scheme in regions of any form: rings, squares as shapes, a cylinder in the cavity, and refusals."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, cast

import numpy as np
import pytest

import sphear
from sphear.boundaries import Box
from sphear.boundaries.shapes import Rectangle
from sphear.schemes.problem import Problem
from sphear.schemes.weakly_compressible.flow import WeaklyCompressibleFlow
from sphear.schemes.weakly_compressible.settings import WeaklyCompressible
from sphear.simulation.whole_flow import kinetic_energy

INNER, OUTER, SPIN = 0.5, 1.0, 1.0
RING = sphear.Circle((0.0, 0.0), OUTER, name="outer") - sphear.Circle((0.0, 0.0), INNER, name="inner")


@pytest.mark.parametrize("walls", ["fixed", "adami"])
def test_the_flow_between_circles_of_which_the_inner_turns_is_couettes(walls: str) -> None:
    """u = A r + B / r, A = -W a^2 / (b^2 - a^2), B = W a^2 b^2 / (b^2 - a^2); ten particles across, nu t / b^2 = 0.2.

    Measured: fixed 0.96 % of the inner wall's speed in the RMS and 3.1 % at most, adami 0.94 % and 3.0 %.
    """
    simulation = sphear.Simulation(
        RING,
        spacing=0.05,
        fluid=sphear.Fluid(kinematic_viscosity=1.0),
        boundaries={"inner": sphear.NoSlip(spin=SPIN)},
        scheme=sphear.WeaklyCompressible(walls=walls, threads=1),
    ).run(0.2)
    x, velocities = simulation.positions, simulation.velocities
    r = np.hypot(*x.T)
    between = OUTER**2 - INNER**2
    exact = -SPIN * INNER**2 / between * r + SPIN * INNER**2 * OUTER**2 / between / r
    around = (x[:, 0] * velocities[:, 1] - x[:, 1] * velocities[:, 0]) / r
    off = np.abs(around - exact) / (SPIN * INNER)
    assert np.sqrt((off**2).mean()) < 0.012
    assert off.max() < 0.04
    assert np.abs((x * velocities).sum(axis=1) / r).max() < 0.02 * SPIN


def in_a_square(shape: Rectangle | None, **changes: Any) -> WeaklyCompressibleFlow:
    """A lid over a unit square, Re = 100, as a box or as a shape in one."""
    n = 16
    ticks = (np.arange(n) + 0.5) / n
    x = np.stack(np.meshgrid(ticks, ticks, indexing="ij"), axis=-1).reshape(-1, 2)
    box = Box((0.0, 0.0), (1.0, 1.0), ("walls", "walls"), upper_velocity=(1.0, 0.0))
    problem = Problem(x, np.zeros_like(x), box, (0.0, 0.0), 1 / n, 1.0, 0.01, 1.0, 1.0, shape=shape)
    return WeaklyCompressibleFlow(problem, WeaklyCompressible(threads=1, **changes))


SQUARE = Rectangle((0.0, 0.0), (1.0, 1.0), velocities={"upper": (1.0, 0.0)})


@pytest.mark.parametrize("walls", ["fixed", "adami"])
def test_a_square_given_as_a_shape_is_the_box(walls: str) -> None:
    box, shape = in_a_square(None, walls=walls), in_a_square(SQUARE, walls=walls)
    for flow in (box, shape):
        flow.advance(20)
    np.testing.assert_allclose(shape.positions, box.positions, rtol=0, atol=1e-10)
    np.testing.assert_allclose(shape.velocities, box.velocities, rtol=0, atol=1e-10)
    assert np.abs(box.velocities).max() > 0.1


def test_mirrors_that_nobody_named_give_way_to_fixed_particles_in_a_shape() -> None:
    flow, named = in_a_square(SQUARE), in_a_square(SQUARE, walls=sphear.FixedParticles())
    assert flow.settings.wall_model == named.settings.wall_model == sphear.FixedParticles("quadratic")
    assert {key: flow.resolved()[key] for key in ("walls", "density", "wall_divergence", "density_diffusion")} == {
        "walls": "fixed", "density": "summation", "wall_divergence": "continued", "density_diffusion": 0.0,
    }  # fmt: skip
    assert in_a_square(None).resolved()["walls"] == "mirror"


@pytest.mark.parametrize(("walls", "bound"), [("fixed", 0.05), ("adami", 0.15)])
def test_the_cavity_with_a_cylinder_has_the_energy_of_the_incompressible_flow(walls: str, bound: float) -> None:
    """Adami's particles take energy before the lid on coarse particles: at t = 1, 24 a side, they have 13 % less."""
    common: dict[str, Any] = {"reynolds": 100.0, "resolution": 24, "until": 1.0, "threads": 1}
    explicit = sphear.flow("cavity-cylinder", scheme="explicit", walls=walls, **common).run()
    other = sphear.flow("cavity-cylinder", scheme="incompressible", **common).run()
    assert explicit.end == other.end == "time"
    assert kinetic_energy(explicit.flow) == pytest.approx(kinetic_energy(other.flow), rel=bound)


ROOM, HOLE = sphear.Rectangle((0, 0), (1, 1)), sphear.Circle((0.5, 0.5), 0.2)
MOVING: dict[str, Any] = {"upper": sphear.NoSlip(velocity=(1.0, 0.0))}


def simulation(region: sphear.Shape, walls: Any, **changes: Any) -> sphear.Simulation:
    given = {"boundaries": MOVING, **changes}
    fluid = sphear.Fluid(kinematic_viscosity=0.01)
    return sphear.Simulation(region, spacing=0.05, fluid=fluid, scheme=sphear.WeaklyCompressible(walls=walls), **given)


SLIPPING: dict[str, Any] = {**MOVING, "lower": sphear.FreeSlip()}
REFUSED: dict[str, tuple[Callable[[], object], str]] = {
    "mirrors around a circle": (
        lambda: simulation(ROOM - HOLE, sphear.MirrorParticles("linear")),
        r"walls=mirror reflect particles at the sides of a box, and the walls of .* take walls=fixed or walls=adami",
    ),
    "fluid slips along fixed particles": (
        lambda: simulation(ROOM, sphear.FixedParticles(), boundaries=SLIPPING),
        "fluid slips along walls of walls=mirror, each by itself: walls=fixed cannot let it, take walls=mirror",
    ),
    "fluid slips along a shape": (
        lambda: simulation(ROOM - HOLE, "adami", boundaries=SLIPPING),
        "fluid slips along walls of walls=mirror, or of scheme=incompressible, and not along fixed particles",
    ),
    "fluid slips along particles on mirrors": (
        lambda: simulation(ROOM, sphear.MirrorParticles(on_wall=True), boundaries=SLIPPING),
        "wall_particles=True cannot let it, take wall_particles=False",
    ),
    "a thin solid": (
        lambda: simulation(ROOM - sphear.Rectangle((0.3, 0.5), (0.7, 0.55), name="plate"), "fixed"),
        r"the solid at .* is 0\.05 thick: fluid on its two sides would feel each other through .* thinner than 0\.2",
    ),
    "a free surface": (
        lambda: simulation(ROOM, "fixed", filled=sphear.Rectangle((0, 0), (0.5, 1))),
        "the explicit scheme knows no free surfaces: take scheme=incompressible",
    ),
    "a model of the other scheme": (
        lambda: WeaklyCompressible(walls=cast(Any, sphear.SFDI())),
        r"walls=SFDI\(.*\) is no wall model of the explicit scheme, which has adami, mirror, fixed",
    ),
    "mirrors of the explicit scheme": (
        lambda: sphear.Incompressible(walls=cast(Any, sphear.MirrorParticles())),
        r"walls=MirrorParticles\(.*\) is no wall model of the incompressible scheme, which has mirror_points, adami,",
    ),
}


@pytest.mark.parametrize("what", REFUSED)
def test_what_it_cannot_do_is_refused_in_a_sentence(what: str) -> None:
    make, sentence = REFUSED[what]
    with pytest.raises(sphear.SphearError, match=sentence) as told:
        make()
    assert "\n" not in str(told.value)
