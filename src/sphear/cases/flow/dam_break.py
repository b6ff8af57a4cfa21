"""A column of fluid that collapses: a dam break (Martin & Moyce 1952)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from pydantic import Field

from sphear.boundaries import Box
from sphear.boundaries.shapes import Rectangle
from sphear.cases.flow.base import Comparison, FlowCase, FlowInTime, Settings
from sphear.errors import SphearError
from sphear.references import dam_break as reference
from sphear.schemes.incompressible.settings import IncompressibleSettings
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]

WIDTH, GRAVITY, DENSITY = 1.0, 1.0, 1.0  # of the column
FEWEST = 4  # particles


class DamBreakSettings(IncompressibleSettings):
    """The settings of an incompressible flow, and those of the column.

    Attributes:
        column: its height over its width.
        tank: the tank's width over the column's.
    """

    column: float = Field(default=2.0, gt=0, allow_inf_nan=False)
    tank: float = Field(default=6.0, ge=1.5, allow_inf_nan=False)


def speed(settings: Settings) -> float:
    """sqrt(n^2 g a): of the scales of the experiment, n^2 the height of the column over its width a."""
    assert isinstance(settings, DamBreakSettings)
    return math.sqrt(settings.column * GRAVITY * WIDTH)


def problem(settings: Settings) -> Problem:
    """A column of fluid at rest in the corner of a tank, `resolution` particles wide."""
    assert isinstance(settings, DamBreakSettings)
    if settings.initial != "lattice":
        raise SphearError(f"the column of dam-break starts from initial=lattice, not from initial={settings.initial}")
    spacing = WIDTH / settings.resolution
    if settings.column * WIDTH < FEWEST * spacing or settings.resolution < FEWEST:
        raise SphearError(
            f"a column of dam-break is at least {FEWEST} particles wide and high, and column={settings.column:g} with"
            f" resolution={settings.resolution} is {settings.resolution} wide and"
            f" {round(settings.column * settings.resolution)} high"
        )
    height = settings.column * WIDTH
    top = height + 10 * spacing
    box = Box((0.0, 0.0), (settings.tank * WIDTH, top), ("walls", "walls"))
    rows = [(np.arange(round(extent / spacing)) + 0.5) * spacing for extent in (WIDTH, height)]
    positions = np.stack(np.meshgrid(*rows, indexing="ij"), axis=-1).reshape(-1, 2)
    return Problem(
        positions=positions,
        velocities=np.zeros_like(positions),
        box=box,
        body_force=(0.0, -GRAVITY),
        spacing=spacing,
        density=DENSITY,
        kinematic_viscosity=speed(settings) * WIDTH / settings.reynolds,
        speed=2.0 * speed(settings),  # of the front of a shallow dam break, 2 sqrt(g H)
        length=WIDTH,
        shape=Rectangle((0.0, 0.0), (settings.tank * WIDTH, top)),
        free_surface=True,
    )


def metrics(settings: Settings, flow: FlowInTime) -> dict[str, float]:
    """The front's and the column's place over the width, and the energy over that of the start."""
    x, dx = flow.positions, flow.problem.spacing
    connected = x[flow.pressure > 0] if (flow.pressure > 0).any() else x
    kinetic = 0.5 * (flow.velocities**2).sum()
    potential = GRAVITY * x[:, 1].sum()
    start = flow.problem.positions[:, 1].sum() * GRAVITY
    return {
        "front": float((x[:, 0].max() + 0.5 * dx) / WIDTH),
        "height": float((connected[connected[:, 0] < 2 * dx, 1].max(initial=-0.5 * dx) + 0.5 * dx) / WIDTH),
        "energy": float((kinetic + potential) / start),
    }


def ended(settings: Settings, flow: FlowInTime, found: dict[str, float]) -> str | None:
    """Where the front meets the opposite wall."""
    assert isinstance(settings, DamBreakSettings)
    return "the front is at the wall" if found["front"] > settings.tank - 2 * flow.problem.spacing else None


def summary(settings: Settings, flow: FlowInTime) -> dict[str, float]:
    """How far the front is from where the experiment has it, in column widths, where that is known."""
    known = _known(settings, flow)
    return {} if known is None else {"front_deviation": metrics(settings, flow)["front"] - known}


def _known(settings: Settings, flow: FlowInTime) -> float | None:
    assert isinstance(settings, DamBreakSettings)
    time = flow.time * speed(settings) / WIDTH
    if settings.column != reference.COLUMN or not reference.TIMES[0] <= time <= reference.TIMES[-1]:
        return None
    return float(np.interp(time, reference.TIMES, reference.FRONTS))


def comparisons(settings: Settings, flow: FlowInTime) -> dict[str, Comparison]:
    """The particles: how the fluid stands."""
    nothing = np.empty(0)
    return {"y of the particles": Comparison("x", flow.positions[:, 0], flow.positions[:, 1], nothing, nothing)}


DAM_BREAK = FlowCase(
    name="dam-break",
    defaults={"incompressible": {"reynolds": 1000.0, "resolution": 20, "until": 3.3, "wall_velocity": "linear"}},
    kinds={"incompressible": DamBreakSettings},
    problem=problem,
    comparisons=comparisons,
    time_unit=lambda settings: WIDTH / speed(settings),
    time_name="t sqrt(n^2 g / a)",
    metrics=metrics,
    ended=ended,
    summary=summary,
    headline="front",
)
