"""The base of all schemes: the settings and the flow in time that a run is made of."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from sphear.errors import SphearError, quoted
from sphear.names import unknown
from sphear.schemes.checks import check_connected, check_places
from sphear.schemes.common import Scheme, missing
from sphear.schemes.incompressible.settings import Incompressible, IncompressibleSettings
from sphear.schemes.weakly_compressible.settings import WeaklyCompressible, WeaklyCompressibleSettings

if TYPE_CHECKING:
    from sphear.kernels import Kernel
    from sphear.schemes.energy import EnergyBudget
    from sphear.schemes.problem import Problem
    from sphear.viscosity import ViscousTerm

Settings = WeaklyCompressibleSettings | IncompressibleSettings

Array = np.ndarray[Any, Any]

_SETTINGS: dict[str, type[Settings]] = {
    "explicit": WeaklyCompressibleSettings,
    "incompressible": IncompressibleSettings,
}
SCHEMES = tuple(_SETTINGS)


class FlowFailure(SphearError):
    """A run that broke down: when, where and why.

    Examples:
        >>> import sphear
        >>> cavity = sphear.Simulation(
        ...     sphear.Rectangle((0, 0), (1, 1)),
        ...     spacing=0.1,
        ...     fluid=sphear.Fluid(kinematic_viscosity=0.01),
        ...     boundaries={"upper": sphear.NoSlip(velocity=(1.0, 0.0))},
        ...     scheme=sphear.Incompressible(time_step=1.0, force=True),
        ... )
        >>> try:
        ...     cavity.run(until=30.0)
        ... except sphear.FlowFailure as failure:
        ...     print(failure)
        the flow failed at t = 1, particle ...: a particle went through a wall, as when the time step is ...
    """


class Flow(Protocol):
    """A flow in time, by any scheme.

    Attributes:
        problem: what is computed.
        kernel: with its smoothing length.
        term: the viscous one.
        time: reached.
        steps: made.
        time_step: of the steps.
        limits: the time steps that each condition allows.
        threads: that it computes on.
        count: of particles.
    """

    problem: Problem
    kernel: Kernel
    term: ViscousTerm
    time: float
    steps: int
    time_step: float
    limits: dict[str, float]
    threads: int
    count: int

    @property
    def positions(self) -> Array:
        """Positions of the particles, (N, d), in the problem's unit of length."""

    @property
    def velocities(self) -> Array:
        """Velocities of the particles, (N, d), in the problem's unit of speed."""

    @property
    def density(self) -> Array:
        """Density at the particles, (N,), a mass by a volume."""

    @property
    def pressure(self) -> Array:
        """Pressure at the particles, (N,), a density by a squared speed."""

    @property
    def energy_budget(self) -> EnergyBudget | None:
        """Kinetic energy and the work that was done on it; None of a scheme that keeps none."""

    @staticmethod
    def limits_of(problem: Problem, settings: Any, kernel: Kernel, term: ViscousTerm) -> dict[str, float]:
        """The time steps that each condition allows in another problem with the same particles."""

    def advance(self, steps: int) -> None:
        """Make steps."""

    def state(self) -> dict[str, Array]:
        """All that a run needs to go on, by name; copies."""

    def restore(self, state: dict[str, Array]) -> None:
        """Go back to a `state`."""

    def metrics(self) -> dict[str, float]:
        """Numbers by name that the scheme itself reports at each output."""

    def resolved(self) -> dict[str, Any]:
        """Settings with names and defaults resolved, and numbers that follow from them."""

    def introduction(self) -> str:
        """A few words on the scheme, printed before the first step."""


def described(flow: Flow, viscosity: str) -> str:
    """A flow in a line: its class, particles, viscous term and clock."""
    return (
        f"<{type(flow).__name__} of {flow.count} particles, {viscosity}: t = {flow.time:.6g}, {flow.steps} steps of"
        f" {flow.time_step:.4g}>"
    )


def settings_type(scheme: str) -> type[Settings]:
    """The settings of a scheme.

    Raises:
        SphearError: there is no such scheme.
    """
    if scheme not in _SETTINGS:
        raise unknown("scheme", scheme, SCHEMES)
    return _SETTINGS[scheme]


