"""Another program for flows: plain NumPy over all pairs, written from the equations of Basa et al. 2009 in 2-D."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np

from sphear.schemes.problem import Problem
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings

Array = np.ndarray[Any, Any]
GAMMA = 1.4


@dataclass(frozen=True)
class State:
    """Of the fluid's particles, followed by those of fixed walls: places, velocities, densities, energies, drifts."""

    x: Array
    v: Array
    rho: Array
    e: Array
    w: Array

    def moved(self, dt: float, x: Array, v: Array, rho: Array, e: Array) -> State:
        """These rates for so long; walls stay where they are."""
        count = len(x)
        places, velocities = self.x.copy(), self.v.copy()
        places[:count] += dt * x
        velocities[:count] += dt * v
        return replace(self, x=places, v=velocities, rho=self.rho + dt * rho, e=self.e + dt * e)


@dataclass(frozen=True)
class Walls:
    """Fixed particles: places, velocities and inward normals of their walls, depths (0 in corners)."""

    x: Array
    v: Array
    normal: Array
    depth: Array


@dataclass(frozen=True)
class Entries:
    """All particles, then their images: where, of which particle, velocity, drift, and whether they stand on a wall."""

    at: Array
    source: Array
    u: Array
    w: Array
    on_wall: Array


@dataclass(frozen=True)
class Rates:
    """Of velocity, density and energy, with the drift, density and pressure that belong to them."""

    v: Array
    rho: Array
    e: Array
    w: Array
    density: Array
    pressure: Array


