"""The choices of the incompressible scheme."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from sphear.boundaries.models import WALL_MODELS, WallModel
from sphear.boundaries.models.base import Continuation, Divergence
from sphear.errors import SphearError
from sphear.schemes.common import OPEN, RunSettings, Scheme
from sphear.schemes.flat_settings import FlatSetting
from sphear.schemes.objects import (
    CorrectionSetting,
    KernelSetting,
    PreconditionerSetting,
    ShiftingSetting,
    Term,
    WallModelSetting,
    text,
)
from sphear.shifting import SHIFTING, ShiftingMethod

LEAST_STEPS = 100  # of a run by implicit viscous steps


class Incompressible(Scheme):
    """The projection scheme for incompressible flow (docs/theory/incompressible.md).

    The defaults are what was found best. Those of Zheng, Ma & Shao (2018) are the preset `zheng2018`.

    Attributes, beside those of all schemes:
        viscosity: name of a viscous term, or an object such as `Cleary(xi=2)`.
        correction: of the viscous term, a name or an object; one with a correction of its own takes no other.
        kernel: name of a kernel, or an object with its own h.
        h_over_dx: smoothing length over particle spacing; None gives a support of 3.14 dx.
        gradient: of the pressure, from "differences" p_j - p_i; "symmetric", p_j + p_i (eq. 3), which conserves
            momentum; or by simplified finite difference interpolation of differences, "sfdi".
        gradient_correction: name of the correction, or an object, of gradient and divergence; with "sfdi" of the
            divergence.
        pressure_level: of the pressure between walls, which its equation leaves open: "free"; zero in the lower left
            "corner"; raised until the "least" is zero; or "cut", negative ones being zero. The symmetric gradient
            pulls particles together where the pressure is negative.
        laplacian: the viscous term, a name or an object, whose Laplacian the pressure equation has; "morris" is eq. 14.
        alpha: share of the density in the source of the pressure equation (eq. 13); the rest is that of the
            divergence. Crowding decays in the time dt / alpha. None takes 10 U dt / L, which is the paper's 0.01 at its
            time step of 0.001.
        projection: where particles are when forces act on them: half a step on, at the "midpoint"; at the "start" of
            the step; or there for viscosity and at the "intermediate" places r* = r + u* dt (eq. 9) for pressure, which
            takes one neighbour search more.
        walls: the wall model, by which walls enter the pressure equation: dummy particles with the pressure at their
            "mirror_points", or that of the fluid before them ("adami", 2012), both continued with the normal gradient;
            particles on the wall with equations of their own ("sfdi", as in the paper); or "natural", by leaving them
            out. As an object, such as `MirrorPoints(continuation="linear")`, it says the next two as well.
        continuation: how the velocity is continued behind walls in the viscous term: "mirror", "linear", "quadratic";
            or not at all, "wall": dummy particles have that of the wall.
        wall_divergence: velocity of dummy particles along the wall in the divergence: the fluid's own, "slipping", or
            the one that is "continued" for the viscous term.
        shifting: "none", "lind" (Lind et al. 2012) or "xu" (Xu, Stansby & Laurence 2009), or an object such as
            `Lind(strength=1)`, which says the next one as well.
        shifting_strength: factor of the shifting, 1 for that of its source; half of it keeps particles as regular and
            costs half the energy.
        viscous_step: "explicit", "crank_nicolson" or "backward_euler"; these two have no viscous limit.
        preconditioner: of the pressure equation, "grid", "amg" or "jacobi", or an object such as
            `Grid(coarsening=3)`.
        tolerance: relative residual of the pressure equation.
        time_step: None takes the least of the CFL, viscous, body-force and shifting limits; with implicit viscous steps
            no more than a hundredth of the run.

    Raises:
        SphearError: two settings contradict each other.

    Examples:
        >>> import sphear
        >>> print(sphear.Incompressible(walls="sfdi", shifting=sphear.Lind(strength=1.0)))
        Incompressible(walls='sfdi', shifting_strength=1.0)
        >>> sphear.Incompressible(shifting="lindt")
        Traceback (most recent call last):
            ...
        sphear.errors.SphearError: there is no shifting named 'lindt': did you mean lind? ...
    """

    name: ClassVar[str] = "incompressible"
    flat: ClassVar[Mapping[str, FlatSetting]] = {
        "walls": FlatSetting(WallModel, WALL_MODELS, {"continuation": "continuation", "divergence": "wall_divergence"}),
        "shifting": FlatSetting(ShiftingMethod, SHIFTING, {"strength": "shifting_strength"}),
    }

    viscosity: Term = "fatehi_manzari"
    correction: CorrectionSetting = "none"
    kernel: KernelSetting = "wendland_c2"
    h_over_dx: float | None = Field(default=None, gt=0, allow_inf_nan=False)
    gradient: Literal["differences", "symmetric", "sfdi"] = "differences"
    gradient_correction: CorrectionSetting = "renormalised"
    pressure_level: Literal["free", "corner", "least", "cut"] = "free"
    laplacian: Term = "morris"
    alpha: float | None = Field(default=None, ge=0, le=1)
    projection: Literal["midpoint", "intermediate", "start"] = "midpoint"
    walls: WallModelSetting = "mirror_points"
    continuation: Continuation = "quadratic"
    wall_divergence: Divergence = "slipping"
    shifting: ShiftingSetting = "lind"
    shifting_strength: float = Field(default=0.5, gt=0, allow_inf_nan=False)
    viscous_step: Literal["explicit", "crank_nicolson", "backward_euler"] = "explicit"
    preconditioner: PreconditionerSetting = "grid"
    tolerance: float = Field(default=1e-4, gt=0, lt=1)

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        self._settle()
        if self.gradient == "symmetric" and self.gradient_correction != "none":
            raise SphearError(
                f"gradient=symmetric conserves momentum and gradient_correction={text(self.gradient_correction)} does"
                " not: take gradient=differences or gradient_correction=none"
            )
        if self.gradient != "symmetric" and self.pressure_level in ("corner", "least"):
            raise SphearError(
                f"pressure_level={self.pressure_level} changes nothing with gradient={self.gradient}, which knows"
                " differences only: take gradient=symmetric or pressure_level=free"
            )
        return self

    @property
    def wall_model(self) -> WallModel:
        """The wall model, with its continuation and divergence."""
        model: WallModel = self._object("walls")
        return model

    @property
    def shifting_method(self) -> ShiftingMethod:
        """The way of shifting, with its strength."""
        method: ShiftingMethod = self._object("shifting")
        return method

    def _beside(self) -> dict[str, Any]:
        """The fields of a named wall model and shifting, where nobody says others."""
        said: dict[str, Any] = {}
        for key, setting in self.flat.items():
            value = getattr(self, key)
            said |= setting.said_by(setting.named[value] if isinstance(value, str) else value)
        return said

    def accurate_step(self, duration: float) -> float:
        """A hundredth of the run by implicit viscous steps: nothing else limits them where a flow is slow."""
        return math.inf if self.viscous_step == "explicit" else duration / LEAST_STEPS

    def _idle(self, walled: bool) -> dict[str, tuple[str, bool]]:
        strong = "strength" in self.flat["shifting"].own(self.shifting_method)
        return {
            **dict.fromkeys(("walls", "continuation", "wall_divergence"), (OPEN, not walled)),
            "shifting_strength": (f"shifting={text(self.shifting)}", not strong),
        }


class IncompressibleSettings(RunSettings, Incompressible):
    """The settings of a case by the incompressible scheme.

    Attributes, beside those of `RunSettings` and `Incompressible`:
        scheme: "incompressible".
    """

    scheme: Literal["incompressible"] = "incompressible"
    reynolds: float = Field(default=100.0, gt=0, allow_inf_nan=False)
    resolution: int = Field(default=50, ge=1)

    def _idle(self, walled: bool) -> dict[str, tuple[str, bool]]:
        return Incompressible._idle(self, walled) | {"seed": (f"initial={self.initial}", self.initial != "relaxed")}
