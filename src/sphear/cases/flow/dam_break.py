"""A column of fluid that collapses: a dam break (Martin & Moyce 1952)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
from pydantic import Field

from sphear.boundaries import Box
from sphear.boundaries.shapes import Rectangle
from sphear.cases.flow.base import Case, Flow, Settings
from sphear.cases.size import check_size
from sphear.errors import SphearError
from sphear.references import dam_break as reference
from sphear.schemes.incompressible.settings import IncompressibleSettings
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]

WIDTH, GRAVITY, DENSITY = 1.0, 1.0, 1.0  # of the column
FEWEST = 4  # particles
AT_WALL = "the front is at the wall"
AHEAD = 2.0  # widths of the column: the front takes at least the tank's width less these to the opposite wall
GAP = 2.0  # spacings, from which on particles are spray


class DamBreakSettings(IncompressibleSettings):
    """The settings of an incompressible flow, and those of the column.

    Attributes:
        column: its height over its width.
        tank: the tank's width over the column's.
        tank_height: the tank's height over the column's; it has a lid.
    """

    column: float = Field(default=2.0, gt=0, le=100, allow_inf_nan=False)
    tank: float = Field(default=6.0, ge=1.5, le=1000, allow_inf_nan=False)
    tank_height: float = Field(default=2.0, ge=1.2, le=100, allow_inf_nan=False)

    def without_effect(self, walled: bool) -> list[str]:
        """Beside what has no effect: that a run may end before its time."""
        said = super().without_effect(walled)
        if self.until is not None and self.until > self.tank - AHEAD:
            said.append(
                f"a run of dam-break ends when its front is at the opposite wall, maybe before until={self.until:g}"
            )
        return said


def speed(settings: Settings) -> float:
    """sqrt(n^2 g a): of the scales of the experiment, n^2 the height of the column over its width a."""
    assert isinstance(settings, DamBreakSettings)
    return math.sqrt(settings.column * GRAVITY * WIDTH)


def standing(heights: Array, dx: float) -> float:
    """The highest of increasing heights that are one above the other without a gap, from the floor on."""
    gaps = np.flatnonzero(np.diff(heights, prepend=-0.5 * dx) > GAP * dx)
    reached = heights[: gaps[0]] if len(gaps) else heights
    return float(reached[-1]) if len(reached) else -0.5 * dx


class DamBreak(Case):
    """A column of fluid that collapses (Martin & Moyce 1952)."""

    name = "dam-break"
    defaults: ClassVar[Mapping[str, Mapping[str, Any]]] = {
        "incompressible": {"reynolds": 1000.0, "resolution": 20, "until": 3.3, "continuation": "linear"}
    }
    kinds: ClassVar[Mapping[str, type[Settings]]] = {"incompressible": DamBreakSettings}
    time_name = "t sqrt(n^2 g / a)"
    headline = "front"
    ends = (AT_WALL,)

    def problem(self, settings: Settings) -> Problem:
        """A column of fluid at rest in the corner of a tank, `resolution` particles wide."""
        assert isinstance(settings, DamBreakSettings)
        if settings.initial != "lattice":
            raise SphearError(
                f"the column of dam-break starts from initial=lattice, not from initial={settings.initial}"
            )
        check_size("resolution", settings.resolution, (1.0, settings.column))
        spacing = WIDTH / settings.resolution
        if settings.column * WIDTH < FEWEST * spacing or settings.resolution < FEWEST:
            raise SphearError(
                f"a column of dam-break is at least {FEWEST} particles wide and high, and column={settings.column:g}"
                f" with resolution={settings.resolution} is {settings.resolution} wide and"
                f" {round(settings.column * settings.resolution)} high"
            )
        high = settings.column * settings.resolution
        if abs(high - round(high)) > 1e-6:
            raise SphearError(
                f"the column of dam-break is whole particles high, and column={settings.column:g} with"
                f" resolution={settings.resolution} is {high:.4g}"
            )
        height = settings.column * WIDTH
        top = settings.tank_height * height
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

    def time_unit(self, settings: Settings) -> float:
        """sqrt(a / (n^2 g))."""
        return WIDTH / speed(settings)

    def metrics(self, settings: Settings, flow: Flow) -> dict[str, float]:
        """The front's and the column's place over the width, and the energy over that of the start."""
        x, dx = flow.positions, flow.problem.spacing
        kinetic = 0.5 * (flow.velocities**2).sum()
        potential = GRAVITY * x[:, 1].sum()
        start = flow.problem.positions[:, 1].sum() * GRAVITY
        return {
            "front": float((x[:, 0].max() + 0.5 * dx) / WIDTH),
            "height": float((standing(np.sort(x[x[:, 0] < 2 * dx, 1]), dx) + 0.5 * dx) / WIDTH),
            "energy": float((kinetic + potential) / start),
        }

    def ended(self, settings: Settings, flow: Flow, metrics: dict[str, float]) -> str | None:
        """The end of a run whose front meets the opposite wall."""
        assert isinstance(settings, DamBreakSettings)
        return AT_WALL if metrics["front"] > settings.tank - 2 * flow.problem.spacing else None

    def summary(self, settings: Settings, flow: Flow) -> dict[str, Any]:
        """The front less that of the experiment, in column widths, at times of which it is known."""
        measured, time = self.reference_history(settings), flow.time * speed(settings) / WIDTH
        if measured is None:
            return {}
        first, last = measured[0][0], measured[0][-1]
        if not first <= time <= last:
            said = f"the front was measured from T = {first:g} to {last:g}, and this is T = {time:.4g}"
            return {"reference_missing": said}
        return {"front_deviation": self.metrics(settings, flow)["front"] - float(np.interp(time, *measured))}

    def reference_history(self, settings: Settings) -> tuple[Array, Array] | None:
        """The front of the experiment, if this is its column."""
        assert isinstance(settings, DamBreakSettings)
        return (np.array(reference.TIMES), np.array(reference.FRONTS)) if settings.column == reference.COLUMN else None


DAM_BREAK = DamBreak()
