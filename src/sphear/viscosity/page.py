"""The cards of all viscous terms as a page of the documentation."""

from __future__ import annotations

from sphear.viscosity import VISCOSITY
from sphear.viscosity.card import card, measured

_INTRODUCTION = """# Viscous terms

Formula, source and measured properties of every term (`python validation/measure_cards.py` writes this page; a test
compares it). Signs are those of [SPH in ten equations](sph.md), words those of the
[glossary](../reference/glossary.md); [which to choose](../how-to/choose-settings.md), [one of your
own](../how-to/extending.md). In flows, particles move and errors differ: [orders of whole
flows](../measurements/orders.md). All without a correction and with equal volumes, in two dimensions:

- **order**: of the L1 error of the Laplacian of sin(2 pi x) sin(2 pi y) in dx, with h fixed in dx (cubic spline,
  support 3.14 dx), on a lattice from 160 to 320 particles a side, and on particles jittered by 0.3 dx from 80 to 160,
  mean of 8 seeds. Terms whose force acts along the line of centres are tested on the velocity derived from this field
  as a stream function. An order about 0 is an error that stays however many particles are taken; about -1, one that
  doubles when dx is halved. On a lattice, errors that stay are small for some terms (0.1 to 2 %).
- **linear and angular momentum**: zero change to rounding over isolated clusters of jittered particles.
- **only dissipates**: no velocity gains energy, the eigenvector that would gain most included.
- **cost**: of one viscous acceleration, preparation included, relative to `morris`.
"""


def page() -> str:
    """The text of docs/theory/viscosity.md."""
    facts = measured()
    table = [
        "| term | order, lattice | order, jittered | linear momentum | angular momentum | only dissipates | cost |"
    ]
    table.append("|---|---|---|---|---|---|---|")
    published = [name for name in VISCOSITY if name in VISCOSITY.published]
    for name in published:
        one = facts[name]
        held = ["yes" if one[key] else "no" for key in ("linear_momentum", "angular_momentum", "dissipative")]
        orders = [f"{one[key]:+.1f}" for key in ("order_lattice", "order_jittered")]
        table.append(f"| `{name}` | {' | '.join((*orders, *held))} | {one['cost']:.1f} |")
    cards = [f"## {name}\n\n```\n{card(None, name).text()}\n```\n" for name in published]
    return "\n".join((_INTRODUCTION, *table, "", *cards))
