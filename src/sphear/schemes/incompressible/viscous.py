"""The viscous acceleration of a step, explicit or implicit, by any viscous term."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from sphear.corrections import Correction
from sphear.errors import SphearError
from sphear.kernels import Kernel
from sphear.pressure.krylov import bicgstab
from sphear.pressure.vectors import norm
from sphear.schemes.incompressible.particle_sums import ParticleSums
from sphear.viscosity import ViscousTerm
from sphear.viscosity.base import uncorrected

Array = np.ndarray[Any, Any]

IMPLICIT_SHARE = {"explicit": 0.0, "crank_nicolson": 0.5, "backward_euler": 1.0}
TOLERANCE, MOST = 1e-8, 500  # of the implicit equation
DRIFT = 2.0  # by which its residual may be off, as that of a recursion


class Viscous:
    """nu lap u, or whatever a viscous term makes of it.

    Args:
        term: the viscous term.
        correction: of the kernel.
        kernel: with its smoothing length.
        kinematic_viscosity: nu.
    """

    def __init__(self, term: ViscousTerm, correction: Correction, kernel: Kernel, kinematic_viscosity: float) -> None:
        self.term, self.kinematic_viscosity = term, kinematic_viscosity
        self.stages = term.acceleration_stages(kernel, correction)
        self.preparation = term.preparation(kernel, correction)
        plain, without = uncorrected(term)
        self.plain = plain.acceleration_stages(kernel, without)

    @property
    def of_all(self) -> bool:
        """A sum knows sums of its neighbours, so that wall particles need theirs too."""
        return len(self.stages) > 1

    def acceleration(self, particles: ParticleSums, velocities: Array, count: int, near: Array | None = None) -> Array:
        """The viscous acceleration of the fluid's particles, (N, d).

        Corrections need neighbours on all sides: of particles with too few, and near a free surface, it is the
        acceleration by the term without its correction, or by Morris's. Missing neighbours leave the surface without
        stress there.

        Args:
            particles: the N of the fluid and those of walls; of both as particles where `of_all`.
            velocities: (N + W, d), of the fluid and, continued, behind walls.
            count: N.
            near: (N,), which particles are near a free surface; None without one.
        """
        particles.uniform(density=1.0, dynamic_viscosity=self.kinematic_viscosity)
        fields: dict[str, Array] = {"velocity": velocities}
        lacking = np.empty(0, np.int64)
        if self.preparation is not None:
            lacking = particles.deficient(self.preparation)
            lacking = lacking if near is None else np.union1d(lacking, np.flatnonzero(near))
        for stage, plain in zip(self.stages, self.plain, strict=True):
            result = particles.sum(stage, self.preparation, **fields)
            if len(lacking):
                result[lacking] = particles.sum(plain, None, **fields)[lacking]
            fields["before"] = result
        return fields["before"][:count]

    def implicit(
        self,
        share: float,
        time_step: float,
        velocities: Array,
        body_force: Array,
        acceleration: Callable[[Array], Array],
    ) -> Array:
        """The acceleration of a step whose viscous part is, by `share`, that at its end and for the rest at its start.

        u* - share dt nu lap u* = u + (1 - share) dt nu lap u + dt f, by BiCGSTAB; the operator is the term's own sum.

        Args:
            share: 1/2 is Crank-Nicolson, 1 backward Euler.
            time_step: dt.
            velocities: (N, d), u.
            body_force: (d,) or (N, d), f.
            acceleration: (N, d) of velocities (N, d): affine, because walls have velocities of their own.

        Raises:
            SphearError: the solution did not converge.
        """
        shape, step = velocities.shape, share * time_step
        still = acceleration(np.zeros(shape))
        explicit = acceleration(velocities)
        right = velocities + time_step * ((1.0 - share) * explicit + share * still + body_force)

        def apply(flat: Array) -> Array:
            u = flat.reshape(shape)
            result: Array = (u - step * (acceleration(u) - still)).ravel()
            return result

        length = norm(right.ravel()) or 1.0  # of the methods' right-hand sides, that they can tell what is small
        sought = right.ravel() / length
        run = bicgstab(apply, sought, velocities.ravel() / length, np.copy, TOLERANCE, MOST)
        residual = norm(sought - apply(run.values))
        if not residual <= DRIFT * TOLERANCE:
            raise SphearError(
                f"the implicit viscous step was not solved: after {run.iterations} iterations its relative residual is"
                f" {residual:.2g} where {TOLERANCE:g} is asked for; take a smaller time step"
            )
        result: Array = (length * run.values.reshape(shape) - velocities) / time_step
        return result
