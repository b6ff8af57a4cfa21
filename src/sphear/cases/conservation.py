"""Conservation by a viscous term, measured: linear momentum, angular momentum, and the sign of its dissipation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from sphear.cases.lattice import lattice
from sphear.corrections import Correction, NoCorrection
from sphear.operators import Particles
from sphear.viscosity import ViscousTerm

Array = np.ndarray[Any, Any]

ROUND_OFF = 1e-10


@dataclass(frozen=True)
class Conservation:
    """Relative changes, over isolated clusters of jittered particles with random velocities.

    Attributes:
        linear_momentum: |sum_i m a_i| / sum_i |m a_i|, the largest.
        angular_momentum: |sum_i m r_i x a_i| / sum_i |m r_i| |a_i|, the largest.
        energy: sum_i m u_i . a_i / sum_i |m u_i . a_i|, the largest; a term that only dissipates never has it
            positive.
    """

    linear_momentum: float
    angular_momentum: float
    energy: float

    def kept(self) -> dict[str, bool]:
        """Each property, true if it holds to rounding."""
        return {
            "linear_momentum": self.linear_momentum < ROUND_OFF,
            "angular_momentum": self.angular_momentum < ROUND_OFF,
            "dissipative": self.energy < ROUND_OFF,
        }


def conservation(
    term: ViscousTerm, correction: Correction | None = None, *, size: int = 8, seeds: int = 3, trials: int = 20
) -> Conservation:
    """Measure a term in two dimensions.

    The energy of random velocities alone would rarely find the few that gain; so for a term that is linear in the
    velocity, its matrix is formed too, and the velocity that gains most is taken from the eigenvectors of its
    symmetric part.

    Args:
        term: any viscous term.
        correction: default none.
        size: particles a side of the cluster, less one.
        seeds: clusters.
        trials: velocities a cluster.
    """
    chosen = correction or NoCorrection()
    worst = np.full(3, -np.inf)
    for seed in range(seeds):
        grid = lattice(size, 2, jitter=0.5, seed=seed)
        # every particle of the cluster needs neighbours enough, at its corners too
        particles = Particles.read(grid.positions, spacing=grid.spacing, h_over_dx=2.2, volumes=grid.volume, threads=1)
        ones = np.ones(len(grid.positions))

        def acceleration(u: Array, particles: Particles = particles, ones: Array = ones) -> Array:
            return particles.viscous_acceleration(u, ones, ones, term, chosen)

        random = np.random.default_rng(seed)
        velocities: list[Array] = [random.standard_normal((len(grid.positions), 2)) for _ in range(trials)]
        if is_linear(acceleration, velocities[0], velocities[1]):
            velocities.append(_most_gaining(acceleration, grid.positions.shape))
        for u in velocities:
            worst = np.maximum(worst, _changes(grid.positions, u, acceleration(u)))
    return Conservation(*(float(x) for x in worst))


def is_linear(acceleration: Any, u: Array, v: Array) -> bool:
    """True if a(u + v) = a(u) + a(v) to rounding."""
    together, apart = acceleration(u + v), acceleration(u) + acceleration(v)
    return bool(np.abs(together - apart).max() < ROUND_OFF * np.abs(together).max())


def _changes(positions: Array, u: Array, a: Array) -> tuple[float, float, float]:
    r = positions - positions.mean(axis=0)
    torque = r[:, 0] * a[:, 1] - r[:, 1] * a[:, 0]
    power = (u * a).sum(axis=1)
    size = np.linalg.norm(a, axis=1)
    return (
        float(np.linalg.norm(a.sum(axis=0)) / size.sum()),
        float(abs(torque.sum()) / (np.linalg.norm(r, axis=1) * size).sum()),
        float(power.sum() / np.abs(power).sum()),
    )


def _most_gaining(acceleration: Any, shape: tuple[int, ...]) -> Array:
    count = int(np.prod(shape))
    matrix = np.stack([acceleration(unit.reshape(shape)).ravel() for unit in np.eye(count)], axis=1)
    _, vectors = np.linalg.eigh(matrix + matrix.T)
    return np.asarray(vectors[:, -1].reshape(shape))
