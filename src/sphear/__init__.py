"""sphear: viscous flow with smoothed particle hydrodynamics.

The best-known viscous terms, exchangeable. The operators work on NumPy arrays of particles:

    laplacian(positions, values, viscosity="morris")
    viscous_acceleration(positions, velocities, viscosity="violeau", dynamic_viscosity=0.01)
    gradient(positions, values, correction="shepard")
    interpolate(positions, values, at=points)

Flows of the cases run from their start to their end:

    flow("cavity", scheme="incompressible", viscosity="oger", reynolds=400).run()

Terms, kernels and corrections of one's own have names too, once they are decorated:

    @viscous_term("mine")
    class Mine(LaplacianTerm): ...

Names are imported when first used, so that importing the package costs nothing; type checkers see them all.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

# isort: off
if TYPE_CHECKING:
    from sphear.boundaries.conditions import FreeSlip as FreeSlip, NoSlip as NoSlip, Periodic as Periodic
    from sphear.boundaries.models import (
        SFDI as SFDI,
        WALL_MODELS as WALL_MODELS,
        AdamiDummies as AdamiDummies,
        ExplicitWallModel as ExplicitWallModel,
        FixedParticles as FixedParticles,
        MirrorParticles as MirrorParticles,
        MirrorPoints as MirrorPoints,
        Natural as Natural,
        WallModel as WallModel,
    )
    from sphear.boundaries.shapes import (
        Circle as Circle,
        HalfPlane as HalfPlane,
        Polygon as Polygon,
        Rectangle as Rectangle,
        Shape as Shape,
    )
    from sphear.cases.flow import CaseRun as CaseRun, flow as flow
    from sphear.cases.measured_card import MeasuredCard as MeasuredCard, measured_card as measured_card
    from sphear.cases.patch_test import PatchTest as PatchTest
    from sphear.corrections import (
        CORRECTIONS as CORRECTIONS,
        BonetLok as BonetLok,
        Correction as Correction,
        NoCorrection as NoCorrection,
        Renormalised as Renormalised,
        Shepard as Shepard,
    )
    from sphear.equations_of_state import (
        EQUATIONS_OF_STATE as EQUATIONS_OF_STATE,
        Barotropic as Barotropic,
        BatchelorTait as BatchelorTait,
        EquationOfState as EquationOfState,
        IdealGas as IdealGas,
        Linear as Linear,
    )
    from sphear.errors import (
        SphearError as SphearError,
        SphearWarning as SphearWarning,
        TooFewNeighboursError as TooFewNeighboursError,
    )
    from sphear.extensions.naming import (
        correction as correction,
        equation_of_state as equation_of_state,
        kernel as kernel,
        viscous_term as viscous_term,
    )
    from sphear.extensions.parts_of_schemes import (
        integrator as integrator,
        preconditioner as preconditioner,
        shifting_method as shifting_method,
        wall_model as wall_model,
    )
    from sphear.kernels import (
        KERNELS as KERNELS,
        CubicSpline as CubicSpline,
        Gaussian as Gaussian,
        Kernel as Kernel,
        QuarticSpline as QuarticSpline,
        QuinticSpline as QuinticSpline,
        WendlandC2 as WendlandC2,
        WendlandC4 as WendlandC4,
        WendlandC6 as WendlandC6,
    )
    from sphear.neighbours import Domain as Domain, Neighbours as Neighbours
    from sphear.operators import (
        Particles as Particles,
        gradient as gradient,
        interpolate as interpolate,
        laplacian as laplacian,
        viscous_acceleration as viscous_acceleration,
    )
    from sphear import algebra as algebra
    from sphear.pressure import (
        PRECONDITIONERS as PRECONDITIONERS,
        AlgebraicMultigrid as AlgebraicMultigrid,
        Grid as Grid,
        Jacobi as Jacobi,
        Preconditioner as Preconditioner,
        PressureSystem as PressureSystem,
    )
    from sphear.schemes.base import FlowFailure as FlowFailure
    from sphear.schemes.incompressible.settings import Incompressible as Incompressible
    from sphear.schemes.weakly_compressible.integrators import (
        INTEGRATORS as INTEGRATORS,
        Integrator as Integrator,
        KickDriftKick as KickDriftKick,
        Midpoint as Midpoint,
    )
    from sphear.schemes.weakly_compressible.settings import WeaklyCompressible as WeaklyCompressible
    from sphear.shifting import (
        SHIFTING as SHIFTING,
        Lind as Lind,
        NoShifting as NoShifting,
        ShiftingMethod as ShiftingMethod,
        Xu as Xu,
    )
    from sphear.simulation.fluid import Fluid as Fluid
    from sphear.simulation.observers import (
        Call as Call,
        History as History,
        Observer as Observer,
        Probe as Probe,
        Profile as Profile,
        Progress as Progress,
        Snapshots as Snapshots,
        StopWhen as StopWhen,
    )
    from sphear.simulation.simulation import Simulation as Simulation
    from sphear.sweeps import Store as Store, run_sweep as run_sweep
    from sphear.sweeps.plan import plan as plan
    from sphear.viscosity import (
        VISCOSITY as VISCOSITY,
        Cleary as Cleary,
        EspanolRevenga as EspanolRevenga,
        FatehiManzari as FatehiManzari,
        Gotoh as Gotoh,
        LaplacianTerm as LaplacianTerm,
        LeastSquares as LeastSquares,
        Monaghan as Monaghan,
        Morris as Morris,
        Oger as Oger,
        Schwaiger as Schwaiger,
        Takeda as Takeda,
        TwoPass as TwoPass,
        Violeau as Violeau,
        ViscousTerm as ViscousTerm,
    )

# isort: on

__version__ = "0.1.0"

_HOMES = {
    "sphear.boundaries.conditions": ("FreeSlip", "NoSlip", "Periodic"),
    "sphear.boundaries.models": (
        "SFDI", "WALL_MODELS", "AdamiDummies", "ExplicitWallModel", "FixedParticles", "MirrorParticles", "MirrorPoints",
        "Natural", "WallModel",
    ),
    "sphear.boundaries.shapes": ("Circle", "HalfPlane", "Polygon", "Rectangle", "Shape"),
    "sphear.cases.flow": ("CaseRun", "flow"),
    "sphear.cases.measured_card": ("MeasuredCard", "measured_card"),
    "sphear.cases.patch_test": ("PatchTest",),
    "sphear.corrections": ("CORRECTIONS", "BonetLok", "Correction", "NoCorrection", "Renormalised", "Shepard"),
    "sphear.equations_of_state": (
        "EQUATIONS_OF_STATE", "Barotropic", "BatchelorTait", "EquationOfState", "IdealGas", "Linear",
    ),
    "sphear.errors": ("SphearError", "SphearWarning", "TooFewNeighboursError"),
    "sphear.extensions.naming": ("correction", "equation_of_state", "kernel", "viscous_term"),
    "sphear.extensions.parts_of_schemes": ("integrator", "preconditioner", "shifting_method", "wall_model"),
    "sphear.kernels": (
        "KERNELS", "CubicSpline", "Gaussian", "Kernel", "QuarticSpline", "QuinticSpline", "WendlandC2",
        "WendlandC4", "WendlandC6",
    ),
    "sphear.neighbours": ("Domain", "Neighbours"),
    "sphear.operators": ("Particles", "gradient", "interpolate", "laplacian", "viscous_acceleration"),
    "sphear.pressure": (
        "PRECONDITIONERS", "AlgebraicMultigrid", "Grid", "Jacobi", "Preconditioner", "PressureSystem",
    ),
    "sphear.schemes.base": ("FlowFailure",),
    "sphear.schemes.incompressible.settings": ("Incompressible",),
    "sphear.schemes.weakly_compressible.integrators": ("INTEGRATORS", "Integrator", "KickDriftKick", "Midpoint"),
    "sphear.schemes.weakly_compressible.settings": ("WeaklyCompressible",),
    "sphear.shifting": ("SHIFTING", "Lind", "NoShifting", "ShiftingMethod", "Xu"),
    "sphear.simulation.fluid": ("Fluid",),
    "sphear.simulation.observers": (
        "Call", "History", "Observer", "Probe", "Profile", "Progress", "Snapshots", "StopWhen",
    ),
    "sphear.simulation.simulation": ("Simulation",),
    "sphear.sweeps": ("Store", "run_sweep"),
    "sphear.sweeps.plan": ("plan",),
    "sphear.viscosity": (
        "VISCOSITY", "Cleary", "EspanolRevenga", "FatehiManzari", "Gotoh", "LaplacianTerm", "LeastSquares",
        "Monaghan", "Morris", "Oger", "Schwaiger", "Takeda", "TwoPass", "ViscousTerm", "Violeau",
    ),
}  # fmt: skip
_HOME = {name: home for home, names in _HOMES.items() for name in names}

_MODULES = ("algebra",)

__all__ = ["__version__", *_HOME, *_MODULES]

if not TYPE_CHECKING:  # to type checkers it would make anything out of every name

    def __getattr__(name: str) -> object:
        if name in _HOME:
            return getattr(import_module(_HOME[name]), name)
        if name in _MODULES:
            return import_module(f"sphear.{name}")
        raise AttributeError(f"module 'sphear' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
