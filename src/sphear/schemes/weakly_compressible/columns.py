"""The values of a particle, or of its image, that the formulas of a pair may use."""

from __future__ import annotations

from sphear.engine.stages import AtImages, Column, Columns

_ALWAYS = {
    "mass": Column(lambda own: own.mass),
    "dynamic_viscosity": Column(lambda own: own.dynamic_viscosity),
    "density": Column(lambda own: own.density),
    "volume": Column(lambda own: own.mass / own.density),
    "pressure": Column(lambda own: own.pressure),
    "pressure_over_density2": Column(lambda own: own.pressure / (own.density * own.density)),
    "inverse_density2": Column(lambda own: 1.0 / (own.density * own.density)),
}
_OF_WALLS = {
    "depth": Column(lambda own: own.depth),
    "fluid": Column(lambda own: own.fluid),
}
_VECTORS = {
    "velocity": Column(lambda own: own.velocity, AtImages.CONTINUED),
    # that slips along a mirror: nothing is continued
    "slip_velocity": Column(lambda own: own.velocity, AtImages.REFLECTED),
    "body_force": Column(lambda own: own.body_force),
}
_VECTORS_OF_WALLS = {
    "normal": Column(lambda own: own.normal),
    "wall_velocity": Column(lambda own: own.wall_velocity),
}
_MOVED = {
    "drift": Column(lambda own: own.drift, AtImages.STANDING),
    "density_gradient": Column(lambda own: own.density_gradient, AtImages.STANDING),
}


def columns(fields: set[str]) -> Columns:
    """The columns of a flow that has these fields, numbers before vectors."""
    walls = "normal" in fields
    chosen = {
        **_ALWAYS,
        **(_OF_WALLS if walls else {}),
        **_VECTORS,
        **(_VECTORS_OF_WALLS if walls else {}),
        **{name: column for name, column in _MOVED.items() if name in fields},
    }
    return tuple(chosen.items())


def without_standing_mass(of: Columns) -> Columns:
    """The same, where images that stand on a wall have no mass: they are within it, and would be counted twice."""
    absent = Column(lambda own: own.mass, AtImages.ABSENT)
    return tuple((name, absent if name == "mass" else column) for name, column in of)
