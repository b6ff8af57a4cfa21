"""Every viscous term against plain NumPy, written from the papers' equations (as corrected in the documentation)."""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from functools import cached_property
from typing import Any

import numpy as np
import pytest

from sphear import (
    VISCOSITY,
    Cleary,
    CubicSpline,
    EspanolRevenga,
    Gotoh,
    LeastSquares,
    Monaghan,
    Morris,
    Oger,
    Schwaiger,
    SphearError,
    Violeau,
    ViscousTerm,
    laplacian,
    viscous_acceleration,
)
from tests.particles import Array, all_pairs, interior, jittered, summed

H = 1.6
COUNTS = {1: (20,), 2: (9, 9), 3: (6, 5, 5)}
SIGMA = {1: 2 / (3 * H), 2: 10 / (7 * np.pi * H**2), 3: 1 / (np.pi * H**3)}


class Cloud:
    """Disordered particles with edges and everything variable, their pairs, and the cubic spline of each pair."""

    def __init__(self, dimension: int) -> None:
        self.d = dimension
        self.positions = jittered(COUNTS[dimension], 0.5, seed=dimension)
        self.n = len(self.positions)
        generator = np.random.default_rng(11)
        self.volume = generator.uniform(0.8, 1.2, self.n)
        self.rho = generator.uniform(0.5, 2.0, self.n)
        self.mu = generator.uniform(0.5, 2.0, self.n)
        self.u = generator.uniform(-1.0, 1.0, (self.n, dimension))
        self.i, self.j, self.r_ij = all_pairs(self.positions, 2 * H)
        self.r: Any = np.linalg.norm(self.r_ij, axis=1)
        self.e = self.r_ij / self.r[:, None]
        self.u_ij = self.u[self.i] - self.u[self.j]
        self.m_j = (self.volume * self.rho)[self.j]
        self.v_j = self.volume[self.j]
        q = self.r / H
        self.w = SIGMA[self.d] * np.where(q < 1, 1 - 1.5 * q**2 + 0.75 * q**3, 0.25 * (2 - q) ** 3)
        self.dw = SIGMA[self.d] / H * np.where(q < 1, -3 * q + 2.25 * q**2, -0.75 * (2 - q) ** 2)
        self.d2w = SIGMA[self.d] / H**2 * np.where(q < 1, -3 + 4.5 * q, 1.5 * (2 - q))
        self.w0, self.curvature0 = SIGMA[self.d], -3 * SIGMA[self.d] / H**2
        self.grad_w = self.dw[:, None] * self.e
        ee = self.e[:, :, None] * self.e[:, None, :]
        self.hessian_w = self.d2w[:, None, None] * ee + (self.dw / self.r)[:, None, None] * (np.eye(self.d) - ee)

    def sum(self, values: Array) -> Array:
        return summed(self.i, values, self.n)

    def with_one_viscosity(self, mu: float) -> Cloud:
        """The same particles with the same viscosity everywhere."""
        other = copy(self)
        other.mu = np.full(self.n, mu)
        return other

    def arrays(self) -> dict[str, Any]:
        return {"dynamic_viscosity": self.mu, "density": self.rho, "volumes": self.volume, "kernel": CubicSpline(H)}

    @cached_property
    def shepard(self) -> tuple[Array, Array, Array]:
        """<1> and its derivatives, with the particle itself."""
        one = self.sum(self.v_j * self.w) + self.volume * self.w0
        hessian = self.sum(self.v_j[:, None, None] * self.hessian_w)
        hessian += (self.volume * self.curvature0)[:, None, None] * np.eye(self.d)
        return one, self.sum(self.v_j[:, None] * self.grad_w), hessian

    @cached_property
    def gamma(self) -> Array:
        """Zheng's eq. 19."""
        moment = self.sum(self.v_j[:, None, None] * self.grad_w[:, :, None] * -self.r_ij[:, None, :])
        return np.asarray(np.linalg.inv(moment))

    def gradients(self, correction: str) -> Any:
        """The corrected grad W_ij of each pair: Basa's eqs. 22 and 26, Zheng's eq. 19."""
        if correction == "none":
            return self.grad_w
        if correction == "renormalised":
            return np.asarray(np.einsum("pab,pb->pa", self.gamma[self.i], self.grad_w))
        one, grad_one, _ = (x[self.i] for x in self.shepard)
        level_0 = self.grad_w / one[:, None] - self.w[:, None] * grad_one / one[:, None] ** 2
        if correction == "shepard":
            return level_0
        # r_b - r_a in place of r_b: the same, because grad W[0] sums to zero
        inverse = np.linalg.inv(self.sum(self.v_j[:, None, None] * level_0[:, :, None] * -self.r_ij[:, None, :]))
        return np.asarray(np.einsum("pab,pb->pa", inverse[self.i], level_0))

    def hessians(self, correction: str) -> Any:
        """The second derivatives of the corrected W_ij: Basa's eq. 23."""
        if correction in ("none", "renormalised"):
            return self.hessian_w
        one, d1, dd1 = (x[self.i] for x in self.shepard)
        one, w = one[:, None, None], self.w[:, None, None]
        mixed = self.grad_w[:, :, None] * d1[:, None, :] + d1[:, :, None] * self.grad_w[:, None, :]
        squares = d1[:, :, None] * d1[:, None, :]
        return np.asarray((self.hessian_w * one - mixed - w * dd1) / one**2 + 2 * w * squares / one**3)


