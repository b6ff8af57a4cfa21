"""The lid-driven cavity from rest (Basa, Quinlan & Lastiwka 2009, section 6.2)."""

from __future__ import annotations

from typing import Any

import numpy as np

from sphear.boundaries import Box
from sphear.cases.flow.base import Comparison, FlowCase, FlowInTime, Settings, kinetic_energy
from sphear.cases.flow.initial import particles_between
from sphear.cases.flow.interpolation import interpolated
from sphear.references import cavity as references
from sphear.schemes.problem import Problem

Array = np.ndarray[Any, Any]
Lines = dict[str, tuple[Array, Array]]  # stations and values by name

SIDE, LID_SPEED, DENSITY = 1.0, 1.0, 1.0
BOX = Box((0.0, 0.0), (SIDE, SIDE), ("walls", "walls"), upper_velocity=(LID_SPEED, 0.0))
STATIONS = np.linspace(0.0, 1.0, 66)[1:-1]  # where the centreline profiles are compared, the walls left out


def problem(settings: Settings) -> Problem:
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


def reference(settings: Settings, time: float) -> references.CavityFlow | None:
    """The flow to compare profiles with: at its time where one was computed, else steady; None if there is none."""
    number = settings.reynolds
    if number in references.MAC_TIMES:
        times = references.MAC_TIMES[int(number)]
        near = min(times, key=lambda known: abs(known - time))
        return references.mac(number, near)
    if number in references.MARCHI_REYNOLDS:
        return references.marchi(number)
    return references.ghia(number) if number in references.GHIA_REYNOLDS else None


def metrics(settings: Settings, flow: FlowInTime) -> dict[str, float]:
    """Kinetic energy and, where a reference has it at this time, what it is too much in parts of that."""
    return energy(reference(settings, flow.time), flow)


def energy(known: references.CavityFlow | None, flow: FlowInTime) -> dict[str, float]:
    """Kinetic energy and, where a reference is known at this time, what it is too much in parts of that."""
    kinetic = kinetic_energy(flow)
    found = {"kinetic_energy": kinetic}
    if known is not None and known.energy is not None:
        curve = known.energy
        if 0 < flow.time <= curve.stations[-1] + flow.time_step:  # a run ends within a step of its time
            found["kinetic_energy_error"] = kinetic / float(curve.at(min(flow.time, curve.stations[-1]))) - 1.0
    return found


def centrelines(flow: FlowInTime) -> Lines:
    """u along x = 1/2 and v along y = 1/2: the `STATIONS` that are in the fluid, and the values there."""
    found = {}
    for component, name in enumerate("uv"):
        points = np.full((len(STATIONS), 2), 0.5 * SIDE)
        points[:, 1 - component] = STATIONS
        shape = flow.problem.shape
        inside = np.ones(len(STATIONS), bool) if shape is None else shape.distance(points) > 0
        found[name] = STATIONS[inside], interpolated(flow, points[inside])[:, component]
    return found


def summary(settings: Settings, flow: FlowInTime) -> dict[str, float]:
    """Deviations of the centreline profiles from the reference, in lid speeds: mean and largest, and the least u."""
    return deviations(reference(settings, flow.time), centrelines(flow))


def deviations(known: references.CavityFlow | None, lines: Lines) -> dict[str, float]:
    """What `summary` says of profiles beside a reference, whose time is inf where it is steady."""
    found = {"u_min": float(lines["u"][1].min())} if len(lines["u"][1]) else {}  # a cylinder may fill the line
    if known is None:
        return found
    found["reference_time"] = known.time
    for name, curve in (("u", known.u), ("v", known.v)):
        stations, values = lines[name]
        if curve.table:  # published tables are compared at their own stations
            inside = curve.stations[1:-1]
            deviation = np.interp(inside, stations, values) - curve.values[1:-1]
        else:
            deviation = values - curve.at(stations)
        found[f"{name}_mean_deviation"] = float(np.nanmean(np.abs(deviation)))
        found[f"{name}_max_deviation"] = float(np.nanmax(np.abs(deviation)))
    return found


def profiles(settings: Settings, flow: FlowInTime) -> dict[str, list[float]]:
    """Both centreline profiles, to be kept."""
    lines = centrelines(flow)
    return {"stations": STATIONS.tolist(), **{name: values.tolist() for name, (_, values) in lines.items()}}


def comparisons(settings: Settings, flow: FlowInTime) -> dict[str, Comparison]:
    """Both centreline profiles."""
    return beside(reference(settings, flow.time), centrelines(flow))


def beside(known: references.CavityFlow | None, lines: Lines) -> dict[str, Comparison]:
    """Both centreline profiles with those of a reference."""
    nothing = np.empty(0)
    found = {}
    for name, along, where in (("u", "y", "x"), ("v", "x", "y")):
        curve = None if known is None else getattr(known, name)
        stations, values = (nothing, nothing) if curve is None else (curve.stations, curve.values)
        found[f"{name} on {where} = 1/2"] = Comparison(
            along,
            *lines[name],
            stations,
            values,
            reference_time=None if known is None else known.time,
            table=curve is not None and curve.table,
        )
    return found


CAVITY = FlowCase(
    name="cavity",
    defaults={
        "explicit": {
            "reynolds": 100.0,
            "resolution": 50,
            "until": 20.0,
            "walls": "fixed",
            "wall_velocity": "quadratic",
            "correction": "shepard",
        },
        "incompressible": {"reynolds": 100.0, "resolution": 50, "until": 20.0},
    },
    problem=problem,
    comparisons=comparisons,
    time_unit=lambda settings: SIDE / LID_SPEED,
    time_name="t",
    metrics=metrics,
    ended=lambda settings, flow, found: None,
    summary=summary,
    profiles=profiles,
    headline="kinetic_energy",
)
