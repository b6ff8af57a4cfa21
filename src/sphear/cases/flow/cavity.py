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

SIDE, LID_SPEED, DENSITY = 1.0, 1.0, 1.0
STATIONS = np.linspace(0.0, 1.0, 66)[1:-1]  # where the centreline profiles are compared, the walls left out


def problem(settings: Settings) -> Problem:
    """A square of particles at rest between four walls, of which the upper one slides."""
    box = Box((0.0, 0.0), (SIDE, SIDE), ("walls", "walls"), upper_velocity=(LID_SPEED, 0.0))
    positions, spacing = particles_between(box, settings)
    return Problem(
        positions=positions,
        velocities=np.zeros_like(positions),
        box=box,
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


def centrelines(flow: FlowInTime) -> tuple[Array, Array]:
    """u along x = 1/2 and v along y = 1/2, at `STATIONS`."""
    half = np.full_like(STATIONS, 0.5 * SIDE)
    along_y = interpolated(flow, np.stack((half, STATIONS), axis=1))
    along_x = interpolated(flow, np.stack((STATIONS, half), axis=1))
    return along_y[:, 0], along_x[:, 1]


def summary(settings: Settings, flow: FlowInTime) -> dict[str, float]:
    """Deviations of the centreline profiles from the reference, in lid speeds: mean and largest, and the least u."""
    u, v = centrelines(flow)
    found = {"u_min": float(u.min())}
    known = reference(settings, flow.time)
    if known is None:
        return found
    found["reference_time"] = known.time if np.isfinite(known.time) else -1.0
    for name, values, curve in (("u", u, known.u), ("v", v, known.v)):
        if len(curve.stations) < 40:  # published tables are compared at their own stations
            inside = curve.stations[1:-1]
            deviation = np.interp(inside, STATIONS, values) - curve.values[1:-1]
        else:
            deviation = values - curve.at(STATIONS)
        found[f"{name}_mean_deviation"] = float(np.abs(deviation).mean())
        found[f"{name}_max_deviation"] = float(np.abs(deviation).max())
    return found


def profiles(settings: Settings, flow: FlowInTime) -> dict[str, list[float]]:
    """Both centreline profiles, to be kept."""
    u, v = centrelines(flow)
    return {"stations": STATIONS.tolist(), "u": u.tolist(), "v": v.tolist()}


def comparisons(settings: Settings, flow: FlowInTime) -> dict[str, Comparison]:
    """Both centreline profiles."""
    u, v = centrelines(flow)
    known = reference(settings, flow.time)
    nothing = np.empty(0)
    return {
        "u on x = 1/2": Comparison(
            "y", STATIONS, u, *((known.u.stations, known.u.values) if known else (nothing, nothing))
        ),
        "v on y = 1/2": Comparison(
            "x", STATIONS, v, *((known.v.stations, known.v.values) if known else (nothing, nothing))
        ),
    }


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