def approach(c: Cloud, eta: float = 0.1) -> Array:
    """(u_ij . r_ij) / (r_ij^2 + eta^2 h^2)."""
    return np.asarray((c.u_ij * c.r_ij).sum(axis=1) / (c.r**2 + (eta * H) ** 2))


def takeda(c: Cloud, correction: str) -> Array:
    """Eq. 6 in any dimension, with second derivatives by eq. 27, the particle itself included, or by eq. 23."""
    hessian = c.hessians(correction)
    u_j = c.u[c.j]
    if correction in ("shepard", "bonet_lok"):
        u_j = u_j - c.u[c.i]
    second = c.sum(c.v_j[:, None, None, None] * hessian[:, :, :, None] * u_j[:, None, None, :])
    if correction not in ("shepard", "bonet_lok"):
        second += c.volume[:, None, None, None] * c.curvature0 * np.eye(c.d)[None, :, :, None] * c.u[:, None, None, :]
    stress = np.einsum("naak->nk", second) + np.einsum("nkaa->nk", second) / 3
    return np.asarray((c.mu / c.rho)[:, None] * stress)


def two_pass(c: Cloud, correction: str) -> Array:
    """Eqs. 29 and 5, the latter with the sign of eq. 4; with what the particle adds itself in levels 0 and 1."""
    grad = c.v_j[:, None] * c.gradients(correction)
    itself = -c.sum(grad) if correction in ("shepard", "bonet_lok") else np.zeros((c.n, c.d))
    grad_u = c.sum(grad[:, None, :] * c.u[c.j][:, :, None]) + itself[:, None, :] * c.u[:, :, None]
    divergence = np.trace(grad_u, axis1=1, axis2=2)[:, None, None]
    tau = c.mu[:, None, None] * (grad_u + grad_u.transpose(0, 2, 1) - 2 / 3 * divergence * np.eye(c.d))
    of_tau = c.sum(np.einsum("pab,pb->pa", tau[c.j], grad)) + np.einsum("nab,nb->na", tau, itself)
    return np.asarray(of_tau / c.rho[:, None])


def violeau(c: Cloud, correction: str) -> Array:
    """Eq. 33 with 2 (d + 2) for 8."""
    factor = {1: 6, 2: 8, 3: 10}[c.d] / (c.rho[c.i] + c.rho[c.j]) * (c.mu[c.i] / c.rho[c.i] + c.mu[c.j] / c.rho[c.j])
    return c.sum((c.m_j * factor * approach(c))[:, None] * c.gradients(correction))


