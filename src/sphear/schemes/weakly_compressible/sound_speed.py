"""The speed of sound of a weakly compressible flow, and the energy of a gas, at rest."""

from __future__ import annotations

from sphear.equations_of_state import Barotropic, EquationOfState, IdealGas
from sphear.errors import SphearError
from sphear.schemes.problem import Problem, corner_sound_speed, morris_sound_speed
from sphear.schemes.weakly_compressible.settings import WeaklyCompressible


def sound_speed(problem: Problem, settings: WeaklyCompressible) -> float:
    """The speed of sound of the fluid at rest: of its equation of state, as chosen, or as the expected speeds want it.

    Raises:
        SphearError: an equation of state is that of a fluid of another density.
    """
    equation, density = settings.equation_of_state, problem.density
    if isinstance(equation, Barotropic) and equation.rho0 != density:
        raise SphearError(
            f"the equation of state {equation!r} is of another fluid: rho0 must be the density of the flow, {density:g}"
        )
    if settings.gas:
        equation = equation if isinstance(equation, IdealGas) else IdealGas()
    if isinstance(equation, EquationOfState):
        return float(equation.sound_speed(density, energy_at_rest(problem, settings)))
    return settings.sound_speed or max(morris_sound_speed(problem), corner_sound_speed(problem))


def energy_at_rest(problem: Problem, settings: WeaklyCompressible) -> float:
    """The energy of a unit of mass of an ideal gas at rest, at its initial pressure."""
    gas = settings.equation_of_state
    gas = gas if isinstance(gas, IdealGas) else IdealGas()
    return float(gas.energy(problem.density, settings.initial_pressure))
