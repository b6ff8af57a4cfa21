"""Another program for incompressible flows: plain NumPy over all pairs and dense solves, from the equations in 2-D."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from typing import Any, NamedTuple

import numpy as np

from sphear.boundaries.shapes import Dummies
from sphear.schemes.incompressible.settings import Incompressible
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]


class Pairs(NamedTuple):
    """From each of N places to each of E particles or images: which one, r_i - r_e, and W, W'/r and W'' there."""

    source: Array
    d: Array
    r: Array
    w: Array
    g: Array
    c: Array


def kernel(name: str, r: Array, radius: float) -> tuple[Array, Array, Array]:
    """W, W'/r and W'' in the plane; W'/r and W'' are zero for a particle itself."""
    h, inside = 0.5 * radius, r < radius
    q = np.where(inside, r, radius) / h
    apart = np.where(q > 0, q, 1.0)
    if name == "cubic_spline":
        sigma = 10.0 / (7.0 * np.pi * h**2)
        w = np.where(q < 1, 1.0 - 1.5 * q**2 + 0.75 * q**3, 0.25 * (2.0 - q) ** 3)
        slope = np.where(q < 1, -3.0 * q + 2.25 * q**2, -0.75 * (2.0 - q) ** 2)
        curvature = np.where(q < 1, -3.0 + 4.5 * q, 1.5 * (2.0 - q))
    else:
        sigma, far = 7.0 / (4.0 * np.pi * h**2), 1.0 - 0.5 * q
        w, slope, curvature = far**4 * (1.0 + 2.0 * q), -5.0 * q * far**3, -5.0 * far**2 * (1.0 - 2.0 * q)
    away = q > 0
    return sigma * w, np.where(away, sigma * slope / apart, 0.0) / h**2, np.where(away, sigma * curvature, 0.0) / h**2