def unknown_setting(key: str, valid: Mapping[str, Any], scheme: str) -> SphearError:
    """The error for a setting that a scheme has not: it is another scheme's, or nobody's."""
    of = [name for name, kind in _SETTINGS.items() if key in kind.model_fields]
    if of:
        return SphearError(f"the setting {key} is one of scheme={of[0]}, and this is scheme={scheme}")
    return missing(key, valid)


def flow_of(problem: Problem, scheme: Scheme, duration: float = math.inf) -> Flow:
    """The flow of a problem by a scheme.

    Args:
        problem: what is to be computed.
        scheme: that computes it.
        duration: for how long, where that is known; implicit viscous steps resolve it.

    Raises:
        SphearError: they do not go together.
    """
    if isinstance(scheme, Incompressible):
        from sphear.schemes.incompressible.flow import IncompressibleFlow

        return IncompressibleFlow(problem, scheme, duration)
    if not isinstance(scheme, WeaklyCompressible):
        raise SphearError(f"a flow is computed by WeaklyCompressible or Incompressible, not by {quoted(scheme)}")
    from sphear.schemes.weakly_compressible.flow import WeaklyCompressibleFlow

    if problem.free_surface:
        raise SphearError("the explicit scheme knows no free surfaces: take scheme=incompressible")
    if problem.force is not None:
        raise SphearError("the explicit scheme knows constant body forces only: take scheme=incompressible")
    return WeaklyCompressibleFlow(problem, scheme)


def check_start(problem: Problem) -> None:
    """Refuse a start without particles, with places or velocities that are no numbers, or places that cannot be."""
    if not len(problem.positions):
        raise SphearError("the problem has no particles")
    for what, values in (("position", problem.positions), ("velocity", problem.velocities)):
        wrong = np.flatnonzero(~np.isfinite(values).all(axis=1))
        if len(wrong):
            raise SphearError(f"the initial {what} of particle {wrong[0]} is not a number: {values[wrong[0]]}")
    check_places(problem)


def check_state(state: Mapping[str, Array], own: Mapping[str, Array]) -> None:
    """Refuse a saved state that lacks an array of a flow's own, or has it for other particles."""
    for name, values in own.items():
        if name not in state or np.shape(state[name]) != values.shape:
            raise SphearError(f"the saved state has no {name} of the shape {values.shape}: it is of another flow")


def fineness(problem: Problem, scheme: Scheme) -> str:
    """The resolution of a case, or the spacing of another flow, in words."""
    resolution = getattr(scheme, "resolution", None)
    return f"the spacing of {problem.spacing:g}" if resolution is None else f"the resolution of {resolution}"


def check_kernel(problem: Problem, kernel: Kernel, scheme: Scheme, *, connected: bool = True) -> None:
    """Refuse a kernel that reaches no neighbour, or further than a period, or not from part to part of the fluid.

    Args:
        problem: the flow.
        kernel: with its smoothing length.
        scheme: of the flow.
        connected: whether fluid in several parts is refused, whose pressure equation has a constant in each.
    """
    if kernel.radius <= problem.spacing:
        raise SphearError(
            f"the setting h_over_dx must be more than {kernel.h / kernel.radius:.4g} for {kernel.name}, or no particle"
            f" has a neighbour, not {kernel.h / problem.spacing:.4g}"
        )
    for low, high, periodic in zip(problem.box.lower, problem.box.upper, problem.periodic, strict=True):
        if periodic and kernel.radius > high - low:
            raise SphearError(
                f"{fineness(problem, scheme)} is too coarse: the kernel's support of {kernel.radius:g} reaches"
                f" beyond the period of {high - low:g}"
            )
    if connected and problem.shape is not None and not problem.free_surface:
        check_connected(problem, kernel.radius)


def chosen_time_step(limits: dict[str, float], settings: Scheme, duration: float = math.inf) -> float:
    """The least of the limits, and short enough to resolve a run of a duration; or the one asked for.

    Raises:
        SphearError: it is beyond a limit and that is not forced.
    """
    name = min(limits, key=limits.__getitem__)
    limit, wanted = limits[name], settings.time_step
    if wanted is not None and wanted > limit and not settings.force:
        raise SphearError(
            f"the time step of {wanted:g} is beyond the {name.replace('_', '-')} limit of {limit:g}: take a smaller"
            " one, or force it by --set force=true or --force"
        )
    return wanted or min(limit, settings.accurate_step(duration))
