"""The lid-driven cavity with a cylinder inside (Zheng, Ma & Shao 2018, section 5.2)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from math import inf
from typing import Any, ClassVar

import numpy as np
from pydantic import Field

from sphear.boundaries.shapes import Circle, Rectangle
from sphear.cases.flow import cavity
from sphear.cases.flow.base import Comparison, Flow, Settings
from sphear.cases.flow.cavity import CAVITY, LID_SPEED, SIDE, Cavity
from sphear.cases.flow.initial import particles_in
from sphear.errors import SphearError
from sphear.references import cavity as references
from sphear.schemes.common import Choices
from sphear.schemes.incompressible.settings import IncompressibleSettings
from sphear.schemes.problem import Problem
from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings

REFERENCE_REYNOLDS = 1000.0


class Cylinder(Choices):
    """The cylinder in the cavity.

    Attributes:
        diameter: of the cylinder, over the cavity's side.
        centre_x: of the cylinder, over the cavity's side, from the left wall.
        centre_y: of the cylinder, over the cavity's side, from the lower wall.
        spin: angular velocity of the cylinder, counter-clockwise, in radians a time unit.
    """

    diameter: float = Field(default=0.5, gt=0, lt=1)
    centre_x: float = Field(default=0.5, gt=0, lt=1)
    centre_y: float = Field(default=0.5, gt=0, lt=1)
    spin: float = Field(default=0.0, allow_inf_nan=False)


class CylinderSettings(Cylinder, IncompressibleSettings):
    """The settings of an incompressible flow around the cylinder."""


class ExplicitCylinderSettings(Cylinder, WeaklyCompressibleSettings):
    """The settings of an explicit flow around the cylinder."""


def cylinder(settings: Settings) -> Circle:
    """The cylinder."""
    assert isinstance(settings, Cylinder)
    return Circle((settings.centre_x, settings.centre_y), 0.5 * settings.diameter, spin=settings.spin)


def flows(settings: Settings) -> list[references.CavityFlow]:
    """The computed flow of the paper's cylinder, where it is that one; its profiles are of t = 40."""
    usual = Cylinder()
    same = isinstance(settings, Cylinder) and all(
        getattr(settings, name) == getattr(usual, name) for name in ("diameter", "centre_x", "centre_y", "spin")
    )
    return [references.cavity_cylinder()] if same and settings.reynolds == REFERENCE_REYNOLDS else []


def reference(settings: Settings, time: float) -> references.CavityFlow | None:
    """The flow of the reference, if this is the time of its profiles."""
    return next((each for each in flows(settings) if abs(each.time - time) <= cavity.EQUAL * time), None)


class CavityCylinder(Cavity):
    """The cavity with a cylinder inside (Zheng, Ma & Shao 2018, section 5.2)."""

    name = "cavity-cylinder"
    defaults: ClassVar[Mapping[str, Mapping[str, Any]]] = {
        "incompressible": {"reynolds": 1000.0, "resolution": 100, "until": 40.0},
        "explicit": {"reynolds": 1000.0, "resolution": 100, "until": 40.0},
    }
    kinds: ClassVar[Mapping[str, type[Settings]]] = {
        "incompressible": CylinderSettings,
        "explicit": ExplicitCylinderSettings,
    }

    def problem(self, settings: Settings) -> Problem:
        """Fluid at rest in a square around a cylinder; the upper wall slides."""
        assert isinstance(settings, Cylinder)
        nearest = min(min(x, SIDE - x) for x in (settings.centre_x, settings.centre_y))
        if nearest < 0.5 * settings.diameter:
            raise SphearError(
                f"the cylinder overlaps a wall: with a diameter of {settings.diameter:g} its centre must be"
                f" {0.5 * settings.diameter:g} or more from the walls, and centre_x={settings.centre_x:g},"
                f" centre_y={settings.centre_y:g} is {nearest:g} from one"
            )
        shape = Rectangle((0.0, 0.0), (SIDE, SIDE), velocities={"upper": (LID_SPEED, 0.0)}) - cylinder(settings)
        positions, _ = particles_in(shape, cavity.BOX, settings)
        return replace(
            CAVITY.problem(settings),
            positions=positions,
            velocities=np.zeros_like(positions),
            speed=max(LID_SPEED, abs(settings.spin) * 0.5 * settings.diameter),
            shape=shape,
        )

    def metrics(self, settings: Settings, flow: Flow) -> dict[str, float]:
        """Kinetic energy and, where a reference has it at this time, what it is too much in parts of that."""
        return cavity.energy(next(iter(flows(settings)), None), flow)

    def summary(self, settings: Settings, flow: Flow) -> dict[str, Any]:
        """As `cavity.summary`."""
        metrics = cavity.deviations(reference(settings, flow.time), cavity.centrelines(flow))
        return metrics | cavity.missing(flow.time, flows(settings), inf)

    def comparisons(self, settings: Settings, flow: Flow) -> dict[str, Comparison]:
        """Both centreline profiles."""
        return cavity.beside(reference(settings, flow.time), cavity.centrelines(flow))

    def profiles(self, settings: Settings, flow: Flow) -> dict[str, list[float]]:
        """Both centreline profiles, to be kept, each with its own stations."""
        (y, u), (x, v) = cavity.centrelines(flow).values()
        return {"y": y.tolist(), "u": u.tolist(), "x": x.tolist(), "v": v.tolist()}


CAVITY_CYLINDER = CavityCylinder()
