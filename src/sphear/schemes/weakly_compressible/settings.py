"""The choices of the explicit scheme, weakly compressible or compressible."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, ClassVar, Literal, Self

from pydantic import Field, InstanceOf, model_validator

from sphear.boundaries.models import WALL_MODELS, ExplicitWallModel
from sphear.equations_of_state import Barotropic, IdealGas
from sphear.errors import SphearError
from sphear.schemes.common import OPEN, RunSettings, Scheme
from sphear.schemes.flat_settings import FlatSetting
from sphear.schemes.objects import (
    CorrectionSetting,
    EquationSetting,
    ExplicitWallModelSetting,
    IntegratorSetting,
    KernelSetting,
    Term,
    text,
)
from sphear.schemes.weakly_compressible.integrators import INTEGRATORS, Integrator
from sphear.shifting import Lind

DIFFUSION = 0.1  # delta


class WeaklyCompressible(Scheme):
    """The explicit scheme, weakly compressible or compressible (docs/theory/weakly-compressible.md).

    The defaults are what was found best: second derivatives that are exact for quadratic fields, first ones for linear
    fields, a density that diffusion keeps smooth, particles that shifting keeps regular. Where a setting that is named
    does not go with some default, this gives way. The settings of Basa, Quinlan & Lastiwka (2009) are the
    preset `basa2009`.

    Attributes, beside those of all schemes:
        viscosity: name of a viscous term, or an object such as `Cleary(xi=2)`.
        correction: consistency correction of the kernel, a name or an object, in the pressure, viscous and continuity
            sums. The density sum stays as it is: divided by the kernel's own sum, sum_b m_b W_ab / sum_b (m_b / rho_b)
            W_ab is the mean of the neighbours' densities, and would not know how far apart particles are. A term with a
            correction of its own keeps it.
        kernel: name of a kernel, or an object with its own h.
        h_over_dx: smoothing length over particle spacing; None gives a support of 3.14 dx.
        equation_of_state: "batchelor_tait", "linear" or "ideal_gas", or an object such as
            `BatchelorTait(rho0, c0, gamma)`, which has the density of the flow, and its speed of sound.
        density: by "summation" (eq. 11) or by the "continuity" equation (eq. 10); the sum if nothing is said beside
            momentum=squares and transport=transport_velocity, and beside walls that do not mirror, whose integrated
            densities run away where a lid meets a wall.
        momentum: "squares" (eq. 8, of the summation), "products" (eq. 9, of the continuity equation) or None for the
            one that belongs to the density.
        pressure_reduction: "mean" subtracts the mean pressure of the neighbours (eq. 20), "hydrostatic" the pressure
            at rest (Morris et al. 1997), "none" nothing.
        density_diffusion: delta of Molteni & Colagrossi (2009), 0.1 there and of the continuity equation; 0 leaves it
            out, and is that of density=summation.
        diffusion_form: "molteni", that beside walls=adami and without diffusion, or "antuono" (2010), which takes out
            what the density's gradient explains.
        walls: the wall model: "mirror" particles, at the sides of a box; "fixed" ones with the fluid's velocity
            continued into them (section 6.2), or "adami" (2012), behind walls of any form. If nothing is said, mirrors
            where they can be, else fixed ones. An object, such as `FixedParticles(continuation="linear")`, says the
            settings that are its fields as well.
        continuation: how the velocity is continued into mirror or fixed particles.
        wall_divergence: velocity of mirror particles along the wall in the continuity equation: the fluid's own,
            "slipping", also if nothing is said where there are both; or the one "continued" for the viscous term.
        wall_particles: particles with the wall's velocity on mirroring walls, one for each particle within a spacing.
        integrator: "midpoint", second-order Runge-Kutta, or "kick_drift_kick", with one evaluation a step; a name or
            an object, such as `KickDriftKick()`.
        transport: "none", that of an ideal gas, "shifting" (Lind et al. 2012), or an object of it, `Lind(strength=1)`,
            or "transport_velocity" (Adami et al. 2013).
        shifting_strength: of the shifting, 1 for that of its source.
        background_pressure: of the transport velocity, over density times squared sound speed.
        sound_speed: None takes the rule of Morris, Fox & Zhu (1997) for density variations of 1 %, and of 10 % in the
            corners of slow flows; of an ideal gas it follows from `initial_pressure`.
        initial_pressure: of an ideal gas, 125 kPa in the paper.

    Raises:
        SphearError: a setting is wrong, or two contradict each other.

    Examples:
        >>> import sphear
        >>> print(sphear.WeaklyCompressible(viscosity=sphear.Cleary(xi=2.0), density_diffusion=0.0))
        WeaklyCompressible(viscosity=Cleary(xi=2.0, eta=0.1), density_diffusion=0.0)
    """

    name: ClassVar[str] = "explicit"
    flat: ClassVar[Mapping[str, FlatSetting]] = {
        "transport": FlatSetting(Lind, {"shifting": Lind()}, {"strength": "shifting_strength"}),
        "walls": FlatSetting(
            ExplicitWallModel,
            WALL_MODELS,
            {"continuation": "continuation", "divergence": "wall_divergence", "on_wall": "wall_particles"},
            without="foreign",
        ),
    }

    viscosity: Term = "fatehi_manzari"
    correction: CorrectionSetting = "bonet_lok"
    kernel: KernelSetting = "wendland_c2"
    h_over_dx: float | None = Field(default=None, gt=0, allow_inf_nan=False)
    equation_of_state: EquationSetting = "batchelor_tait"
    density: Literal["summation", "continuity"] = "continuity"
    momentum: Literal["squares", "products"] | None = None
    pressure_reduction: Literal["mean", "hydrostatic", "none"] = "none"
    density_diffusion: float = Field(default=DIFFUSION, ge=0, allow_inf_nan=False)
    diffusion_form: Literal["molteni", "antuono"] = "antuono"
    walls: ExplicitWallModelSetting = "mirror"
    continuation: str = "quadratic"
    wall_divergence: Literal["slipping", "continued"] = "slipping"
    wall_particles: bool = False
    integrator: IntegratorSetting = "midpoint"
    transport: Literal["none", "shifting", "transport_velocity"] | InstanceOf[Lind] = "shifting"
    shifting_strength: float = Field(default=1.0, gt=0, allow_inf_nan=False)
    background_pressure: float = Field(default=1.0, gt=0, allow_inf_nan=False)
    sound_speed: float | None = Field(default=None, gt=0, allow_inf_nan=False)
    initial_pressure: float = Field(default=125e3, gt=0, allow_inf_nan=False)

    @property
    def gas(self) -> bool:
        """The fluid is an ideal gas, with an energy of its own."""
        return self.equation_of_state == "ideal_gas" or isinstance(self.equation_of_state, IdealGas)

    @property
    def wall_model(self) -> ExplicitWallModel:
        """The wall model, with its continuation, divergence and particles on walls."""
        model: ExplicitWallModel = self._object("walls")
        return model

    @property
    def time_integrator(self) -> Integrator:
        """The integrator."""
        return INTEGRATORS[self.integrator] if isinstance(self.integrator, str) else self.integrator

    @property
    def _walls(self) -> ExplicitWallModel:
        """The wall model as it is without flat settings: its class decides on the defaults beside it."""
        given: Any = WALL_MODELS[self.walls] if isinstance(self.walls, str) else self.walls
        walls: ExplicitWallModel = given
        return walls

    @property
    def form(self) -> Literal["squares", "products"]:
        """The form of the momentum equation that belongs to the density."""
        return "squares" if self.density == "summation" else "products"

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        self._settle()
        gas, walls = self.gas, self._walls
        said, named = self.flat["walls"].said_by(walls), text(self.walls)
        contradictions = {
            f"density={self.density} and momentum={self.momentum} are not a variational pair (Bonet & Lok 1999), and"
            f" would not conserve energy: {self.density} goes with {self.form}": self.momentum not in (None, self.form),
            "density_diffusion smooths the continuity equation and density=summation has none: take density=continuity"
            " or no diffusion": self.density_diffusion > 0 and self.density == "summation",
            f"diffusion_form=antuono needs density gradients in the walls, which walls={named} has not: take"
            " walls=mirror or diffusion_form=molteni": (
                self.diffusion_form == "antuono" and not _graded(walls) and self.density_diffusion > 0
            ),
            f"wall_divergence=slipping is about the continuity equation beside mirrors, and not for"
            f" density={self.density} with walls={named}": (
                self.wall_divergence == "slipping" and (self.density == "summation" or not walls.mirrors)
            ),
            "transport=transport_velocity is made for density=summation, not for density=continuity": (
                self.transport == "transport_velocity" and self.density == "continuity"
            ),
            f"transport={self.transport} moves particles without their energy, which equation_of_state=ideal_gas"
            " needs: take transport=none or another equation of state": gas and self.transport != "none",
            "sound_speed follows from initial_pressure where equation_of_state=ideal_gas: give that instead": (
                gas and self.sound_speed is not None
            ),
            "sound_speed is that of the equation of state where this is an object: give its c0 instead": (
                isinstance(self.equation_of_state, Barotropic) and self.sound_speed is not None
            ),
            f"wall_particles stand on mirroring walls and walls={named} has none: take walls=mirror or no"
            " wall_particles": self.wall_particles and "wall_particles" not in said,
            f"the explicit scheme finds velocities behind walls={walls.said} in its own way: leave"
            f" {' and '.join(walls.foreign)} out of {named}": not isinstance(self.walls, str) and _foreign(walls),
        }
        for sentence, contradictory in contradictions.items():
            if contradictory:
                raise SphearError(sentence)
        return self

    def _beside(self) -> dict[str, Any]:
        walls = self._walls
        said = self.flat["walls"].said_by(walls)
        summed = self.momentum == "squares" or self.transport == "transport_velocity"
        integrated = self.momentum == "products" or (
            "density_diffusion" in self.model_fields_set and self.density_diffusion > 0
        )
        return {
            "density": "summation" if summed or not (walls.mirrors or integrated) else "continuity",
            "density_diffusion": DIFFUSION if self.density == "continuity" else 0.0,
            "diffusion_form": "antuono" if self.density_diffusion > 0 and _graded(walls) else "molteni",
            "continuation": said.get("continuation", "quadratic"),
            "wall_divergence": said.get(
                "wall_divergence", "slipping" if self.density == "continuity" and walls.mirrors else "continued"
            ),
            "wall_particles": said.get("wall_particles", False),
            "transport": "none" if self.gas else "shifting",
        }

    def _idle(self, walled: bool) -> dict[str, tuple[str, bool]]:
        said = self.flat["walls"].said_by(self._walls)
        return {
            "diffusion_form": ("density_diffusion=0", self.density_diffusion == 0),
            "shifting_strength": (f"transport={self.transport}", self.transport != "shifting"),
            "background_pressure": (f"transport={self.transport}", self.transport != "transport_velocity"),
            "continuation": (f"walls={text(self.walls)}", "continuation" not in said) if walled else (OPEN, True),
            "wall_divergence": (OPEN, not walled),
            "initial_pressure": (
                f"equation_of_state={text(self.equation_of_state)}",
                not self.gas,
            ),
        }


def _graded(walls: ExplicitWallModel) -> bool:
    """True of walls in which the density has a gradient: of images that of their particle, or one that is summed."""
    return walls.mirrors or walls.integrates_density


def _foreign(walls: ExplicitWallModel) -> bool:
    """True of a wall model one of whose fields, which says nothing in the explicit scheme, is not as usual."""
    return any(field.name in walls.foreign and getattr(walls, field.name) != field.default for field in fields(walls))


class WeaklyCompressibleSettings(RunSettings, WeaklyCompressible):
    """The settings of a case by the explicit scheme.

    Attributes, beside those of `RunSettings` and `WeaklyCompressible`:
        scheme: "explicit".
    """

    scheme: Literal["explicit"] = "explicit"
    reynolds: float = Field(default=0.5, gt=0, allow_inf_nan=False)

    def _idle(self, walled: bool) -> dict[str, tuple[str, bool]]:
        return WeaklyCompressible._idle(self, walled) | {"seed": (f"initial={self.initial}", self.initial != "relaxed")}
