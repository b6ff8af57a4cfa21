"""What can be chosen of a weakly compressible flow."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field


class FlowSettings(BaseModel):
    """The settings of a flow; the defaults are those of Basa, Quinlan & Lastiwka (2009), section 6.

    Attributes:
        viscosity: name of a viscous term.
        correction: name of a consistency correction of the kernel in the pressure and viscous sums. The density sum
            stays as it is: divided by the kernel's own sum, sum_b m_b W_ab / sum_b (m_b / rho_b) W_ab is the mean of
            the neighbours' densities, and would not know how far apart particles are.
        kernel: name of a kernel.
        h_over_dx: smoothing length over particle spacing; None gives a support of 3.14 dx.
        equation_of_state: "batchelor_tait" or "linear".
        pressure_reduction: "mean" subtracts the mean pressure of the neighbours (eq. 20), "none" does not (eq. 8).
        wall_velocity: how mirror particles move along a wall.
        reynolds: as the case defines it.
        resolution: particles across the flow.
        until: when to stop, in the time unit of the case; None where the case says.
        max_steps: stop after so many steps.
        sound_speed: None takes the rule of Morris, Fox & Zhu (1997) for density variations of 1 %.
        time_step: None takes the least of the CFL, viscous and body-force limits.
        force: take a time step beyond its limit all the same.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    viscosity: str = "morris"
    correction: str = "none"
    kernel: str = "cubic_spline"
    h_over_dx: float | None = Field(default=None, gt=0, allow_inf_nan=False)
    equation_of_state: Literal["batchelor_tait", "linear"] = "batchelor_tait"
    pressure_reduction: Literal["mean", "none"] = "mean"
    wall_velocity: str = "linear"
    reynolds: float = Field(default=0.5, gt=0, allow_inf_nan=False)
    resolution: int = Field(default=20, ge=1)
    until: float | None = Field(default=None, gt=0, allow_inf_nan=False)
    max_steps: int = Field(default=500_000, ge=1)
    sound_speed: float | None = Field(default=None, gt=0, allow_inf_nan=False)
    time_step: float | None = Field(default=None, gt=0, allow_inf_nan=False)
    force: bool = False