class Plain:
    """A flow; numbers that the settings leave open are given.

    Args:
        problem: what is computed.
        settings: how.
        wall: the wall particles; those on the wall come first.
        time_step, alpha: numbers.
    """

    def __init__(
        self, problem: Problem, settings: Incompressible, wall: Dummies | None, time_step: float, alpha: float
    ) -> None:
        assert settings.h_over_dx is not None
        self.problem, self.settings, self.dt, self.alpha = problem, settings, time_step, alpha
        self.dx, self.radius = problem.spacing, 2.0 * settings.h_over_dx * problem.spacing
        self.volume = self.dx**2
        nothing = np.zeros((0, 2))
        self.wall = Dummies(nothing, np.zeros(0), nothing, nothing) if wall is None else wall
        self.on = int((self.wall.depths == 0).sum()) if settings.walls == "sfdi" else 0
        self.feet = self.wall.positions + self.wall.depths[:, None] * self.wall.normals
        self.x, self.u = problem.positions, problem.velocities
        self.p = np.zeros(len(self.x))

    # sums

    def pairs(self, places: Array, others: Array, radius: float) -> Pairs:
        box = self.problem.box
        periods = [
            (high - low) * np.arange(-2, 3) if side == "periodic" else np.zeros(1)
            for low, high, side in zip(box.lower, box.upper, box.sides, strict=True)
        ]
        shifts = np.array(list(product(*periods)))
        at = (others[None] + shifts[:, None]).reshape(-1, 2)
        d = places[:, None] - at[None]
        r = np.sqrt((d**2).sum(axis=-1))
        return Pairs(np.tile(np.arange(len(others)), len(shifts)), d, r, *kernel(str(self.settings.kernel), r, radius))

    def around(self, x: Array) -> Pairs:
        """From the fluid to itself and the walls; particles on walls have a pressure only, and count for nothing."""
        found = self.pairs(x, np.concatenate((x, self.wall.positions)), self.radius)
        counts = (found.source < len(x)) | (found.source >= len(x) + self.on)
        return found._replace(w=found.w * counts, g=found.g * counts, c=found.c * counts)

    def gathered(self, weights: Array, pairs: Pairs, count: int) -> Array:
        """Weights of entries (N, E), added up for each particle (N, count)."""
        total = np.zeros((len(weights), count))
        np.add.at(total.T, pairs.source, weights.T)
        return total

    def gamma(self, pairs: Pairs) -> Array:
        """The inverse of sum V grad W (x) (r_j - r_i)."""
        return np.linalg.inv(-self.volume * np.einsum("ie,iea,ieb->iab", pairs.g, pairs.d, pairs.d))

    def differences(self, pairs: Pairs, fields: Array) -> Array:
        """sum_j V (f_j - f_i) (x) grad W, (N, k, 2), by the correction chosen."""
        gradient = pairs.g[..., None] * pairs.d
        if self.settings.gradient_correction == "renormalised":
            gradient = np.einsum("iab,ieb->iea", self.gamma(pairs), gradient)
        count = len(pairs.d)
        return np.asarray(
            self.volume * np.einsum("iek,iea->ika", fields[pairs.source][None] - fields[:count, None], gradient)
        )

    def laplacian(self, name: str, pairs: Pairs) -> Array:
        """V w_ij of lap f_i = sum_j V w_ij (f_j - f_i), (N, E)."""
        g, d = pairs.g, pairs.d
        r2 = np.where(pairs.r > 0, pairs.r, 1.0) ** 2
        if name == "morris":
            weight = -2.0 * g
        elif name == "gotoh":
            weight = 0.5 * (pairs.c - g)
        elif name == "oger":
            weight = -2.0 * g * np.einsum("iea,iab,ieb->ie", d, self.gamma(pairs), d) / r2
        else:  # schwaiger
            hessian = self.volume * np.einsum("ie,iea,ieb->iab", g, d, d)
            total = self.volume * np.einsum("ie,iea->ia", g, d)
            trace = np.trace(np.linalg.inv(hessian), axis1=1, axis2=2)[:, None] / 2.0  # of H, which tends to -1
            first = np.einsum("iab,ieb,ia->ie", self.gamma(pairs), g[..., None] * d, total)
            weight = trace * (2.0 * g + 2.0 * first)
        return np.asarray(self.volume * weight)

    # walls

    def mirrored(self, x: Array) -> Array:
        """What the fluid says of each wall particle, (W, N)."""
        if self.settings.walls == "adami":
            pairs = self.pairs(self.wall.positions, x, self.radius)
            weights = self.gathered(pairs.w, pairs, len(x))
            total = weights.sum(axis=1, keepdims=True)
            some = total * self.volume > 1e-9  # else a particle is just within the support
            return np.where(some, weights / np.where(some, total, 1.0), 0.0)
        pairs = self.pairs(self.feet + self.wall.depths[:, None] * self.wall.normals, x, 3.0 * self.dx)
        basis = np.concatenate((np.ones((*pairs.r.shape, 1)), -pairs.d / self.dx), axis=2)
        normal = np.einsum("ie,iea,ieb->iab", pairs.w, basis, basis)
        value = np.linalg.inv(normal)[:, 0]
        return self.gathered(pairs.w * np.einsum("ia,iea->ie", value, basis), pairs, len(x))

    def continued(self, x: Array, u: Array) -> Array:
        """Velocities as the viscous term sees them."""
        wall = self.wall
        if self.settings.continuation == "mirror":
            behind = 2.0 * wall.velocities - self.mirrored(x) @ u
            behind[: self.on] = wall.velocities[: self.on]
            return np.concatenate((u, behind))
        pairs = self.pairs(self.feet, x, 3.5 * self.dx)
        distance = self.distance(x)[pairs.source][None] / self.dx + 0.0 * pairs.r
        along = np.einsum("iea,ia->ie", pairs.d, np.stack((wall.normals[:, 1], -wall.normals[:, 0]), axis=1)) / self.dx
        basis = np.stack((distance, distance**2, distance * along), axis=2)
        depth = -wall.depths / self.dx
        at = np.stack((depth, depth**2, 0.0 * depth), axis=1)
        if self.settings.continuation == "linear":
            basis, at = basis[..., :1], at[:, :1]
        normal = np.einsum("ie,iea,ieb->iab", pairs.w, basis, basis)
        solved = np.linalg.solve(normal, at[..., None])[..., 0]
        rows = self.gathered(pairs.w * np.einsum("ia,iea->ie", solved, basis), pairs, len(x))
        return np.concatenate((u, wall.velocities + rows @ u - rows.sum(axis=1)[:, None] * wall.velocities))

    def distance(self, x: Array) -> Array:
        box = self.problem.box
        gaps = [np.minimum(x[:, a] - box.lower[a], box.upper[a] - x[:, a]) for a in box.wall_axes]
        return np.asarray(np.min(gaps, axis=0))

    def slipping(self, x: Array, u: Array) -> Array:
        """Velocities that slip along walls."""
        behind = self.mirrored(x) @ u
        for k, (normal, velocity) in enumerate(zip(self.wall.normals, self.wall.velocities, strict=True)):
            behind[k] -= (1.0 if k < self.on else 2.0) * np.dot(behind[k] - velocity, normal) * normal
        return np.concatenate((u, behind))

    # a step

    def viscous(self, x: Array, u: Array) -> Array:
        pairs = self.around(x)
        around = self.continued(x, u) if len(self.wall.positions) else u
        weights = self.laplacian(str(self.settings.viscosity), pairs)
        difference = around[pairs.source][None] - u[:, None]
        return np.asarray(self.problem.kinematic_viscosity * np.einsum("ie,iek->ik", weights, difference))

    def accelerations(self) -> Iterator[Array]:
        """That by viscosity and body force; of an implicit step again and again, from the last one's velocities."""
        force, here = np.array(self.problem.body_force), self.viscous(self.x, self.u)
        yield np.asarray(here + force)
        if self.settings.viscous_step != "explicit":  # by backward Euler, as the first steps of either kind are
            for _ in range(40):  # contracts, because the time step is small
                yield self.viscous(self.x, self.after) + force

    def crowding(self, pairs: Pairs) -> Array:
        """The concentration over that of a lattice, minus 1."""
        ticks = np.arange(-4, 5) * self.dx
        lattice = np.hypot(*np.meshgrid(ticks, ticks))
        found = np.asarray(pairs.w.sum(axis=1) / kernel(str(self.settings.kernel), lattice, self.radius)[0].sum() - 1.0)
        return found - found.mean() if self.on else found  # rows of particles on walls have none

    def pressure(self, x: Array, pairs: Pairs, source: Array, accelerations: Array) -> Array:
        """Of the fluid and the walls."""
        count, density, wall_model = len(x), self.problem.density, self.settings.walls
        walls, on = self.wall, self.on
        weights = self.gathered(
            self.laplacian(str(self.settings.laplacian), pairs), pairs, count + len(walls.positions)
        )
        unknowns = count + on
        slope = density * (accelerations * walls.normals).sum(axis=1)
        if on:
            gaps = ((self.feet[:, None] - walls.positions[None, :on]) ** 2).sum(axis=-1)
            behind = np.zeros((len(slope), unknowns))
            nearest = gaps < gaps.min(axis=1, keepdims=True) + 1e-9
            behind[:, count:] = nearest / nearest.sum(axis=1, keepdims=True)
            jump = -walls.depths * slope
        else:
            behind = self.mirrored(x)
            jump = -2.0 * walls.depths * slope
            if wall_model == "adami":  # from the middle of the fluid that the value is of
                way = x[None] - walls.positions[:, None]
                for axis, side in enumerate(self.problem.box.sides):
                    if side == "periodic":
                        period = self.problem.box.upper[axis] - self.problem.box.lower[axis]
                        way[..., axis] -= period * np.rint(way[..., axis] / period)
                jump = -density * np.einsum("we,wea,wa->w", behind, way, accelerations)
        if wall_model == "natural":
            weights[:, count:], jump = 0.0, np.zeros(len(slope))
        weights[:, count:][:, ~behind.any(axis=1)] = 0.0
        np.fill_diagonal(weights, 0.0)
        matrix = np.zeros((unknowns, unknowns))
        matrix[:count] = np.pad(weights[:, :count], ((0, 0), (0, on))) + weights[:, count:] @ behind
        matrix[np.arange(count), np.arange(count)] -= weights.sum(axis=1)
        right = np.zeros(unknowns)
        right[:count] = source - weights[:, count:] @ jump
        if on:
            around = self.pairs(walls.positions[:on], np.concatenate((x, walls.positions[:on])), 3.0 * self.dx)
            closeness = np.where(around.r > 0, around.w, 0.0) / np.where(around.r > 0, around.r, 1.0) ** 2
            moment = np.einsum("ie,iea,ieb->iab", closeness, around.d, around.d)
            solved = np.linalg.solve(moment, walls.normals[:on, :, None])[..., 0]
            rows = self.gathered(-closeness * np.einsum("ia,iea->ie", solved, around.d), around, unknowns)
            matrix[count:] = rows / self.dx
            matrix[np.arange(count, unknowns), np.arange(count, unknowns)] -= rows.sum(axis=1) / self.dx
            right[count:] = slope[:on] / self.dx
        bordered = np.block([[matrix, np.ones((unknowns, 1))], [np.ones((1, unknowns)), np.zeros((1, 1))]])
        found = np.linalg.solve(bordered, np.append(right, 0.0))[:unknowns]
        self.p = found[:count]
        return np.concatenate((self.p, behind @ found[: behind.shape[1]] + jump))

    def shift(self, pairs: Pairs) -> Array:
        """By how much particles are moved beside the flow."""
        settings, speed = self.settings, self.problem.speed
        if settings.shifting == "lind":
            at_dx = kernel(str(settings.kernel), np.array(self.dx), self.radius)[0]
            factor = self.volume * (1.0 + 0.2 * (pairs.w / at_dx) ** 4) * pairs.g
            drift = -self.radius * speed * settings.shifting_strength * np.einsum("ie,iea->ia", factor, pairs.d)
        else:  # xu
            near = (pairs.r > 0) & (pairs.r < self.radius)
            mean = (pairs.r * near).sum(axis=1) / near.sum(axis=1)
            factor = np.where(near, 1.0 / np.where(near, pairs.r, 1.0) ** 3, 0.0)
            drift = 0.04 * settings.shifting_strength * speed * np.einsum("i,ie,iea->ia", mean**2, factor, pairs.d)
        size = np.linalg.norm(drift, axis=1, keepdims=True)
        return np.asarray(self.dt * drift * np.minimum(1.0, 0.5 * speed / np.maximum(size, 1e-300)))

    def step(self) -> None:
        settings, dt, u = self.settings, self.dt, self.u
        walled = len(self.wall.positions) > 0
        midpoint = settings.projection == "midpoint"
        if midpoint:
            self.x = self.x + 0.5 * dt * u
        for acceleration in self.accelerations():
            self.project(acceleration)
        after, x, pairs = self.after, self.projected_at, self.around(self.projected_at)
        x_after = self.x + 0.5 * dt * (after if midpoint else u + after)
        if settings.shifting != "none":
            slopes = self.differences(pairs, self.slipping(x, after) if walled else after)
            stretching = np.sqrt(np.maximum(0.5 * np.einsum("iab,iba->i", slopes, slopes), 0.0))
            uneven = np.random.default_rng(settings.seed).uniform(-1.0, 1.0, x.shape)
            shift = self.shift(pairs) + 0.02 * self.dx * dt * stretching[:, None] * uneven
            after = after + np.einsum("ika,ia->ik", slopes, shift)
            x_after = x_after + shift
        self.x, self.u = x_after, after

    def project(self, acceleration: Array) -> None:
        """Free velocities of divergence, under the acceleration of a step."""
        settings, dt, density, u = self.settings, self.dt, self.problem.density, self.u
        count, walled = len(u), len(self.wall.positions) > 0
        implicit = settings.viscous_step != "explicit"
        predicted = u + dt * acceleration
        x = self.x + dt * predicted if settings.projection == "intermediate" and not implicit else self.x
        self.projected_at = x
        pairs = self.around(x)
        even = np.concatenate((acceleration, self.mirrored(x) @ acceleration)) if walled else acceleration
        seen = self.slipping if self.settings.wall_divergence == "slipping" else self.continued  # by the divergence
        around = (seen(x, u) if walled else u) + dt * even
        slopes = self.differences(pairs, around)
        divergence = np.einsum("ikk->i", slopes)
        if implicit:
            slopes = self.differences(pairs, seen(x, u) if walled else u)
        if settings.projection == "midpoint":  # of the velocities where particles are half a step later
            divergence = divergence - 0.5 * dt * np.einsum("iab,iba->i", slopes, slopes)
        source = (
            1.0 if implicit else 1.0 - self.alpha
        ) * density / dt * divergence - self.alpha * density / dt**2 * self.crowding(pairs)
        pressures = self.pressure(x, pairs, source, even[count:])
        if settings.gradient == "symmetric":
            both = pressures[pairs.source][None] + pressures[:count, None]
            slope = self.volume * np.einsum("ie,iea->ia", both * pairs.g, pairs.d)
        else:
            slope = self.differences(pairs, pressures[:, None])[:, 0]
        self.after = predicted - dt / density * slope