def cleary(xi: float | None) -> Callable[[Cloud, str], Array]:
    def equation_34(c: Cloud, correction: str) -> Array:
        mu_i, mu_j = c.mu[c.i], c.mu[c.j]
        factor = (xi or c.d + 2) / (c.rho[c.i] * c.rho[c.j]) * 4 * mu_i * mu_j / (mu_i + mu_j)
        return c.sum((c.m_j * factor * approach(c))[:, None] * c.gradients(correction))

    return equation_34


def morris(eta: float) -> Callable[[Cloud, str], Array]:
    def equation_35(c: Cloud, correction: str) -> Array:
        factor = c.m_j * (c.mu[c.i] + c.mu[c.j]) / (c.rho[c.i] * c.rho[c.j]) / (c.r**2 + (eta * H) ** 2)
        return c.sum((factor * (c.r_ij * c.gradients(correction)).sum(axis=1))[:, None] * c.u_ij)

    return equation_35


def monaghan(alpha_c: float | None = None, beta: float = 0.0, receding: bool = False) -> Callable[[Cloud, str], Array]:
    def equations_31_and_32(c: Cloud, correction: str) -> Array:
        mu = H * approach(c)
        nu = 0.5 * (c.mu[c.i] / c.rho[c.i] + c.mu[c.j] / c.rho[c.j])
        strength = 2 * (c.d + 2) * nu / H if alpha_c is None else alpha_c
        linear = np.where((mu < 0) | receding, -strength * mu, 0.0)
        quadratic = np.where(mu < 0, beta * mu**2, 0.0)
        factor = -c.m_j * (linear + quadratic) / (0.5 * (c.rho[c.i] + c.rho[c.j]))
        return c.sum(factor[:, None] * c.gradients(correction))

    return equations_31_and_32


def espanol_revenga(bulk: float) -> Callable[[Cloud, str], Array]:
    def equation_58(c: Cloud, correction: str) -> Array:
        """With F = -(r . grad W) / r^2 and number densities 1 / V; 5 is d + 2."""
        f = -(c.r_ij * c.gradients(correction)).sum(axis=1) / c.r**2
        shear = 0.5 * (c.mu[c.i] + c.mu[c.j])
        zeta = bulk * shear
        across = (5 / 3 * shear - zeta)[:, None] * c.u_ij
        along = ((c.d + 2) * (zeta + shear / 3) * (c.u_ij * c.e).sum(axis=1))[:, None] * c.e
        force = c.sum(-(c.volume[c.i] * c.v_j * f)[:, None] * (across + along))
        return np.asarray(force / (c.volume * c.rho)[:, None])

    return equation_58


def mean_viscosity(of_differences: Callable[[Cloud, str, Array], Array]) -> Callable[[Cloud, str], Array]:
    """div(mu grad u) / rho_i: a Laplacian of each component, of (mu_i + mu_j) / 2 (u_j - u_i) for f_j - f_i.

    Everywhere that f_j - f_i enters: in the gradients and the fits that are inside of the Laplacian, too.
    """

    def acceleration(c: Cloud, correction: str) -> Array:
        differences = ((c.mu[c.i] + c.mu[c.j]) / 2)[:, None] * (c.u[c.j] - c.u[c.i])
        of_components = [of_differences(c, correction, differences[:, k]) for k in range(c.d)]
        return np.stack(of_components, axis=1) / c.rho[:, None]

    return acceleration


def gotoh(c: Cloud, correction: str, f_ji: Array) -> Array:
    """Eq. 16 with sign and factor that make it a Laplacian in d dimensions; W'' along r and W'/r across it."""
    hessian = c.hessians(correction)
    along = np.einsum("pa,pab,pb->p", c.e, hessian, c.e)
    across = (np.trace(hessian, axis1=1, axis2=2) - along) / (c.d - 1)
    return c.sum({2: 1 / 2, 3: 2 / 5}[c.d] * c.v_j * f_ji * (along - across))


