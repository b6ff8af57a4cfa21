"""What each viscous term costs, as the time of its viscous acceleration over that of `morris`.

10,000 jittered particles of a periodic square, 29 neighbours, Wendland C2, no correction but a term's own, one thread;
preparations and all sweeps count, the search for neighbours does not. The terms are timed in turn, best of many. Where
nothing is prepared for a particle both sides of a pair can be computed together: the column "once".
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from _bench import Array, Report, best_of, clocked, jittered_square

from sphear import VISCOSITY, Domain, NoCorrection, Particles, WendlandC2

SIDE = 100
SECONDS = 20.0


def _calls(each_pair_once: bool) -> dict[str, Callable[[], Array]]:
    positions = jittered_square(SIDE)
    particles = Particles.read(
        positions,
        kernel=WendlandC2(3.09 / 2 / SIDE),
        volumes=1 / SIDE**2,
        domain=Domain((0, 0), (1, 1)),
        threads=1,
        each_pair_once=each_pair_once,
    )
    velocity = np.sin(2 * np.pi * positions)
    viscosity = 1 + 0.1 * positions[:, 0]
    density = np.ones(len(positions))
    return {
        name: partial(particles.viscous_acceleration, velocity, viscosity, density, VISCOSITY[name], NoCorrection())
        for name in VISCOSITY
    }


def _times(seconds: float) -> dict[tuple[str, bool], float]:
    calls = {(name, once): call for once in (False, True) for name, call in _calls(once).items()}
    keys = {f"{name} {once}": (name, once) for name, once in calls}
    times = best_of(seconds, *(clocked(label, calls[key], 2) for label, key in keys.items()))
    return {keys[label]: time for label, time in times.items()}


def relative_costs(seconds: float = SECONDS) -> dict[str, float]:
    """By name of the term: its time over that of `morris`, both over the full pair list."""
    times = _times(seconds)
    return {name: times[name, False] / times["morris", False] for name in VISCOSITY}


def main() -> None:
    report = Report(__doc__ or "")
    times = _times(SECONDS)
    for name in sorted(VISCOSITY, key=lambda name: times[name, False]):
        report.add(f"{name} / morris", times[name, False] / times["morris", False])
        if times[name, True] < 0.97 * times[name, False]:
            report.add(f"{name} / morris, once", times[name, True] / times["morris", False])
    report.close()


if __name__ == "__main__":
    main()