@dataclass(frozen=True)
class Plain:
    """A flow; all its numbers are those of the settings, which must give them."""

    problem: Problem
    settings: WeaklyCompressibleSettings

    @property
    def dx(self) -> float:
        return self.problem.spacing

    @property
    def h(self) -> float:
        assert self.settings.h_over_dx is not None
        return self.settings.h_over_dx * self.dx

    @property
    def gas(self) -> bool:
        return self.settings.equation_of_state == "ideal_gas"

    @property
    def c0(self) -> float:
        if self.gas:
            return float(np.sqrt(GAMMA * self.settings.initial_pressure / self.problem.density))
        assert self.settings.sound_speed is not None
        return self.settings.sound_speed

    @property
    def mass(self) -> float:
        return self.problem.density * self.dx**2

    @property
    def energy_at_rest(self) -> float:
        return self.settings.initial_pressure / ((GAMMA - 1) * self.problem.density)

    def w(self, q: Array) -> tuple[Array, Array, Array]:
        """w, w' and w'' of the cubic spline, by its usual two pieces."""
        inner, outer = q < 1, (q >= 1) & (q < 2)
        w = np.where(inner, 1 - 1.5 * q**2 + 0.75 * q**3, np.where(outer, 0.25 * (2 - q) ** 3, 0))
        slope = np.where(inner, -3 * q + 2.25 * q**2, np.where(outer, -0.75 * (2 - q) ** 2, 0))
        curvature = np.where(inner, -3 + 4.5 * q, np.where(outer, 1.5 * (2 - q), 0))
        sigma = 10 / (7 * np.pi * self.h**2)
        return sigma * w, sigma / self.h * slope, sigma / self.h**2 * curvature

    # walls

    def wall_velocity(self, axis: int, side: int) -> Array:
        box = self.problem.box
        given = box.upper_velocity if side else box.lower_velocity
        return np.array(given if given and axis == box.wall_axes[-1] else (0.0, 0.0))

    def walls(self) -> Walls:
        """Fixed particles on the lattice of the fluid, thick enough that nobody sees their end."""
        box, settings = self.problem.box, self.settings
        if settings.walls == "mirror":
            return Walls(np.empty((0, 2)), np.empty((0, 2)), np.empty((0, 2)), np.empty(0))
        passes = 2 if settings.viscosity == "two_pass" else 1
        # by the continuity equation walls have the thickness of the kernel, and densities that know of it
        layers = int(np.ceil(2 * self.h * passes / self.dx))
        if settings.density == "summation":
            layers = int(np.ceil(2 * self.h * (passes + 1) / self.dx)) + 1
        counts = [round((high - low) / self.dx) for low, high in zip(box.lower, box.upper, strict=True)]
        ticks = [
            np.arange(-layers, n + layers) if side == "walls" else np.arange(n)
            for n, side in zip(counts, box.sides, strict=True)
        ]
        found = []
        for place in product(*ticks):
            sides = [(axis, int(place[axis] >= n)) for axis, n in enumerate(counts) if not 0 <= place[axis] < n]
            if not sides:
                continue
            velocity = min((self.wall_velocity(axis, side) for axis, side in sides), key=lambda u: np.abs(u).max())
            normal, depth = np.zeros(2), 0.0
            x = np.array(box.lower) + (np.array(place) + 0.5) * self.dx
            if len(sides) == 1:
                (axis, side), *_ = sides
                normal[axis] = -1.0 if side else 1.0
                depth = x[axis] - box.upper[axis] if side else box.lower[axis] - x[axis]
            found.append((x, velocity, normal, depth))
        places, velocities, normals, depths = (np.array(column) for column in zip(*found, strict=True))
        return Walls(places, velocities, normals, depths)

    def continued(self, axis: int, side: int, s: State, at: Array, own: Array) -> Array:
        """The velocities of images of particles with the velocities `own`, at places behind one mirroring wall."""
        box, wall = self.problem.box, self.wall_velocity(axis, side)
        low, high, other = box.lower[axis], box.upper[axis], 1 - axis
        depth = at[:, axis] - high if side else low - at[:, axis]
        y = high - s.x[:, axis] if side else s.x[:, axis] - low
        rule = self.settings.continuation
        behind = 2 * wall - own
        if rule == "mirror":
            return behind
        # nodes along a wall that ends at others: each particle belongs to the two beside it
        length = box.upper[other] - box.lower[other]
        nodes = 2 + int(length / (4 * self.dx)) if box.sides[other] == "walls" else 1
        places = np.linspace(0, length, nodes) if nodes > 1 else np.zeros(1)

        def shares(x: Array) -> Array:
            along = np.clip(x[:, other] - box.lower[other], 0, length)[:, None]
            return np.maximum(0, 1 - np.abs(along - places) / places[1]) if nodes > 1 else np.ones((len(x), 1))

        values = np.empty((nodes, len(at)))
        of_particles, u = shares(s.x), s.v[:, other] - wall[other]
        width = high - low
        for node in range(nodes):
            weight = of_particles[:, node]
            near = weight > 0
            if rule == "global_quadratic":
                far = self.wall_velocity(axis, 1 - side)[other] - wall[other]
                bend = _fitted((y * (width - y))[near, None], (u - far * y / width)[near], weight[near])
                values[node] = -far * depth / width - bend[0] * depth * (width + depth)
            else:
                near &= y < (1 if rule == "linear" else 3) * self.dx
                basis = y[near, None] ** ([1] if rule == "linear" else [1, 2])
                found = _fitted(basis, u[near], weight[near])
                values[node] = sum(a * (-depth) ** (n + 1) for n, a in enumerate(found))
        behind[:, other] = wall[other] + (shares(at) * values.T).sum(axis=1)
        return behind

    def extended(self, s: State) -> Entries:
        """Images over one period, and behind mirrors as deep as the box, and on walls."""
        box = self.problem.box
        at, source = s.x, np.arange(len(s.x))
        u, w = s.v, s.w
        on_wall, reflected = np.zeros(len(at), bool), np.zeros(len(at), bool)
        for axis, sides in enumerate(box.sides):
            period = box.upper[axis] - box.lower[axis]
            rows: list[tuple[Array, ...]] = [(at, source, u, w, on_wall, reflected)]
            if sides == "periodic":
                for shift in (period, -period):
                    rows.append((at + shift * np.eye(2)[axis], source, u, w, on_wall, reflected))
            elif self.settings.walls == "mirror":
                flip = np.where(np.arange(2) == axis, -1.0, 1.0)
                for side, wall in enumerate((box.lower[axis], box.upper[axis])):
                    place = at.copy()
                    place[:, axis] = 2 * wall - at[:, axis]
                    behind = self.continued(axis, side, s, place, s.v[source])
                    # twice reflected, as the particle was
                    behind = np.where(reflected[:, None], s.v[source], behind)
                    rows.append((place, source, behind, w * flip, on_wall, np.ones(len(at), bool)))
                    if self.settings.wall_particles:
                        near = np.abs(at[:, axis] - wall) < self.dx
                        place = at[near].copy()
                        place[:, axis] = wall
                        still = np.zeros_like(place)
                        many = np.ones(len(place), bool)
                        rows.append((place, source[near], still + self.wall_velocity(axis, side), still, many, many))
            at, source, u, w, on_wall, reflected = (np.concatenate(column) for column in zip(*rows, strict=True))
        return Entries(at, source, u, w, on_wall)

    # sums

    def pairs(self, at: Array, rows: int) -> tuple[Array, Array, Array, Array, Array]:
        """d, r, W, grad W and W'' of the first rows with all."""
        d = at[:rows, None] - at[None]
        r = np.sqrt((d**2).sum(axis=-1))
        w, slope, curvature = self.w(r / self.h)
        return d, r, w, (slope / np.where(r > 0, r, 1))[..., None] * d, curvature

    def corrected(self, volume: Array, w: Array, gradient: Array, at: Array) -> Array:
        """(22), (26)."""
        if self.settings.correction == "none":
            return gradient
        one = (volume * w).sum(axis=1)
        grad_one = (volume[:, None] * gradient).sum(axis=1)
        gradient = gradient / one[:, None, None] - w[..., None] * (grad_one / one[:, None] ** 2)[:, None]
        if self.settings.correction == "bonet_lok":
            moments = np.einsum("e,iea,eb->iab", volume, gradient, at)
            gradient = np.einsum("iab,ieb->iea", np.linalg.inv(moments), gradient)
        return gradient

    def pressure(self, rho: Array, e: Array) -> Array:
        """(12), (13) or its tangent."""
        rho0 = self.problem.density
        if self.gas:
            return np.asarray((GAMMA - 1) * rho * e)
        if self.settings.equation_of_state == "linear":
            return np.asarray(self.c0**2 * (rho - rho0))
        return np.asarray(rho0 * self.c0**2 / 7 * ((rho / rho0) ** 7 - 1))

    def before_walls(self, s: State, p: Array, walls: Walls) -> tuple[Array, Array]:
        """The velocities and, of Adami's, the pressures of fixed wall particles."""
        count = len(s.x) - len(walls.x)
        box = self.problem.box
        shifts = [
            (high - low) * np.array([-1, 0, 1]) if side == "periodic" else np.zeros(1)
            for low, high, side in zip(box.lower, box.upper, box.sides, strict=True)
        ]
        near = np.concatenate([s.x[:count] + np.array(shift) for shift in product(*shifts)])
        who = np.tile(np.arange(count), len(near) // count)
        d = walls.x[:, None] - near[None]
        w = self.w(np.sqrt((d**2).sum(axis=-1)) / self.h)[0]
        velocity, pressure = walls.v.copy(), np.zeros(len(walls.x))
        for k in range(len(walls.x)):
            if self.settings.walls == "adami":
                total = w[k].sum()
                if total > 0:
                    velocity[k] = 2 * walls.v[k] - w[k] @ s.v[who] / total
                    lever = (w[k] * s.rho[who]) @ d[k]
                    pressure[k] = (w[k] @ p[who] + np.array(self.problem.body_force) @ lever) / total
            elif walls.depth[k] > 0:
                # the particle of the first layer before it
                first = walls.x[k] + (walls.depth[k] - 0.5 * self.dx) * walls.normal[k]
                axis = int(np.argmax(np.abs(walls.normal[k])))
                to = near - first
                y = to @ walls.normal[k] - 0.5 * self.dx
                weight = self.mass / s.rho[who] * self.w(np.sqrt((to**2).sum(axis=1)) / self.h)[0]
                inside = weight > 0
                degrees = [1] if self.settings.continuation == "linear" else [1, 2]
                u = s.v[who, 1 - axis] - walls.v[k, 1 - axis]
                found = _fitted(y[inside, None] ** degrees, u[inside], weight[inside])
                velocity[k, 1 - axis] += sum(a * (-walls.depth[k]) ** (n + 1) for n, a in enumerate(found))
        return velocity, pressure

    def rates(self, s: State) -> Rates:
        """The right-hand sides, (8) or (9), (10), (14)."""
        settings, problem = self.settings, self.problem
        walls = self.walls()
        total = len(s.x)
        count = total - len(walls.x)
        entries = self.extended(s)
        at, source = entries.at, entries.source
        d, r, w, kernel_gradient, curvature = self.pairs(at, total)
        rho = s.rho
        if settings.density == "summation":
            rho = (self.mass * ~entries.on_wall * w).sum(axis=1)  # (11)
        p = self.pressure(rho, s.e)
        if len(walls.x):
            velocity, pressure = self.before_walls(replace(s, rho=rho), p, walls)
            s = replace(s, v=np.concatenate((s.v[:count], velocity)))
            if settings.walls == "adami":
                p = np.concatenate((p[:count], pressure))
                if settings.density == "continuity":
                    present = np.where(pressure == 0, settings.initial_pressure, pressure)  # beyond the fluid's reach
                    of_gas = present / ((GAMMA - 1) * self.energy_at_rest)
                    of_walls = of_gas if self.gas else problem.density + pressure / self.c0**2
                    rho = np.concatenate((rho[:count], of_walls))
            entries = self.extended(s)
        u = entries.u
        rho_e, p_e = rho[source], p[source]
        volume = self.mass / rho_e
        gradient = self.corrected(volume, w, kernel_gradient, at)

        # pressure, the particle itself included
        neighbours = (r > 0) & (r < 2 * self.h)
        minus = np.zeros(total)
        if settings.pressure_reduction == "mean":
            minus = (neighbours * p_e).sum(axis=1) / neighbours.sum(axis=1)
        elif settings.pressure_reduction == "hydrostatic" and self.gas:
            minus[:] = settings.initial_pressure
        of_own, of_other = (p - minus)[:, None], p_e - minus[:, None]
        squares = settings.density == "summation"
        rho_i = rho[:, None]
        stress = of_own / rho_i**2 + of_other / rho_e**2 if squares else (of_own + of_other) / (rho_i * rho_e)
        result = -(self.mass * stress[..., None] * gradient).sum(axis=1)
        result += self.viscous(entries, d, r, w, kernel_gradient, gradient, curvature, rho)
        result += np.array(problem.body_force)

        du = s.v[:, None] - u[None]
        work = p[:, None] / rho_i**2 + p_e / rho_e**2 if squares else (p[:, None] + p_e) / (rho_i * rho_e)
        closing = (du * gradient).sum(axis=-1)
        d_rho = (self.mass * closing).sum(axis=1)
        d_e = 0.5 * (self.mass * work * closing).sum(axis=1)
        inverse2 = 1 / np.where(r > 0, r, 1) ** 2
        spread = 2 * volume * (rho_i - rho_e) * (d * kernel_gradient).sum(axis=-1) * inverse2
        d_rho += settings.density_diffusion * self.h * self.c0 * spread.sum(axis=1)
        drift = np.zeros((total, 2))
        if settings.transport == "shifting":
            at_spacing = self.w(np.array(self.dx / self.h))[0]
            uneven = (volume * (1 + 0.2 * (w / at_spacing) ** 4))[..., None] * kernel_gradient
            drift = -2 * self.h * problem.speed * settings.shifting_strength * uneven.sum(axis=1)
            size = np.sqrt((drift**2).sum(axis=1))
            drift[size > problem.speed / 2] *= (problem.speed / 2 / size[size > problem.speed / 2])[:, None]
            grad_u = -np.einsum("e,iek,iea->ika", volume, du, gradient)
            grad_rho = np.einsum("e,ie,iea->ia", volume, rho_e - rho_i, gradient)
            result += np.einsum("ia,ika->ik", drift, grad_u)
            d_rho += (drift * grad_rho).sum(axis=1)
        elif settings.transport == "transport_velocity":
            squared = (self.mass / rho_i) ** 2 + volume**2
            impulse = 0.5 * self.time_step * settings.background_pressure * problem.density * self.c0**2
            drift = -impulse / self.mass * (squared[..., None] * kernel_gradient).sum(axis=1)
            carried = np.einsum("i,ik,ia->ika", rho, s.v, s.w)[:, None]
            carried = 0.5 * (carried + np.einsum("e,ek,ea->eka", rho_e, u, entries.w)[None])
            result += np.einsum("ie,ieka,iea->ik", squared, carried, kernel_gradient) / self.mass
        drift[count:] = 0.0
        if settings.density == "summation" or settings.walls == "adami":
            d_rho[count:] = 0.0
        d_e[count:] = 0.0
        return Rates(
            result[:count],
            d_rho if settings.density == "continuity" else np.zeros(total),
            d_e if self.gas else np.zeros(total),
            drift,
            rho,
            p,
        )

    def viscous(
        self, entries: Entries, d: Array, r: Array, w: Array, kernel_gradient: Array, gradient: Array,
        curvature: Array, rho: Array,
    ) -> Array:  # fmt: skip
        """(1/rho) div tau."""
        name, mass = self.settings.viscosity, self.mass
        mu = self.problem.density * self.problem.kinematic_viscosity
        u, rho_j, rho_i = entries.u, rho[entries.source], rho[:, None]
        volume = mass / rho_j
        apart = r > 0
        inverse = 1 / np.where(apart, r, 1)
        du = u[: len(r), None] - u[None]
        if name in ("morris", "oger"):  # (35)
            if name == "oger":  # with a renormalised gradient
                moments = np.einsum("e,iea,ieb->iab", volume, kernel_gradient, -d)
                gradient = np.einsum("iab,ieb->iea", np.linalg.inv(moments), kernel_gradient)
            factor = mass * 2 * mu / (rho_i * rho_j) * (d * gradient).sum(axis=-1) * inverse**2
            return np.asarray((factor[..., None] * du).sum(axis=1))
        if name in ("violeau", "cleary", "cleary_4.24"):
            if name == "violeau":  # (33)
                factor = 8 * mass / (rho_i + rho_j) * (mu / rho_i + mu / rho_j)
            else:  # (34)
                xi = 4.0 if name == "cleary" else 4.24
                factor = xi * mass / (rho_i * rho_j) * 4 * mu * mu / (mu + mu)
            factor = factor * (du * d).sum(axis=-1) / (r**2 + (0.1 * self.h) ** 2)
            return np.asarray((factor[..., None] * gradient).sum(axis=1))
        if name == "least_squares":  # the parabola through u_i
            result = np.zeros((len(r), 2))
            for i in range(len(r)):
                near = apart[i] & (w[i] > 0)
                x = -d[i, near] / self.h
                basis = np.stack((x[:, 0], x[:, 1], x[:, 0] ** 2, x[:, 0] * x[:, 1], x[:, 1] ** 2), axis=1)
                found = _fitted(basis, -du[i, near], (volume * w[i])[near])
                result[i] = mu / rho[i] * 2 * (found[2] + found[4]) / self.h**2
            return result
        if name == "takeda":  # (6) with (28), and (23) where corrected
            along = d * inverse[..., None]
            direct = along[..., :, None] * along[..., None, :]
            slope = (kernel_gradient * along).sum(axis=-1) * inverse
            hessian = curvature[..., None, None] * np.where(apart[..., None, None], direct, np.eye(2))
            hessian = hessian + slope[..., None, None] * (np.eye(2) - direct)
            if self.settings.correction == "none":
                second = np.einsum("e,ek,ieab->ikab", volume, u, hessian)  # (27)
            else:
                second = self._second_derivatives(volume, u, w, kernel_gradient, hessian)
            laplacian = np.einsum("ikaa->ik", second)
            return np.asarray(mu / rho_i * (laplacian + np.einsum("ibab->ia", second) / 3))
        # (5), (29): the stress of all that can be a neighbour, then its divergence
        near = np.flatnonzero((r < 2 * self.h).any(axis=0))
        to = entries.at[near, None] - entries.at[None]
        away = np.sqrt((to**2).sum(axis=-1))
        value, slope, _ = self.w(away / self.h)
        gradients = (slope / np.where(away > 0, away, 1))[..., None] * to
        gradients = self.corrected(volume, value, gradients, entries.at)
        grad_u = np.einsum("e,ek,iea->ika", volume, u, gradients)
        trace = np.einsum("iaa->i", grad_u)[:, None, None]
        tau = mu * (grad_u + grad_u.swapaxes(1, 2) - 2 / 3 * trace * np.eye(2))
        return np.asarray(np.einsum("e,eab,ieb->ia", volume[near], tau, gradient[:, near]) / rho_i)

    def _second_derivatives(self, volume: Array, u: Array, w: Array, gradient: Array, hessian: Array) -> Array:
        """(23)."""
        one = np.einsum("e,ie->i", volume, w)[:, None, None, None]
        d_one = np.einsum("e,iea->ia", volume, gradient)
        dd_one = np.einsum("e,ieab->iab", volume, hessian)
        f = np.einsum("e,ek,ie->ik", volume, u, w)
        df = np.einsum("e,ek,iea->ika", volume, u, gradient)
        ddf = np.einsum("e,ek,ieab->ikab", volume, u, hessian)
        mixed = np.einsum("ika,ib->ikab", df, d_one)
        numerator = ddf * one - mixed - mixed.swapaxes(2, 3) - np.einsum("ik,iab->ikab", f, dd_one)
        return np.asarray(numerator / one**2 + 2 * np.einsum("ik,ia,ib->ikab", f, d_one, d_one) / one**3)

    # time

    @property
    def time_step(self) -> float:
        assert self.settings.time_step is not None
        return self.settings.time_step

    def start(self, x: Array, v: Array, rho: Array, e: Array) -> State:
        """The fluid, with walls at rest behind it."""
        walls = self.walls()
        many = len(walls.x)
        return State(
            np.concatenate((x, walls.x)),
            np.concatenate((v, walls.v)),
            np.concatenate((rho, np.full(many, self.problem.density))),
            np.concatenate((e, np.full(many, self.energy_at_rest))),
            np.zeros((len(x) + many, 2)),
        )

    def inside(self, s: State) -> State:
        """Back over periodic sides."""
        x = s.x.copy()
        for axis, side in enumerate(self.problem.box.sides):
            low, high = self.problem.box.lower[axis], self.problem.box.upper[axis]
            if side == "periodic":
                x[:, axis] = low + (x[:, axis] - low) % (high - low)
        return replace(s, x=x)

    def advance(self, s: State, steps: int) -> tuple[State, Rates]:
        """The state after so many steps, and the last evaluation."""
        dt = self.time_step
        count = len(self.problem.positions)
        if self.settings.integrator == "midpoint":
            for _ in range(steps):
                first = self.rates(s)
                half = s.moved(dt / 2, s.v[:count] + first.w[:count], first.v, first.rho, first.e)
                last = self.rates(replace(half, w=first.w))
                s = s.moved(dt, half.v[:count] + last.w[:count], last.v, last.rho, last.e)
                s = self.inside(replace(s, w=last.w))
            return s, last
        last = self.rates(s)
        for _ in range(steps):
            before = last
            s = replace(s, w=before.w)
            s = s.moved(dt, s.v[:count] + dt / 2 * before.v + before.w[:count], before.v, before.rho, before.e)
            s = self.inside(s)
            last = self.rates(s)
            nothing = np.zeros_like(before.v)
            s = s.moved(dt / 2, nothing, last.v - before.v, last.rho - before.rho, last.e - before.e)
        return replace(s, w=last.w), last


def _fitted(basis: Array, values: Array, weight: Array) -> Array:
    """Weighted least squares."""
    root = np.sqrt(weight)[:, None]
    columns = values if values.ndim > 1 else values[:, None]
    found = np.linalg.lstsq(root * basis, root * columns)[0]
    return np.asarray(found if values.ndim > 1 else found[:, 0])