def schwaiger(eta: float) -> Callable[[Cloud, str], Array]:
    def equations_17_to_19(c: Cloud, correction: str, f_ji: Array) -> Array:
        regular = c.r**2 + (eta * H) ** 2
        radial = c.v_j * (c.r_ij * c.grad_w).sum(axis=1) / regular
        h = c.sum(radial[:, None, None] * c.r_ij[:, :, None] * c.r_ij[:, None, :])
        grad_f = np.einsum("nab,nb->na", c.gamma, c.sum((c.v_j * f_ji)[:, None] * c.grad_w))
        bracket = 2 * c.sum(radial * -f_ji) - 2 * (grad_f * c.sum(c.v_j[:, None] * c.grad_w)).sum(axis=1)
        return np.asarray(-np.trace(np.linalg.inv(h), axis1=1, axis2=2) / c.d * bracket)

    return mean_viscosity(equations_17_to_19)


def oger(eta: float) -> Callable[[Cloud, str], Array]:
    def equation_20(c: Cloud, correction: str, f_ji: Array) -> Array:
        radial = (c.r_ij * c.gradients("renormalised")).sum(axis=1) / (c.r**2 + (eta * H) ** 2)
        return 2 * c.sum(c.v_j * -f_ji * radial)

    return mean_viscosity(equation_20)


def fatehi_manzari(c: Cloud, correction: str, f_ji: Array) -> Array:
    """B from what it is for: for each particle, the sum with it is exact for every product of two coordinates."""
    result = np.empty(c.n)
    axes = [(a, b) for a in range(c.d) for b in range(a, c.d)]
    for i in range(c.n):
        near = c.i == i
        x, e, grad, v = -c.r_ij[near], c.e[near], c.grad_w[near], c.v_j[near]

        def terms(g: Array, x: Array = x, e: Array = e, grad: Array = grad, v: Array = v, i: int = i) -> Array:
            """Sum 2 V e (x) grad W (g_ij / r - e . <grad g>), g being the differences g_j - g_i."""
            gradient = c.gamma[i] @ ((v * g) @ grad)
            bracket = -g / np.linalg.norm(x, axis=1) - e @ gradient
            return np.asarray(np.einsum("p,pa,pb->ab", 2 * v * bracket, e, grad))

        tensors = [terms(x[:, a] * x[:, b]) for a, b in axes]
        system = [[t[a, b] + (t[b, a] if a != b else 0.0) for a, b in axes] for t in tensors]
        packed = np.linalg.solve(system, [2.0 if a == b else 0.0 for a, b in axes])
        tensor = np.zeros((c.d, c.d))
        for (a, b), value in zip(axes, packed, strict=True):
            tensor[a, b] = tensor[b, a] = value
        result[i] = (tensor * terms(f_ji[near])).sum()
    return result


def least_squares(degree: int) -> Callable[[Cloud, str], Array]:
    def fit(c: Cloud, correction: str, f_ji: Array) -> Array:
        powers = [p for p in np.ndindex(*(degree + 1,) * c.d) if 1 <= sum(p) <= degree]
        second = [2.0 if max(p) == 2 == sum(p) else 0.0 for p in powers]
        result = np.empty(c.n)
        for i in range(c.n):
            near = c.i == i
            weight = np.sqrt(c.v_j[near] * c.w[near])
            basis = np.stack([np.prod((-c.r_ij[near]) ** p, axis=1) for p in powers], axis=1)
            result[i] = second @ np.linalg.lstsq(weight[:, None] * basis, weight * f_ji[near])[0]
        return result

    return mean_viscosity(fit)


