"""Readings of the settings of Zheng, Ma & Shao 2018: the preset `zheng2018` and what may be meant otherwise."""

from __future__ import annotations

from typing import Any, NamedTuple

STATED = "stated"  # the preset as it is
LONG_SIZES = (40, 100)


class Reading(NamedTuple):
    """A combination of settings near those of the paper.

    name: short.
    changes: settings that differ from the preset `zheng2018` with the paper's time step.
    why: it may be what the paper has.
    stated: whether all that the paper states is kept: what changes is open there.
    """

    name: str
    changes: dict[str, Any]
    why: str
    stated: bool = True


LEAST: dict[str, Any] = {"pressure_level": "least"}
RENORMALISED: dict[str, Any] = {"gradient": "differences", "gradient_correction": "renormalised"}
SLIP: dict[str, Any] = {"wall_divergence": "slipping"}

READINGS = (
    Reading(STATED, {}, "eqs. 3, 4, 7 to 14 and 20, alpha = 0.01, cubic spline, SFDI on walls; h = 1.2 dx is ours"),
    # the level of the pressure, which eq. 3 tells from another and the paper does not fix
    Reading("corner zero", {"pressure_level": "corner"}, "one pressure is held, in a corner, as codes of cavities do"),
    Reading("least zero", LEAST, "no pressure is negative, as in flows with a free surface, whose code it is"),
    Reading("negative cut", {"pressure_level": "cut"}, "a code for free surfaces may set negative pressures to zero"),
    # the pressure gradient
    Reading(
        "differences", {"gradient": "differences"}, "p_j - p_i for p_j + p_i, the form of eqs. 4 and 14", stated=False
    ),
    Reading("renormalised", RENORMALISED, "the corrected gradient of the authors' reference 19", stated=False),
    Reading("sfdi", {"gradient": "sfdi"}, "SFDI for the gradient too, as in the authors' MLPG_R method", stated=False),
    # alpha
    Reading("alpha 0.001", {"alpha": 0.001}, "a tenth of the 0.01 stated", stated=False),
    Reading("alpha 0.1", {"alpha": 0.1}, "ten times the 0.01 stated", stated=False),
    Reading("alpha 0.3", {"alpha": 0.3}, "thirty times the 0.01 stated", stated=False),
    # smoothing length and kernel
    Reading("h = 1.0 dx", {"h_over_dx": 1.0}, "that of tables 1 and 2, which come out with it"),
    Reading("h = 1.5 dx", {"h_over_dx": 1.5}, "a longer one, within what is usual"),
    Reading(
        "wendland", {"kernel": "wendland_c2", "h_over_dx": None}, "a kernel under which no pairs form", stated=False
    ),
    # the order of the moves
    Reading("forces at the start", {"projection": "start"}, "forces before the move, without r*", stated=False),
    Reading("forces at the middle", {"projection": "midpoint"}, "forces after half the move", stated=False),
    # walls
    Reading("still dummies", {"continuation": "wall"}, "dummies move with the wall, as in most codes of this family"),
    Reading("mirrored pressure", {"walls": "mirror_points"}, "walls by mirror points", stated=False),
    Reading("slipping divergence", SLIP, "the divergence does not see that walls hold the fluid"),
    # the time step
    Reading("dt / 4", {"time_step": 0.00025}, "a shorter step, to tell whether it is to blame", False),
    # several at once
    Reading("least zero + slipping", {**LEAST, **SLIP}, "both readings, each of which lives longer"),
    Reading("least zero + still dummies", {**LEAST, "continuation": "wall"}, "both readings"),
    Reading("least zero + h = 1.0 dx", {**LEAST, "h_over_dx": 1.0}, "both readings"),
    Reading("least zero + alpha 0.03", {**LEAST, "alpha": 0.03}, "three times the 0.01 stated", stated=False),
    Reading("least zero + alpha 0.1", {**LEAST, "alpha": 0.1}, "ten times the 0.01 stated", stated=False),
    Reading("renormalised + slipping", {**RENORMALISED, **SLIP}, "both readings", stated=False),
    Reading("sfdi + alpha 0.1", {"gradient": "sfdi", "alpha": 0.1}, "both readings", stated=False),
)
BY_NAME = {reading.name: reading for reading in READINGS}
# computed to the paper's t = 40 too, most wanted first
LONG = ("negative cut", "least zero + slipping", "least zero + alpha 0.03", "least zero + alpha 0.1")
# with 100 particles a side, to see how rates depend on the spacing
FINE = (STATED, "least zero", "differences", "negative cut")
QUICK = (STATED, "least zero", "sfdi", "least zero + alpha 0.1")
