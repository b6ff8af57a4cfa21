"""The formulas of a step for each particle by itself: pressure, rates and moves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sphear.algebra import add, scale, subtract
from sphear.equations_of_state import EquationOfState


@dataclass(frozen=True)
class SummedDensity:
    """The density that was summed."""

    def at(self, own: Any) -> dict[str, Any]:
        """From the sum."""
        return {"density": own.summed[0]}


@dataclass(frozen=True)
class Pressure:
    """The pressure that an equation of state gives, from density and energy."""

    equation: EquationOfState

    def at(self, own: Any) -> dict[str, Any]:
        """From the particle's own density and energy."""
        return {"pressure": self.equation.pressure(own.density, getattr(own, "energy", 0.0))}


@dataclass(frozen=True)
class Rates:
    """The rates of change, of the last sum over pairs, and the body force.

    Attributes:
        roles: of the sum, in its order.
        wanted: those that are kept.
    """

    roles: tuple[str, ...]
    wanted: tuple[str, ...]

    def at(self, own: Any) -> dict[str, Any]:
        """From the sums."""
        sums, dimension, first = own.rates, len(own.position), 0
        result: dict[str, Any] = {}
        for role in self.roles:
            vector = role not in ("density", "energy")
            value = sums[first : first + dimension] if vector else sums[first]
            first += dimension if vector else 1
            if role in self.wanted:
                name = {"velocity": "acceleration", "density": "density_rate", "energy": "energy_rate"}.get(role, role)
                result[name] = add(value, own.body_force) if role == "velocity" else value
        return result


@dataclass(frozen=True)
class Kept:
    """Fields as they are now, for later."""

    names: tuple[str, ...]

    def at(self, own: Any) -> dict[str, Any]:
        """The fields, by other names."""
        return {f"{name}_before": getattr(own, name) for name in self.names}


@dataclass(frozen=True)
class Advanced:
    """The state that was kept, and the present rates for a time: y = y_before + dt f.

    Attributes:
        time: dt.
        scalars: those of density and energy that are integrated.
        moving: whether place and velocity are, too.
        drifting: whether particles move against the fluid.
    """

    time: float
    scalars: tuple[str, ...]
    moving: bool
    drifting: bool

    def at(self, own: Any) -> dict[str, Any]:
        """From state, kept state and rates."""
        result: dict[str, Any] = {}
        if self.moving:
            velocity = add(own.velocity, own.drift) if self.drifting else own.velocity
            result["position"] = add(own.position_before, scale(self.time, velocity))
            result["velocity"] = add(own.velocity_before, scale(self.time, own.acceleration))
        for name in self.scalars:
            result[name] = getattr(own, f"{name}_before") + self.time * getattr(own, f"{name}_rate")
        return result


@dataclass(frozen=True)
class Drifted:
    """Places a step later, and velocities, densities and energies with the rates before it; these rates are kept.

    Attributes: see `Advanced`.
    """

    time: float
    scalars: tuple[str, ...]
    moving: bool
    drifting: bool

    def at(self, own: Any) -> dict[str, Any]:
        """From state and rates."""
        result: dict[str, Any] = {}
        if self.moving:
            mean = add(own.velocity, scale(0.5 * self.time, own.acceleration))
            velocity = add(mean, own.drift) if self.drifting else mean
            result["position"] = add(own.position, scale(self.time, velocity))
            result["velocity"] = add(own.velocity, scale(self.time, own.acceleration))
            result["acceleration_before"] = own.acceleration
        for name in self.scalars:
            rate = getattr(own, f"{name}_rate")
            result[name] = getattr(own, name) + self.time * rate
            result[f"{name}_rate_before"] = rate
        return result


@dataclass(frozen=True)
class Corrected:
    """Half of each rate, before and after the step, in place of the rate before it.

    Attributes: see `Advanced`.
    """

    time: float
    scalars: tuple[str, ...]
    moving: bool

    def at(self, own: Any) -> dict[str, Any]:
        """From state and rates."""
        half = 0.5 * self.time
        result: dict[str, Any] = {}
        if self.moving:
            result["velocity"] = add(own.velocity, scale(half, subtract(own.acceleration, own.acceleration_before)))
        for name in self.scalars:
            change = getattr(own, f"{name}_rate") - getattr(own, f"{name}_rate_before")
            result[name] = getattr(own, name) + half * change
        return result