Reference = Callable[[Cloud, str], Array]
TERMS: dict[str, tuple[ViscousTerm, Reference]] = {
    "takeda": (VISCOSITY["takeda"], takeda),
    "two_pass": (VISCOSITY["two_pass"], two_pass),
    "violeau": (Violeau(), violeau),
    "cleary": (Cleary(), cleary(None)),
    "cleary_4.24": (VISCOSITY["cleary_4.24"], cleary(4.24)),
    "cleary_4.96333": (VISCOSITY["cleary_4.96333"], cleary(4.96333)),
    "morris": (Morris(), morris(0.0)),
    "morris, eta": (Morris(eta=0.2), morris(0.2)),
    "monaghan": (Monaghan(), monaghan()),
    "monaghan, alpha": (Monaghan(alpha=0.7, beta=2.0, sound_speed=3.0), monaghan(2.1, 2.0)),
    "monaghan, receding": (Monaghan(beta=1.5, receding=True), monaghan(None, 1.5, True)),
    "espanol_revenga": (EspanolRevenga(), espanol_revenga(0.0)),
    "espanol_revenga, bulk": (EspanolRevenga(bulk=0.8), espanol_revenga(0.8)),
    "gotoh": (Gotoh(), mean_viscosity(gotoh)),
    "schwaiger": (Schwaiger(), schwaiger(0.0)),
    "schwaiger, eta": (Schwaiger(eta=0.1), schwaiger(0.1)),
    "oger": (Oger(), oger(0.0)),
    "oger, eta": (Oger(eta=0.1), oger(0.1)),
    "fatehi_manzari": (VISCOSITY["fatehi_manzari"], mean_viscosity(fatehi_manzari)),
    "least_squares_2": (LeastSquares(), least_squares(2)),
    "least_squares_3": (LeastSquares(degree=3), least_squares(3)),
    "least_squares_4": (LeastSquares(degree=4), least_squares(4)),
}
WITH_CORRECTION = ("takeda", "two_pass", "violeau", "cleary", "morris", "monaghan", "espanol_revenga", "gotoh")
PLANE, SPACE = Cloud(2), Cloud(3)


def compared(cloud: Cloud, name: str, correction: str) -> None:
    term, reference = TERMS[name]
    if name == "takeda":  # which is of a constant viscosity
        with pytest.raises(SphearError, match="made for a viscosity that is constant"):
            viscous_acceleration(cloud.positions, cloud.u, viscosity=term, correction=correction, **cloud.arrays())
        cloud = cloud.with_one_viscosity(1.3)
    expected = reference(cloud, correction)
    arguments: Any = cloud.arrays()
    known = np.full(cloud.n, True)
    if name == "least_squares_4":  # needs 14 neighbours, which a particle in a corner does not have
        arguments["fallback"] = "nan"
        known = interior(cloud.positions, 1.0)
    found = viscous_acceleration(cloud.positions, cloud.u, viscosity=term, correction=correction, **arguments)
    np.testing.assert_allclose(found[known], expected[known], rtol=0, atol=1e-10 * np.abs(expected).max())


@pytest.mark.parametrize("name", TERMS)
def test_terms_in_the_plane(name: str) -> None:
    compared(PLANE, name, "none")


@pytest.mark.parametrize("correction", ["shepard", "bonet_lok"])
@pytest.mark.parametrize("name", WITH_CORRECTION)
def test_terms_with_a_corrected_kernel(name: str, correction: str) -> None:
    compared(PLANE, name, correction)


@pytest.mark.parametrize("name", ["two_pass", "violeau"])
def test_terms_with_a_renormalised_gradient(name: str) -> None:
    compared(PLANE, name, "renormalised")


@pytest.mark.parametrize(
    "name", ["takeda", "violeau", "cleary", "espanol_revenga", "gotoh", "schwaiger", "fatehi_manzari"]
)
def test_terms_in_space(name: str) -> None:
    compared(SPACE, name, "none")


@pytest.mark.parametrize("name", ["schwaiger", "fatehi_manzari", "least_squares_2", "violeau"])
def test_terms_along_a_line(name: str) -> None:
    compared(Cloud(1), name, "none")


