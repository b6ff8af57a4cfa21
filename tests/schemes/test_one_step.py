"""One time step against another program: plain NumPy over all pairs, written from the equations of Basa et al. 2009."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import pytest

from sphear.boundaries import Box
from sphear.cases.flow import FLOWS
from sphear.schemes.flow import Flow
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]

COUNT, WIDTH, NU, RHO0 = 8, 1.0, 1.0, 1.0
FORCE, UPPER_VELOCITY = np.array([3.0, -2.0]), 0.7


@dataclass(frozen=True)
class Plain:
    """A channel between y = -1/2 and 1/2, of period 1; the upper wall moves along x."""

    viscosity: str
    correction: str
    wall: str
    reduced: bool
    stiff: bool
    h: float
    sound_speed: float
    spacing: float

    def w(self, q: Array) -> tuple[Array, Array, Array]:
        """w, w' and w'' of the cubic spline, by its usual two pieces."""
        inner, outer = q < 1, (q >= 1) & (q < 2)
        w = np.where(inner, 1 - 1.5 * q**2 + 0.75 * q**3, np.where(outer, 0.25 * (2 - q) ** 3, 0))
        slope = np.where(inner, -3 * q + 2.25 * q**2, np.where(outer, -0.75 * (2 - q) ** 2, 0))
        curvature = np.where(inner, -3 + 4.5 * q, np.where(outer, 1.5 * (2 - q), 0))
        sigma = 10 / (7 * np.pi * self.h**2)
        return sigma * w, sigma / self.h * slope, sigma / self.h**2 * curvature

    def extended(self, x: Array, v: Array) -> tuple[Array, Array, Array]:
        """All particles and images as (places, source, velocities): mirrored once, and shifted by several periods."""
        walls = np.array([[0.0, 0.0], [UPPER_VELOCITY, 0.0]])
        places, velocities = [x], [v]
        for wall, y_wall, inwards in ((walls[0], -0.5, 1.0), (walls[1], 0.5, -1.0)):
            y = inwards * (x[:, 1] - y_wall)
            behind = 2 * wall - v
            if self.wall == "linear":
                near = y < self.spacing
                slope = np.sum((v[near, 0] - wall[0]) * y[near]) / np.sum(y[near] ** 2)
                behind[:, 0] = wall[0] - slope * y
            places.append(np.stack((x[:, 0], 2 * y_wall - x[:, 1]), axis=1))
            velocities.append(behind)
        shifts = [np.array([n * WIDTH, 0.0]) for n in (0, 1, -1, 2, -2)]
        everywhere = np.concatenate([place + shift for shift, place in product(shifts, places)])
        source = np.tile(np.arange(len(x)), len(shifts) * len(places))
        return everywhere, source, np.tile(np.concatenate(velocities), (len(shifts), 1))

    def acceleration(self, x: Array, v: Array) -> tuple[Array, Array, Array]:
        """Acceleration, density and pressure."""
        at, source, u = self.extended(x, v)
        mass = RHO0 * self.spacing**2
        d = at[: len(x), None] - at[None]
        r = np.sqrt((d**2).sum(axis=-1))
        apart = r > 0
        inverse = 1 / np.where(apart, r, 1)
        w, slope, curvature = self.w(r / self.h)
        gradient = (slope * inverse)[..., None] * d

        rho = (mass * w).sum(axis=1)  # (11)
        p = (
            RHO0 * self.sound_speed**2 / 7 * ((rho / RHO0) ** 7 - 1)  # (13)
            if self.stiff
            else self.sound_speed**2 * (rho - RHO0)
        )
        rho_e, p_e = rho[source], p[source]
        volume = mass / rho_e
        mu = RHO0 * NU

        one = (volume * w).sum(axis=1)
        grad_one = (volume[:, None] * gradient).sum(axis=1)
        kernel_gradient = gradient
        if self.correction != "none":  # (22), (26)
            gradient = gradient / one[:, None, None] - w[..., None] * (grad_one / one[:, None] ** 2)[:, None]
        if self.correction == "bonet_lok":
            moments = np.einsum("e,iea,eb->iab", volume, gradient, at)
            gradient = np.einsum("iab,ieb->iea", np.linalg.inv(moments), gradient)

        neighbours = apart & (r < 2 * self.h)
        mean = (neighbours * p_e).sum(axis=1) / neighbours.sum(axis=1) if self.reduced else np.zeros(len(x))
        stress = ((p - mean) / rho**2)[:, None] + (p_e - mean[:, None]) / rho_e**2  # (20), (8)
        result = -(mass * stress[..., None] * gradient).sum(axis=1)

        du = v[:, None] - u[None]
        rho_i, rho_j = rho[:, None], rho_e[None]
        if self.viscosity == "morris":  # (35)
            factor = mass * 2 * mu / (rho_i * rho_j) * (d * gradient).sum(axis=-1) * inverse**2
            result += (factor[..., None] * du).sum(axis=1)
        elif self.viscosity in ("violeau", "cleary_4.24"):
            if self.viscosity == "violeau":  # (33)
                factor = 8 * mass / (rho_i + rho_j) * (mu / rho_i + mu / rho_j)
            else:  # (34)
                factor = 4.24 * mass / (rho_i * rho_j) * 4 * mu * mu / (mu + mu)
            factor = factor * (du * d).sum(axis=-1) / (r**2 + (0.1 * self.h) ** 2)
            result += (factor[..., None] * gradient).sum(axis=1)
        elif self.viscosity == "takeda":  # (6) with (23)
            along = d * inverse[..., None]
            direct = along[..., :, None] * along[..., None, :]
            transverse = (slope * inverse)[..., None, None] * (np.eye(2) - direct)
            hessian = np.where(
                apart[..., None, None],
                curvature[..., None, None] * direct + transverse,
                curvature[..., None, None] * np.eye(2),
            )
            second = self._second_derivatives(volume, u, w, kernel_gradient, hessian)  # (i, component, a, b)
            laplacian = np.einsum("ikaa->ik", second)
            grad_div = np.einsum("ibab->ia", second)
            result += mu / rho[:, None] * (laplacian + grad_div / 3)
        else:  # (5), (29): the stress of all that can be a neighbour, then its divergence
            result += self._two_passes(at, u, volume, mu, rho, kernel_gradient)
        return result + FORCE, rho, p

    def _second_derivatives(self, volume: Array, u: Array, w: Array, gradient: Array, hessian: Array) -> Array:
        one = np.einsum("e,ie->i", volume, w)[:, None, None, None]
        d_one = np.einsum("e,iea->ia", volume, gradient)
        dd_one = np.einsum("e,ieab->iab", volume, hessian)
        f = np.einsum("e,ek,ie->ik", volume, u, w)
        df = np.einsum("e,ek,iea->ika", volume, u, gradient)
        ddf = np.einsum("e,ek,ieab->ikab", volume, u, hessian)
        mixed = np.einsum("ika,ib->ikab", df, d_one)
        numerator = ddf * one - mixed - mixed.swapaxes(2, 3) - np.einsum("ik,iab->ikab", f, dd_one)
        return np.asarray(numerator / one**2 + 2 * np.einsum("ik,ia,ib->ikab", f, d_one, d_one) / one**3)

    def _two_passes(self, at: Array, u: Array, volume: Array, mu: float, rho: Array, gradient: Array) -> Array:
        tau = np.zeros((len(at), 2, 2))
        for e in np.flatnonzero(np.abs(gradient).sum(axis=(0, 2)) > 0):
            d = at[e] - at
            r = np.sqrt((d**2).sum(axis=1))
            grad_w = (self.w(r / self.h)[1] / np.where(r > 0, r, 1))[:, None] * d
            grad_u = np.einsum("k,ka,kb->ab", volume, u, grad_w)
            tau[e] = mu * (grad_u + grad_u.T - 2 / 3 * np.trace(grad_u) * np.eye(2))
        return np.asarray(np.einsum("e,eab,ieb->ia", volume, tau, gradient) / rho[:, None])

    def step(self, x: Array, v: Array, dt: float) -> tuple[Array, Array, Array, Array]:
        """The midpoint rule."""
        first, *_ = self.acceleration(x, v)
        x_half, v_half = x + dt / 2 * v, v + dt / 2 * first
        second, rho, p = self.acceleration(x_half, v_half)
        x, v = x + dt * v_half, v + dt * second
        return np.stack((x[:, 0] % WIDTH, x[:, 1]), axis=1), v, rho, p


