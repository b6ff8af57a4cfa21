"""The energy budget of a flow: what viscosity, walls and forces give and take, and what nobody gave."""

from __future__ import annotations

from typing import Any

import numpy as np

Array = np.ndarray[Any, Any]

LEAST_ENERGY = 0.05  # of the energy of the whole fluid at its expected speed: a flow with less has hardly moved yet


def kinetic_energy(mass: float, velocities: Array) -> float:
    """(m / 2) sum_i u_i^2 of particles of one mass and velocities (N, d)."""
    # not by BLAS, whose threads wait for each other: see `sphear.pressure.vectors`
    return 0.5 * mass * float(np.einsum("nd,nd->", velocities, velocities))


def greatest_speed(velocities: Array) -> float:
    """max_i |u_i| of velocities (N, d); 0 of none."""
    return float(np.sqrt((velocities**2).sum(axis=1).max(initial=0.0)))


class EnergyBudget:
    """Kinetic energy and the work that was done on it, summed up over the steps.

    An incompressible flow between walls that it cannot pass changes its kinetic energy by the work of the viscous
    forces, which is what walls give less what is dissipated, and by that of body forces; pressure does none. What is
    left over is the residual:

        R = E(t) - E(0) - W_viscous - W_force

    It falls where the discretisation dissipates, as shifting does, and rises where it makes energy out of nothing.
    Both are measured in parts of the energy that was there and was turned over, max E + integral of sum_i |work of i|,
    or of 5 % of that of the fluid at its expected speed where that is more: while a flow starts, particles settle
    before their walls.

    Args:
        mass: of a particle.
        velocities: (N, d), at the start.
        speed: the largest that is expected.

    Attributes:
        start: E(0), of the whole fluid.
        viscous: W_viscous, positive where walls give more than is dissipated.
        force: W_force.
        turned: the work of viscous and body forces, whatever its sign, of each particle.
        largest: the largest kinetic energy so far.
        least: the least R so far.
    """

    def __init__(self, mass: float, velocities: Array, speed: float) -> None:
        self.mass, self.scale = mass, 0.5 * mass * len(velocities) * speed**2
        self.start = self.largest = self.kinetic(velocities)
        self.viscous = self.force = self.turned = self.least = 0.0

    def kinetic(self, velocities: Array) -> float:
        """E, of velocities (N, d)."""
        return kinetic_energy(self.mass, velocities)

    def add(self, step: float, before: Array, after: Array, viscous: Array, force: Array) -> None:
        """Add the work of a step.

        Args:
            step: its length.
            before, after: (N, d), velocities at its ends.
            viscous, force: (N, d), accelerations.
        """
        from sphear.schemes.work import work  # takes the compiler, which who only asks for speeds does without

        share = 0.5 * step * self.mass
        for name, acceleration in (("viscous", viscous), ("force", force)):
            done, turned = work(before, after, np.atleast_2d(acceleration))
            setattr(self, name, getattr(self, name) + share * done)
            self.turned += share * turned
        kinetic = self.kinetic(after)
        self.largest = max(self.largest, kinetic)
        self.least = min(self.least, self._left(kinetic))

    def _left(self, kinetic: float) -> float:
        return kinetic - self.start - self.viscous - self.force

    def residual(self, velocities: Array) -> float:
        """R of velocities (N, d) over the energy that was there and turned over."""
        return self._share(self._left(self.kinetic(velocities)))

    def created(self, velocities: Array) -> float:
        """The rise of R from its least, likewise: energy that the discretisation made."""
        return self._share(self._left(self.kinetic(velocities)) - self.least)

    def _share(self, energy: float) -> float:
        return energy / max(self.largest + self.turned, LEAST_ENERGY * self.scale)

    def state(self) -> Array:
        """(6,), all that the budget needs to go on."""
        return np.array([self.start, self.viscous, self.force, self.turned, self.largest, self.least])

    def restore(self, state: Array) -> None:
        """Go back to a `state`."""
        self.start, self.viscous, self.force, self.turned, self.largest, self.least = map(float, state)
