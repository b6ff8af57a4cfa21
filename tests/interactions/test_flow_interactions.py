"""What a flow sums over pairs, against plain sums over all of them and against what follows from the equations."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from sphear import CORRECTIONS, VISCOSITY, CubicSpline, Domain, Particles
from sphear.boundaries.continuations import Line, Parabola
from sphear.boundaries.models.before_wall import FluidBeforeWall, VelocityBeforeWall
from sphear.interactions import (
    Advection,
    Continuity,
    DensityAdvection,
    DensityDiffusion,
    InternalEnergy,
    Part,
    PressureForce,
    Rates,
    Shifting,
    SummationDensity,
    TransportStress,
    TransportVelocity,
    ViscousForce,
)
from sphear.operators.pipeline import Operation, run
from tests.particles import Array, all_pairs, box, interior, jittered, lattice, summed

KERNEL = CubicSpline(1.5)
POSITIONS = jittered((8, 8), 0.4, seed=0)
COUNT = len(POSITIONS)
NONE = CORRECTIONS["none"]
corrections = pytest.mark.parametrize("correction", ["none", "shepard", "bonet_lok"])
forms = pytest.mark.parametrize("form", ["squares", "products"])


def fields() -> dict[str, Any]:
    generator = np.random.default_rng(1)
    volumes, density = generator.uniform(0.8, 1.2, COUNT), generator.uniform(0.5, 2.0, COUNT)
    known = {
        "volume": volumes, "density": density, "mass": volumes * density, "velocity": generator.random((COUNT, 2)),
        "dynamic_viscosity": generator.uniform(0.5, 2.0, COUNT), "drift": generator.normal(size=(COUNT, 2)),
    }  # fmt: skip
    return with_pressure(known, generator.uniform(-1.0, 3.0, COUNT))


def with_pressure(known: dict[str, Any], pressure: Array) -> dict[str, Any]:
    inverse = known["density"] ** -2.0
    return {**known, "pressure": pressure, "pressure_over_density2": pressure * inverse, "inverse_density2": inverse}


def computed(
    interaction: Any, known: dict[str, Any], correction: str = "none", positions: Array = POSITIONS,
    domain: Domain | None = None,
) -> Array:  # fmt: skip
    preparation = CORRECTIONS[correction].preparation(KERNEL)
    cloud = Particles.read(positions, kernel=KERNEL, volumes=known["volume"], domain=domain)
    return run(Operation((interaction,), preparation), cloud.neighbours, known).values


def rate(part: Part, known: dict[str, Any], correction: str = "none", **others: Any) -> Array:
    """Of one part alone."""
    found = computed(Rates((part,)), known, correction, **others)
    return found[:, 0] if part.role in ("density", "energy") else found


def gradients(known: dict[str, Any], correction: str) -> tuple[Array, Array, Array]:
    """(i, j, grad W~_ij) of all pairs, each particle with itself included."""
    i, j, d = all_pairs(POSITIONS, KERNEL.radius)
    itself = np.arange(COUNT)
    i, j = np.append(i, itself), np.append(j, itself)
    d = np.append(d, np.zeros((COUNT, 2)), axis=0)
    r2 = (d**2).sum(axis=1)
    apart = r2 > 0
    w = np.asarray(np.where(apart, KERNEL.value(np.where(apart, r2, 1.0), 2), KERNEL.value_at_zero(2)))
    grad_w = np.where(apart, KERNEL.gradient_factor(np.where(apart, r2, 1.0), 2), 0.0)[:, None] * d
    if correction != "none":
        one = summed(i, known["volume"][j] * w, COUNT)
        grad_one = summed(i, known["volume"][j, None] * grad_w, COUNT)
        grad_w = grad_w / one[i, None] - w[:, None] * grad_one[i] / one[i, None] ** 2
    if correction == "bonet_lok":
        moments = summed(i, known["volume"][j, None, None] * grad_w[:, :, None] * POSITIONS[j, None, :], COUNT)
        grad_w = np.einsum("pab,pb->pa", np.linalg.inv(moments)[i], grad_w)
    return i, j, grad_w


def close(found: Array, expected: Array) -> None:
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-11 * np.abs(expected).max())


def cancels(values: Array) -> None:
    """The sum over particles is nothing beside the values."""
    assert np.abs(values).max() > 1e-3
    assert np.abs(values.sum(axis=0)).max() < 1e-13 * np.abs(values).sum()


def test_density_is_the_sum_of_masses_with_the_particle_itself() -> None:
    known = fields()
    i, j, d = all_pairs(POSITIONS, KERNEL.radius)
    pairs = summed(i, known["mass"][j] * KERNEL.value((d**2).sum(axis=1), 2), COUNT)
    expected = pairs + known["mass"] * 10 / (7 * np.pi * 1.5**2)
    close(computed(SummationDensity(KERNEL), known)[:, 0], expected)


@corrections
@forms
@pytest.mark.parametrize(("reduced", "subtracted"), [(True, None), (False, None), (False, 0.7), (True, 0.7)])
def test_pressure_force(form: Any, reduced: bool, subtracted: float | None, correction: str) -> None:
    """With the mean subtracted, a constant that is subtracted before is gone with it."""
    known = fields()
    i, j, grad_w = gradients(known, correction)
    p, rho = known["pressure"], known["density"]
    others = i != j
    minus = np.full(COUNT, subtracted or 0.0)
    if reduced:
        minus = summed(i[others], p[j[others]], COUNT) / np.bincount(i[others])
    one, other = p[i] - minus[i], p[j] - minus[i]
    stress = one / rho[i] ** 2 + other / rho[j] ** 2 if form == "squares" else (one + other) / (rho[i] * rho[j])
    expected = summed(i, -(known["mass"][j] * stress)[:, None] * grad_w, COUNT)
    close(rate(PressureForce(KERNEL, CORRECTIONS[correction], form, reduced, subtracted), known, correction), expected)


@forms
def test_pressure_forces_of_a_pair_are_equal_and_opposite(form: Any) -> None:
    known = fields()
    cancels(known["mass"][:, None] * rate(PressureForce(KERNEL, NONE, form, reduced=False), known))


@forms
def test_a_uniform_pressure_exerts_no_force_once_reduced(form: Any) -> None:
    known = with_pressure(fields(), np.full(COUNT, 1e6))
    np.testing.assert_allclose(rate(PressureForce(KERNEL, NONE, form), known), 0.0, atol=1e-7)
    np.testing.assert_allclose(rate(PressureForce(KERNEL, NONE, form, False, 1e6), known), 0.0, atol=1e-7)


@corrections
def test_continuity(correction: str) -> None:
    known = fields()
    i, j, grad_w = gradients(known, correction)
    u = known["velocity"]
    expected = summed(i, known["mass"][j] * ((u[i] - u[j]) * grad_w).sum(axis=1), COUNT)
    close(rate(Continuity(KERNEL, CORRECTIONS[correction]), known, correction), expected)


def test_continuity_is_exact_for_linear_velocities_where_the_gradient_is() -> None:
    """d rho/dt = -rho div u."""
    known = fields()
    known["density"] = np.full(COUNT, 2.0)
    known["mass"] = 2.0 * known["volume"]
    known["velocity"] = POSITIONS @ np.array([[0.3, 5.0], [-4.0, 0.5]]) + 7.0
    close(rate(Continuity(KERNEL, CORRECTIONS["bonet_lok"]), known, "bonet_lok"), np.full(COUNT, -2.0 * 0.8))


def test_density_diffusion() -> None:
    known = fields()
    i, j, d = all_pairs(POSITIONS, KERNEL.radius)
    r2 = (d**2).sum(axis=1)
    rho = known["density"]
    slope = KERNEL.gradient_factor(r2, 2) * r2  # r . grad W
    pairs = 2 * known["volume"][j] * (rho[i] - rho[j]) * slope / r2
    part = DensityDiffusion(KERNEL, 0.1, 30.0)
    close(rate(part, known), 0.1 * 1.5 * 30.0 * summed(i, pairs, COUNT))


def test_density_diffusion_conserves_the_mass_and_evens_out() -> None:
    """Of particles of given volumes: sum V d rho/dt = 0 and sum V rho d rho/dt < 0."""
    known = fields()
    change = known["volume"] * rate(DensityDiffusion(KERNEL, 0.1, 30.0), known)
    cancels(change)
    assert known["density"] @ change < 0


@corrections
@forms
def test_internal_energy(form: Any, correction: str) -> None:
    known = fields()
    i, j, grad_w = gradients(known, correction)
    p, rho, u = known["pressure"], known["density"], known["velocity"]
    stress = p[i] / rho[i] ** 2 + p[j] / rho[j] ** 2 if form == "squares" else (p[i] + p[j]) / (rho[i] * rho[j])
    expected = summed(i, 0.5 * known["mass"][j] * stress * ((u[i] - u[j]) * grad_w).sum(axis=1), COUNT)
    close(rate(InternalEnergy(KERNEL, CORRECTIONS[correction], form), known, correction), expected)


@forms
def test_what_pressure_takes_from_the_motion_it_gives_to_the_internal_energy(form: Any) -> None:
    known = fields()
    push = rate(PressureForce(KERNEL, NONE, form, reduced=False), known)
    heat = rate(InternalEnergy(KERNEL, NONE, form), known)
    work = known["mass"] * ((known["velocity"] * push).sum(axis=1) + heat)
    assert abs(work.sum()) < 1e-13 * np.abs(work).sum()


def uneven(i: Array, j: Array, d: Array, volumes: Array) -> Array:
    """The gradient of the concentration, with the term against clumping."""
    r2 = (d**2).sum(axis=1)
    weight = 1 + 0.2 * (KERNEL.value(r2, 2) / KERNEL.value(1.0, 2)) ** 4
    return summed(i, (volumes[j] * weight * KERNEL.gradient_factor(r2, 2))[:, None] * d, len(volumes))


def test_shifting() -> None:
    known = fields()
    wanted = -2 * 1.5 * 3.0 * 0.8 * uneven(*all_pairs(POSITIONS, KERNEL.radius), known["volume"])
    size = np.sqrt((wanted**2).sum(axis=1))
    assert (size < 1.5).any()
    assert (size > 1.5).any()
    close(rate(Shifting(KERNEL, 0.8, 3.0, 1.0), known), wanted * np.minimum(1.0, 1.5 / size)[:, None])


def test_shifting_is_at_most_half_of_the_speed() -> None:
    drift = rate(Shifting(KERNEL, 1e6, 3.0, 1.0), fields())
    np.testing.assert_allclose(np.hypot(*drift.T), 1.5, rtol=1e-12)


def test_a_lattice_is_not_shifted() -> None:
    places = lattice((8, 8))
    drift = rate(Shifting(KERNEL, 1.0, 3.0, 1.0), {"volume": np.ones(64)}, positions=places, domain=box((8, 8)))
    np.testing.assert_allclose(drift, 0.0, atol=1e-13)


def test_shifting_goes_where_there_are_few() -> None:
    """Out of a cluster."""
    places = POSITIONS - 4.0
    drift = rate(Shifting(KERNEL, 1.0, 3.0, 1.0), fields())
    outer = ~interior(POSITIONS, 0.5)
    assert ((places * drift).sum(axis=1)[outer] > 0).all()


@corrections
@pytest.mark.parametrize("of_density", [False, True])
def test_advection(of_density: bool, correction: str) -> None:
    """(w . grad) of velocity and density, the gradients of differences."""
    known = fields()
    shifting = Shifting(KERNEL, 0.3, 3.0, 1.0)
    drift = rate(shifting, known)
    i, j, grad_w = gradients(known, correction)
    along = (drift[i] * grad_w).sum(axis=1) * known["volume"][j]
    values = known["density"] if of_density else known["velocity"]
    difference = values[j] - values[i]
    expected = summed(i, along * difference if of_density else along[:, None] * difference, COUNT)
    part = (DensityAdvection if of_density else Advection)(shifting, KERNEL, CORRECTIONS[correction])
    close(rate(part, known, correction), expected)


@pytest.mark.parametrize("of_density", [False, True])
def test_advection_leaves_constants_alone(of_density: bool) -> None:
    known = {**fields(), "velocity": np.tile((3.0, -2.0), (COUNT, 1)), "density": np.full(COUNT, 4.0)}
    part = (DensityAdvection if of_density else Advection)(Shifting(KERNEL, 1.0, 3.0, 1.0), KERNEL, NONE)
    np.testing.assert_allclose(rate(part, known), 0.0, atol=1e-13)


def pairs_of_volumes(known: dict[str, Any]) -> tuple[Array, Array, Array]:
    """(i, j, (V_i^2 + V_j^2) grad W_ij)."""
    i, j, d = all_pairs(POSITIONS, KERNEL.radius)
    volumes = known["volume"][i] ** 2 + known["volume"][j] ** 2
    return i, j, (volumes * KERNEL.gradient_factor((d**2).sum(axis=1), 2))[:, None] * d


def test_transport_velocity() -> None:
    known = fields()
    i, _, gradient = pairs_of_volumes(known)
    found = rate(TransportVelocity(KERNEL, 0.6), known)
    close(found, -0.6 / known["mass"][:, None] * summed(i, gradient, COUNT))
    cancels(known["mass"][:, None] * found)


def test_transport_stress() -> None:
    known = fields()
    i, j, gradient = pairs_of_volumes(known)
    carried = known["density"][:, None, None] * known["velocity"][:, :, None] * known["drift"][:, None, :]
    pairs = np.einsum("pka,pa->pk", 0.5 * (carried[i] + carried[j]), gradient)
    found = rate(TransportStress(KERNEL), known)
    close(found, summed(i, pairs, COUNT) / known["mass"][:, None])
    cancels(known["mass"][:, None] * found)


def test_roles_are_summed_apart_and_those_of_one_role_together() -> None:
    known = fields()
    velocity = (PressureForce(KERNEL, NONE, "products"), ViscousForce(VISCOSITY["morris"], KERNEL, NONE))
    others = (Continuity(KERNEL, NONE), InternalEnergy(KERNEL, NONE, "products"), Shifting(KERNEL, 1.0, 3.0, 1.0))
    rates = Rates((others[2], velocity[0], others[1], others[0], velocity[1]))
    assert rates.roles == ("velocity", "density", "energy", "drift")
    alone = [rate(part, known).reshape(COUNT, -1) for part in (*velocity, *others)]
    close(computed(rates, known), np.hstack((alone[0] + alone[1], *alone[2:])))


def before_a_wall() -> tuple[Array, dict[str, Any]]:
    """Fluid above a wall through y = 1, and particles at two depths behind it; the last two are out of its reach."""
    fluid = jittered((8, 6), 0.4, seed=3) + np.array([0.0, 1.0])
    behind = np.array([[2.2, 0.5], [4.0, 0.5], [5.5, -0.5], [3.1, -0.5], [4.0, -9.0], [5.0, -9.0]])
    places = np.concatenate((fluid, behind))
    count, many = len(places), len(behind)
    generator = np.random.default_rng(4)
    known = {
        "volume": generator.uniform(0.8, 1.2, count),
        "velocity": np.full((count, 2), 1e3),  # of walls: nobody asks
        "fluid": (np.arange(count) < count - many).astype(float),
        "normal": np.where(np.arange(count) < count - many, 0.0, 1.0)[:, None] * np.array([0.0, 1.0]),
        "depth": 1.0 - places[:, 1],
        "wall_velocity": np.tile((0.4, -0.1), (count, 1)),
    }
    return places, known


def fluid_velocity(places: Array, known: dict[str, Any], bend: float) -> Array:
    """u_wall + a y + b y^2 of both components."""
    y = places[:, [1]] - 1.0
    return np.asarray(known["wall_velocity"] + np.array([2.0, -0.7]) * y + bend * np.array([0.5, 0.3]) * y**2)


@pytest.mark.parametrize(("curve", "bend"), [(Line(), 0.0), (Parabola(), 0.0), (Parabola(), 1.0)])
def test_a_profile_that_the_fit_knows_is_found_exactly(curve: Line, bend: float) -> None:
    places, known = before_a_wall()
    fluid = known["fluid"] > 0
    known["velocity"][fluid] = fluid_velocity(places, known, bend)[fluid]
    found = computed(VelocityBeforeWall(KERNEL, curve), known, positions=places)[-6:]
    expected = np.tile((2.0, -0.7, bend * 0.5, bend * 0.3), (4, 1))
    # two spacings deep the kernel reaches one row: enough for a line
    rows = slice(0, 4) if curve == Line() else slice(0, 2)
    np.testing.assert_allclose(found[rows], expected[rows], rtol=1e-7, atol=1e-9)
    np.testing.assert_array_equal(found[4:], 0.0)


def test_a_line_through_a_parabola_fits_it_best_under_the_kernel() -> None:
    places, known = before_a_wall()
    fluid = known["fluid"] > 0
    known["velocity"][fluid] = fluid_velocity(places, known, 1.0)[fluid]
    found = computed(VelocityBeforeWall(KERNEL, Line()), known, positions=places)[-6:-2]
    for place, line in zip(places[-6:-2], found, strict=True):
        r2 = ((places[fluid] - place) ** 2).sum(axis=1)
        weight = known["volume"][fluid] * KERNEL.value(r2, 2)
        y = places[fluid, 1] - 1.0
        difference = known["velocity"][fluid] - known["wall_velocity"][fluid]
        expected = (weight * y) @ difference / (weight @ y**2)
        np.testing.assert_allclose(line, [*expected, 0.0, 0.0], rtol=1e-9)


def test_pressure_at_rest_goes_on_into_the_wall() -> None:
    """p = p0 + rho g . r is continued exactly; velocities are reflected about the wall's."""
    places, known = before_a_wall()
    force, fluid = np.array([0.6, -9.0]), known["fluid"] > 0
    hydrostatic = 5.0 + 1.3 * places @ force
    known |= {"density": np.full(len(places), 1.3), "body_force": np.tile(force, (len(places), 1))}
    known["pressure"] = np.where(fluid, hydrostatic, 1e3)
    known["velocity"][fluid] = 2.0, 3.0
    found = computed(FluidBeforeWall(KERNEL), known, positions=places)[-6:]
    np.testing.assert_allclose(found[:4, 2], hydrostatic[-6:-2], rtol=1e-10)
    np.testing.assert_allclose(found[:4, :2], np.tile((0.8 - 2.0, -0.2 - 3.0), (4, 1)), rtol=1e-10)
    np.testing.assert_allclose(found[4:], np.tile((0.4, -0.1, 0.0), (2, 1)), atol=1e-15)


def test_a_wall_sees_the_mean_velocity_under_the_kernel() -> None:
    places, known = before_a_wall()
    fluid = known["fluid"] > 0
    known["velocity"][fluid] = np.random.default_rng(5).normal(size=(fluid.sum(), 2))
    known |= {"density": np.ones(len(places)), "body_force": np.zeros((len(places), 2))}
    known["pressure"] = np.zeros(len(places))
    found = computed(FluidBeforeWall(KERNEL), known, positions=places)[-6]
    w = KERNEL.value(((places[fluid] - places[-6]) ** 2).sum(axis=1), 2)
    np.testing.assert_allclose(found[:2], (0.8, -0.2) - w @ known["velocity"][fluid] / w.sum(), rtol=1e-10)