def channel() -> Problem:
    """Jittered particles with random velocities, so that no term vanishes."""
    spacing = WIDTH / COUNT
    generator = np.random.default_rng(0)
    ticks = (np.arange(COUNT) + 0.5) * spacing
    lattice = np.stack(np.meshgrid(ticks, ticks - 0.5, indexing="ij"), axis=-1).reshape(-1, 2)
    return Problem(
        positions=lattice + 0.4 * spacing * (generator.random(lattice.shape) - 0.5),
        velocities=generator.normal(size=lattice.shape),
        box=Box((0.0, -0.5), (1.0, 0.5), ("periodic", "walls"), upper_velocity=(UPPER_VELOCITY, 0.0)),
        body_force=tuple(FORCE),
        spacing=spacing,
        density=RHO0,
        kinematic_viscosity=NU,
        speed=1.0,
        length=0.5,
    )


@pytest.mark.parametrize(
    ("viscosity", "correction", "wall", "reduction", "state"),
    [
        ("morris", "none", "linear", "mean", "batchelor_tait"),
        ("morris", "none", "mirror", "none", "batchelor_tait"),
        ("violeau", "shepard", "mirror", "mean", "linear"),
        ("cleary_4.24", "bonet_lok", "linear", "none", "batchelor_tait"),
        ("two_pass", "none", "linear", "mean", "batchelor_tait"),
        ("takeda", "shepard", "linear", "mean", "batchelor_tait"),
    ],
)
def test_one_step(viscosity: str, correction: str, wall: str, reduction: str, state: str) -> None:
    settings = FLOWS["poiseuille"].settings(
        viscosity=viscosity, correction=correction, wall_velocity=wall, pressure_reduction=reduction,
        equation_of_state=state, resolution=COUNT,
    )  # fmt: skip
    problem = channel()
    flow = Flow(problem, settings)
    plain = Plain(
        viscosity, correction, wall, reduction == "mean", state == "batchelor_tait", flow.kernel.h, flow.sound_speed,
        problem.spacing,
    )  # fmt: skip
    x, v, rho, p = plain.step(problem.positions, problem.velocities, flow.time_step)
    flow.advance(1)
    assert flow.steps == 1
    assert flow.time == flow.time_step
    np.testing.assert_allclose(flow.positions, x, rtol=1e-10, atol=1e-10)
    np.testing.assert_allclose(flow.velocities, v, rtol=1e-10, atol=1e-10 * np.abs(v).max())
    np.testing.assert_allclose(flow.density, rho, rtol=1e-10)
    np.testing.assert_allclose(flow.pressure, p, rtol=1e-10, atol=1e-10 * np.abs(p).max())
    assert np.abs(v - problem.velocities).max() > 0.01
