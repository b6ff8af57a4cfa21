"""The preconditioner of the equation of velocity and pressure: nearly the inverse of each block."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from sphear.pressure import Grid

if TYPE_CHECKING:
    from sphear.schemes.incompressible.coupled_step import CoupledStep

Array = np.ndarray[Any, Any]

SWEEPS = 2  # that improve on the inverse of the velocity's equation


class BlockPreconditioner:
    """Nearly solves the equation of a step, block by block.

    For the velocity it takes a Laplacian with Dirichlet walls, for the pressure

        -rho (lap^-1 / dt - s nu (1 - tau / dt))    (Cahouet & Chabard 1988)

    Args:
        of: the equation.
    """

    def __init__(self, of: CoupledStep) -> None:
        self.of, self.viscosity = of, of.solver.viscosity
        self.inverse = of.solver.pressures.preconditioner.build(of.equation.system)
        self.velocity_inverse = self._velocity_inverse()

    def __call__(self, z: Array) -> Array:
        """Nearly the solution of the equations for a right-hand side, as speeds."""
        of, equation = self.of, self.of.equation
        shape = of.step.velocities.shape
        size, order = shape[0] * shape[1], equation.order
        w = z[:size].reshape(shape) / of.kept
        if self.velocity_inverse is not None:
            inner = np.empty_like(w)
            for component in range(shape[1]):
                inner[order, component] = self.velocity_inverse(np.ascontiguousarray(w[order, component]))
            w = inner
        off = z[size:] / of.h
        if of.kept < 1.0:
            moved = of.operators.divergence(of.operators.divergent(w) - of.still)
            off[: shape[0]] -= (1.0 - of.kept) * moved[order]
        if equation.system.singular:
            off -= off.mean()
        viscous_part = of.step.share * self.viscosity * (1.0 - of.kept) * off
        viscous_part[shape[0] :] = 0.0
        p = of.density * (viscous_part - self.inverse(off) / of.step.length)
        return np.concatenate((w.ravel(), p / of.unit))

    def _velocity_inverse(self) -> Callable[[Array], Array] | None:
        """Nearly the inverse of w - s dt nu lap w, on one component, in the order of cells; None without viscosity."""
        factor = self.of.step.share * self.of.step.length * self.viscosity
        if not factor:
            return None
        of = self.of
        system = of.solver.pressures.assembly.velocity_system(
            of.operators.particles, of.operators.interpolation, 1.0 / factor
        )
        inverse = Grid().build(system)

        def apply(vector: Array) -> Array:
            result: Array = inverse(vector) / -factor
            for _ in range(SWEEPS):
                result = result + inverse(vector + factor * system.rows.times(result)) / -factor
            return result

        return apply
