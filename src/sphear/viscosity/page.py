"""The cards of all viscous terms as a page of the documentation."""

from __future__ import annotations

from sphear.viscosity import VISCOSITY
from sphear.viscosity.card import card, measured

_INTRODUCTION = """# Viscous terms

What every term computes, where it comes from, and what was measured of it (`python validation/measure_cards.py` writes
this page; a test compares it). All without a correction and with equal volumes, in two dimensions:

- **order**: of the L1 error of the Laplacian of sin(2 pi x) sin(2 pi y) in dx, with h fixed in dx (cubic spline,
  support 3.14 dx), on a lattice from 160 to 320 particles a side, and on particles jittered by 0.3 dx from 80 to 160,
  mean of 8 seeds. Terms whose force acts along the line of centres are tested on the velocity derived
  from this field as a stream function. An order about 0 is an error
  that stays however many particles are taken; about -1, one that doubles when dx is halved. On a lattice, errors that
  stay are small for some terms (0.1 to 2 %).
- **linear and angular momentum**: zero change to rounding over isolated clusters of jittered particles.
- **only dissipates**: no velocity gains energy, the eigenvector that would gain most included.
- **cost**: of one viscous acceleration, preparation included, relative to `morris`.
"""

_OWN = """## A term of your own

A term is a dataclass with one method, the weight w_ij of lap f_i = sum_j V_j w_ij (f_j - f_i); the engine compiles it
like the others. It is taken wherever a name is, in flows of both schemes and in sweeps too:

```python
from dataclasses import dataclass

import numpy as np
import sphear


@dataclass(frozen=True)
class Mine(sphear.LaplacianTerm):
    factor: float = 2.0
    name = "mine"

    def weight(self, kernel, correction, own, d, r2):
        return -self.factor * correction.radial(kernel, own.prepared, d, r2) / r2


x = np.random.default_rng(0).random((400, 2))
lap = sphear.laplacian(x, x[:, 0] ** 2, viscosity=Mine())
rows = sphear.PatchTest(viscosity=(Mine(), "morris"), sizes=(20,)).rows()
run = sphear.flow("taylor-green", viscosity=Mine(factor=2.1), resolution=20, until=0.01).run()
sphear.viscous_term("mine")(Mine())  # from now on "mine" is a name, as by a decorator of the class
```

Numbers that may change are fields of the dataclass. Results name a term by its class and numbers,
`Mine(factor=2.1)`, and a saved run or a sweep goes on with a term that is equal in these: after a change of the formula
take another folder. Worker processes of a sweep import the class, so it stands in a module or
at the top of the script. A force along the line of centres, or one with a rule for a viscosity that varies, derives
from `sphear.ViscousTerm` and gives `acceleration`, as `violeau` does. [Extending](../how-to/extending.md) has the
decorator, names on the command line and in packages, and kernels and corrections.

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
    return "\n".join((_INTRODUCTION, *table, "", _OWN + cards[0], *cards[1:]))
