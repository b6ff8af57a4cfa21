"""Equations of state: the pressure of compressible and weakly compressible fluids."""

from __future__ import annotations

from sphear.equations_of_state.base import Barotropic, EquationOfState
from sphear.equations_of_state.batchelor_tait import BatchelorTait
from sphear.equations_of_state.ideal_gas import IdealGas
from sphear.equations_of_state.linear import Linear
from sphear.names import Registry

EQUATIONS_OF_STATE: Registry[type[EquationOfState]] = Registry("equation of state")
for _equation in (IdealGas, BatchelorTait, Linear):
    EQUATIONS_OF_STATE.add(_equation.name, _equation, _equation.aliases)
EQUATIONS_OF_STATE.open()

__all__ = ["EQUATIONS_OF_STATE", "Barotropic", "BatchelorTait", "EquationOfState", "IdealGas", "Linear"]
