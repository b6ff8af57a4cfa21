"""The cost of runs, and settings that do not go together, found without starting each one's flow."""

from __future__ import annotations

from collections.abc import Hashable
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:  # sphear.schemes imports Numba, which a worker must not meet before it is set up
    from sphear.kernels import Kernel
    from sphear.schemes.base import Flow, Settings
    from sphear.viscosity import ViscousTerm

UNTIL_STEADY = 20.0  # time units, the guess where the case says when a run is over
SCALES = ("reynolds", "until", "max_steps", "time_step", "force", "threads", "seed")
"""Settings that are numbers of a flow only: its particles, walls and formulas are the same with any of them."""


class _Built(NamedTuple):
    """The numbers that are kept of a flow that was started."""

    particles: int
    kernel: Kernel
    term: ViscousTerm
    scheme: type[Flow]


class Costs:
    """Particles times steps of runs; a run that ends by itself is a guess.

    A flow is started, and so checked, for each choice of all settings but `SCALES`; of the others with that choice only
    the time step is found.
    """

    def __init__(self) -> None:
        self._built: dict[Hashable, _Built] = {}

    def of(self, case: str, settings: Settings) -> float:
        """The cost of a run.

        Args:
            case: name of a flow.
            settings: of it.

        Raises:
            SphearError: the settings do not go together.
        """
        from sphear.cases.flow import FLOWS, CaseRun
        from sphear.cases.flow.own_walls import opened
        from sphear.schemes.base import chosen_time_step

        chosen = FLOWS[case]
        # relaxed particles take long to make, and are as many as those of a lattice
        quick = {"initial": "lattice"} if settings.initial == "relaxed" else {}
        quickly = settings.model_copy(update=quick)
        choice = (chosen.name, tuple((name, str(value)) for name, value in quickly if name not in SCALES))
        built = self._built.get(choice)
        duration = (settings.until or UNTIL_STEADY) * chosen.time_unit(settings)
        if built is None:
            flow = CaseRun(chosen, quickly).flow
            time_step = flow.time_step
            built = self._built[choice] = _Built(len(flow.positions), flow.kernel, flow.term, type(flow))
        else:
            problem = opened(chosen, quickly).problem(quickly)
            limits = built.scheme.limits_of(problem, settings, built.kernel, built.term)
            time_step = chosen_time_step(limits, settings, duration)
        return built.particles * min(duration / time_step, settings.max_steps)
