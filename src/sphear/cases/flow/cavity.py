"""The lid-driven cavity from rest (Basa, Quinlan & Lastiwka 2009, section 6.2)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from typing import Any, ClassVar

import numpy as np

from sphear.boundaries import Box
from sphear.cases.flow.base import Case, Comparison, Flow, Settings
from sphear.cases.flow.initial import particles_between
from sphear.references import cavity as references
from sphear.schemes.problem import Problem
from sphear.simulation.interpolation import interpolated
from sphear.simulation.whole_flow import kinetic_energy

Array = np.ndarray[Any, Any]
Lines = dict[str, tuple[Array, Array]]  # stations and values by name

SIDE, LID_SPEED, DENSITY = 1.0, 1.0, 1.0
BOX = Box((0.0, 0.0), (SIDE, SIDE), ("walls", "walls"), upper_velocity=(LID_SPEED, 0.0))
EQUAL = 5e-3  # of a time: times that differ by less are equal
STEADY = 0.2  # nu t / L^2, from which on the flow counts as steady
LEAST_ENERGY = 1e-12  # of the fluid at the lid's speed: below, nothing is relative to it
STATIONS = np.linspace(0.0, 1.0, 66)[1:-1]  # where the centreline profiles are compared, the walls left out


def reference(settings: Settings, time: float) -> references.CavityFlow | None:
    """The flow to compare profiles with: one computed of this time, else a steady one if the flow is steady by then.

    Times are equal within `EQUAL`. The flow is steady from `STEADY` on: the slowest mode of a square at rest decays as
    exp(-52.34 nu t / L^2) (Leriche & Labrosse 2004, Stokes eigenmodes in square domain, J. Comput. Phys. 200:489), to
    3e-5 by then; and at Re = 1000 the least u is within 1e-4 of the steady one at 0.08 already. None if there is none.
    """
    for each in flows(settings):
        if abs(each.time - time) <= EQUAL * time or (steady(settings, time) and each.time >= steady_from(settings)):
            return each
    return None


def flows(settings: Settings) -> list[references.CavityFlow]:
    """All flows of this Reynolds number with profiles, the best first: computed ones, and a steady one."""
    number = settings.reynolds
    computed = [references.mac(number, time) for time in references.MAC_TIMES.get(int(number), ()) if number % 1 == 0]
    if number in references.MARCHI_REYNOLDS:
        return [*computed, references.marchi(number)]
    return [*computed, references.ghia(number)] if number in references.GHIA_REYNOLDS else computed


def steady_from(settings: Settings) -> float:
    """The time from which on the flow counts as steady."""
    return STEADY * settings.reynolds * SIDE / LID_SPEED


def steady(settings: Settings, time: float) -> bool:
    """True if the flow counts as steady, within rounding of the time."""
    return time >= steady_from(settings) * (1 - EQUAL)


def energy(reference_flow: references.CavityFlow | None, flow: Flow) -> dict[str, float]:
    """Kinetic energy and, where a reference is known at this time, what it is too much in parts of that."""
    kinetic = kinetic_energy(flow)
    metrics = {"kinetic_energy": kinetic}
    if reference_flow is not None and reference_flow.energy is not None:
        curve = reference_flow.energy
        if 0 < flow.time <= curve.stations[-1] + flow.time_step:  # a run ends within a step of its time
            exact = float(curve.at(min(flow.time, curve.stations[-1])))
            if exact > LEAST_ENERGY:
                metrics["kinetic_energy_error"] = kinetic / exact - 1.0
    return metrics


def centrelines(flow: Flow) -> Lines:
    """u along x = 1/2 and v along y = 1/2: the `STATIONS` that are in the fluid, and the values there."""
    lines = {}
    for component, name in enumerate("uv"):
        points = np.full((len(STATIONS), 2), 0.5 * SIDE)
        points[:, 1 - component] = STATIONS
        shape = flow.problem.shape
        inside = np.ones(len(STATIONS), bool) if shape is None else shape.distance(points) > 0
        lines[name] = STATIONS[inside], interpolated(flow, points[inside])[:, component]
    return lines


def missing(time: float, reference_flows: Sequence[references.CavityFlow], from_when: float) -> dict[str, str]:
    """A sentence on the times of which profiles are known, if this is none of them, as `reference_missing`.

    Args:
        time: of the flow.
        reference_flows: all profiles of its Reynolds number.
        from_when: the flow is steady.
    """
    times = [flow.time for flow in reference_flows]
    if not times or any(abs(known - time) <= EQUAL * time for known in times) or time >= from_when * (1 - EQUAL):
        return {}
    parts = [f"those computed are of t = {' and '.join(f'{known:g}' for known in times if isfinite(known))}"]
    parts = parts if isfinite(times[0]) else []
    if not isfinite(times[-1]):
        parts.append(f"steady ones hold from t = {from_when:g} on")
    return {"reference_missing": f"no profiles are known at t = {time:.4g}: {', and '.join(parts)}"}


def deviations(reference_flow: references.CavityFlow | None, lines: Lines) -> dict[str, float]:
    """Deviations of profiles from a reference, for `summary`; its time is inf where it is steady."""
    metrics = {"u_min": float(lines["u"][1].min())} if len(lines["u"][1]) else {}  # a cylinder may fill the line
    if reference_flow is None:
        return metrics
    metrics["reference_time"] = reference_flow.time
    for name, curve in (("u", reference_flow.u), ("v", reference_flow.v)):
        stations, values = lines[name]
        if curve.table:  # published tables are compared at their own stations
            inside = curve.stations[1:-1]
            deviation = np.interp(inside, stations, values) - curve.values[1:-1]
        else:
            deviation = values - curve.at(stations)
        metrics[f"{name}_mean_deviation"] = float(np.nanmean(np.abs(deviation)))
        metrics[f"{name}_max_deviation"] = float(np.nanmax(np.abs(deviation)))
    return metrics


def beside(reference_flow: references.CavityFlow | None, lines: Lines) -> dict[str, Comparison]:
    """Both centreline profiles with those of a reference."""
    nothing = np.empty(0)
    profiles = {}
    for name, along, where in (("u", "y", "x"), ("v", "x", "y")):
        curve = None if reference_flow is None else getattr(reference_flow, name)
        stations, values = (nothing, nothing) if curve is None else (curve.stations, curve.values)
        profiles[f"{name} on {where} = 1/2"] = Comparison(
            along,
            *lines[name],
            stations,
            values,
            reference_time=None if reference_flow is None else reference_flow.time,
            table=curve is not None and curve.table,
        )
    return profiles


class Cavity(Case):
    """The lid-driven cavity from rest (Basa, Quinlan & Lastiwka 2009, section 6.2)."""

    name = "cavity"
    defaults: ClassVar[Mapping[str, Mapping[str, Any]]] = {
        "explicit": {"reynolds": 100.0, "resolution": 50, "until": 20.0},
        "incompressible": {"reynolds": 100.0, "resolution": 50, "until": 20.0},
    }
    presets: ClassVar[Mapping[str, Mapping[str, Any]]] = {
        "basa2009": {"walls": "fixed", "continuation": "quadratic", "correction": "shepard"}
    }
    time_name = "t"
    headline = "kinetic_energy"

    def problem(self, settings: Settings) -> Problem:
        """A square of particles at rest between four walls, of which the upper one slides."""
        positions, spacing = particles_between(BOX, settings)
        return Problem(
            positions=positions,
            velocities=np.zeros_like(positions),
            box=BOX,
            body_force=(0.0, 0.0),
            spacing=spacing,
            density=DENSITY,
            kinematic_viscosity=LID_SPEED * SIDE / settings.reynolds,
            speed=LID_SPEED,
            length=SIDE,
        )

    def time_unit(self, settings: Settings) -> float:
        """The side over the speed of the lid."""
        return SIDE / LID_SPEED

    def metrics(self, settings: Settings, flow: Flow) -> dict[str, float]:
        """Kinetic energy and, where a reference has it at this time, what it is too much in parts of that."""
        return energy(next(iter(flows(settings)), None), flow)

    def summary(self, settings: Settings, flow: Flow) -> dict[str, Any]:
        """Deviations of the centreline profiles from the reference, in lid speeds: mean and largest, and the least u.

        Without a reference of this time, it is said which there are.
        """
        metrics = deviations(reference(settings, flow.time), centrelines(flow))
        return metrics | missing(flow.time, flows(settings), steady_from(settings))

    def comparisons(self, settings: Settings, flow: Flow) -> dict[str, Comparison]:
        """Both centreline profiles."""
        return beside(reference(settings, flow.time), centrelines(flow))

    def profiles(self, settings: Settings, flow: Flow) -> dict[str, list[float]]:
        """Both centreline profiles, to be kept."""
        lines = centrelines(flow)
        return {"stations": STATIONS.tolist(), **{name: values.tolist() for name, (_, values) in lines.items()}}


CAVITY = Cavity()
