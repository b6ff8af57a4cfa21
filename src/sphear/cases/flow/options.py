"""The settings of all flows as type checkers know them."""

from __future__ import annotations

from typing import TypedDict

from sphear.boundaries.models import ExplicitWallModel, WallModel
from sphear.corrections import Correction
from sphear.equations_of_state import EquationOfState
from sphear.kernels import Kernel
from sphear.pressure import Preconditioner
from sphear.schemes.weakly_compressible.integrators import Integrator
from sphear.shifting import Lind, ShiftingMethod
from sphear.viscosity import ViscousTerm


class FlowOptions(TypedDict, total=False):
    """The settings of any case by any scheme; `sphear show case NAME` says what each means and what it may be."""

    # of all
    scheme: str
    viscosity: str | ViscousTerm
    correction: str | Correction
    kernel: str | Kernel
    h_over_dx: float | None
    initial: str
    seed: int
    reynolds: float
    resolution: int
    until: float | None
    max_steps: int
    time_step: float | None
    force: bool
    threads: int | None
    continuation: str
    walls: str | WallModel | ExplicitWallModel
    wall_divergence: str
    solid: str
    shifting_strength: float

    # of the explicit scheme
    equation_of_state: str | EquationOfState
    density: str
    momentum: str | None
    pressure_reduction: str
    density_diffusion: float
    diffusion_form: str
    wall_particles: bool
    integrator: str | Integrator
    transport: str | Lind
    background_pressure: float
    sound_speed: float | None
    initial_pressure: float

    # of the incompressible scheme
    gradient: str
    pressure_level: str
    gradient_correction: str | Correction
    laplacian: str | ViscousTerm
    alpha: float | None
    projection: str
    shifting: str | ShiftingMethod
    viscous_step: str
    preconditioner: str | Preconditioner
    tolerance: float

    # of cavity-cylinder
    diameter: float
    centre_x: float
    centre_y: float
    spin: float

    # of dam-break
    column: float
    tank: float
    tank_height: float
