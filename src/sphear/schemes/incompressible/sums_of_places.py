"""The sums of a step that depend on the places of particles alone, which are made in one sweep."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sphear.interactions.concentration import Concentration
from sphear.interactions.free_surface import ConcentrationMoments
from sphear.interactions.sfdi_gradient import SfdiFit

if TYPE_CHECKING:
    from sphear.schemes.incompressible.flow import IncompressibleFlow


def viscosity_elsewhere(flow: IncompressibleFlow) -> bool:
    """True if viscosity acts where particles are at the start of a step, and pressure where they are later."""
    return flow.settings.projection == "intermediate" and flow.coupled is None


def sums_of_places(flow: IncompressibleFlow) -> tuple[Any, ...]:
    """The interactions that a step of a flow asks for at the places where pressure acts."""
    how, kernel, pressures = flow.discretisation, flow.kernel, flow.pressures
    viscous = None if how.viscous.of_all or viscosity_elsewhere(flow) else how.viscous.preparation
    density: Any = None
    if flow.problem.free_surface:
        density = ConcentrationMoments(kernel)
    elif pressures.alpha or flow.coupled is not None:
        density = Concentration(kernel)
    fit = SfdiFit(kernel) if how.pressure_form == "sfdi" else None
    found = (
        viscous,
        how.correction.preparation(kernel),
        pressures.assembly.preparation,
        density,
        fit,
        flow.displacement.drift,
    )
    return tuple(x for x in found if x is not None)