@pytest.mark.parametrize("correction", ["none", "shepard"])
def test_the_laplacian_of_two_passes_is_equation_29(correction: str) -> None:
    c, f = PLANE, PLANE.u[:, 0]
    grad = c.v_j[:, None] * c.gradients(correction)
    itself = -c.sum(grad) if correction == "shepard" else np.zeros((c.n, c.d))
    first = c.sum(grad * f[c.j, None]) + itself * f[:, None]
    expected = c.sum((grad * first[c.j]).sum(axis=1)) + (itself * first).sum(axis=1)
    found = laplacian(
        c.positions, f, viscosity="two_pass", correction=correction, volumes=c.volume, kernel=CubicSpline(H)
    )
    np.testing.assert_allclose(found, expected, atol=1e-11)


@pytest.mark.parametrize("name", ["morris", "gotoh", "schwaiger", "oger", "fatehi_manzari", "least_squares_2"])
def test_the_laplacian_is_the_acceleration_per_viscosity(name: str) -> None:
    """For terms that are a Laplacian of each component; Takeda's and two passes have grad div u as well."""
    arguments: Any = {"volumes": PLANE.volume, "kernel": CubicSpline(H), "viscosity": TERMS[name][0]}
    of_components = laplacian(PLANE.positions, PLANE.u, **arguments)
    acceleration = viscous_acceleration(PLANE.positions, PLANE.u, **arguments)
    np.testing.assert_allclose(of_components, acceleration, rtol=1e-12, atol=1e-12)


def test_cleary_with_constant_viscosity_and_density_is_violeau() -> None:
    for cloud in (PLANE, SPACE):
        arguments: Any = cloud.arrays() | {"dynamic_viscosity": 0.3, "density": 1.7}
        one, other = (
            viscous_acceleration(cloud.positions, cloud.u, viscosity=term, **arguments)
            for term in ("cleary", "violeau")
        )
        np.testing.assert_allclose(one, other, rtol=1e-12)


@pytest.mark.parametrize(("name", "ratio"), [("cleary_4.24", 1.06), ("cleary_4.96333", 4.96333 / 4)])
def test_the_calibrated_factors_are_more_viscosity(name: str, ratio: float) -> None:
    calibrated, analytic = (
        viscous_acceleration(PLANE.positions, PLANE.u, viscosity=term, **PLANE.arrays()) for term in (name, "cleary")
    )
    np.testing.assert_allclose(calibrated, ratio * analytic, rtol=1e-12)


def test_morris_with_a_renormalised_gradient_is_oger() -> None:
    arguments: Any = {"volumes": PLANE.volume, "kernel": CubicSpline(H)}
    corrected = laplacian(PLANE.positions, PLANE.u, viscosity="morris", correction="renormalised", **arguments)
    np.testing.assert_allclose(
        corrected, laplacian(PLANE.positions, PLANE.u, viscosity="oger", **arguments), rtol=1e-12
    )


def test_gotoh_as_printed_is_minus_two_times_gotoh_in_the_plane() -> None:
    arguments: Any = {"volumes": PLANE.volume, "kernel": CubicSpline(H)}
    printed, ours = (
        laplacian(PLANE.positions, PLANE.u, viscosity=Gotoh(printed=p), **arguments) for p in (True, False)
    )
    np.testing.assert_allclose(printed, -2.0 * ours, rtol=1e-12)


def test_gotoh_has_nothing_to_correct_in_one_dimension() -> None:
    with pytest.raises(SphearError, match="takes no correction in one dimension"):
        laplacian(np.arange(5.0)[:, None], np.arange(5.0), viscosity="gotoh", correction="shepard")


@pytest.mark.parametrize("degree", [1, 5, 2.5])
def test_only_degrees_two_to_four(degree: Any) -> None:
    with pytest.raises(SphearError, match="must be 2, 3 or 4"):
        LeastSquares(degree=degree)


@pytest.mark.parametrize("xi", [0.0, -1.0, np.nan])
def test_clearys_factor_is_positive(xi: float) -> None:
    with pytest.raises(SphearError, match=r"xi .* must be positive"):
        Cleary(xi=xi)
