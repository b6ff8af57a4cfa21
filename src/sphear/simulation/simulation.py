"""A simulation that is composed of objects."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Self

import numpy as np

from sphear.boundaries.conditions import Condition
from sphear.boundaries.shapes import Shape
from sphear.checked import number
from sphear.errors import SphearError, quoted
from sphear.schemes.base import FlowFailure, flow_of
from sphear.schemes.common import Scheme
from sphear.schemes.watch import Watch
from sphear.simulation.chosen_scheme import chosen_scheme
from sphear.simulation.described import described
from sphear.simulation.fluid import Fluid
from sphear.simulation.observers import History, Observer
from sphear.simulation.observers.base import check_observer, whole
from sphear.simulation.particles import Velocity
from sphear.simulation.region import Force, problem_of
from sphear.simulation.run import Kept, Run
from sphear.simulation.saved import About, check, read, write

Array = np.ndarray[Any, Any]

PLENTY = 10**12  # steps
LOOKS, SELDOM = 200, 1000  # at the energy budget, in a run, and steps between two of them at most


class _Plausible(Observer):
    """Ends a run that does what no fluid does."""

    at_start = False

    def look(self, run: Run) -> None:
        """Judge."""
        run.end = run.end or run.implausible()


class Simulation(Run):
    """A flow of a fluid in a region, computed by a scheme and watched by observers.

    Args:
        region: where the fluid is, in the plane: a `Rectangle`, what is left of one without a `Circle` or a `Polygon`,
            or any bounded shape that `|`, `&`, `-` and `~` make.
        spacing: of the particles, a length.
        fluid: its density and viscosity.
        boundaries: conditions by the names of walls ("left", "right", "lower", "upper", "circle", or the name that a
            shape was given), and `Periodic()` by "x" or "y"; walls that are not named are at rest, `NoSlip()`.
        scheme: `Incompressible(...)`, also if none is given, or `WeaklyCompressible(...)`, which knows no surfaces;
            "incompressible" and "weakly_compressible" have the defaults.
        observers: that look at the simulation at their intervals.
        velocity: at the start: (d,) for all particles, (N, d), a function of places (N, d), or None at rest.
        body_force: on a unit of mass: (d,), or a function of places (N, d) and the time.
        speed: the largest that is expected, which time steps follow; None takes that of walls, of the start, or the
            least of f L^2 / (8 nu) and sqrt(2 f L) of a force.
        length: that the Reynolds number is made with; None takes the least extent of the region.
        filled: the part of the region that fluid fills at the start, with a surface of its own; None is all of it.

    Attributes:
        time, steps: reached.
        positions: places of the particles now, (N, d), in lengths.
        velocities: of the particles now, (N, d), in lengths over times.
        density: of the particles now, (N,), in masses over volumes.
        pressure: at the particles now, (N,), in forces over areas.
        end: "time", "steps", a stop rule's word, or "failed: ..."; empty before a run.

    Raises:
        SphearError: the parts do not go together.

    Examples:
        >>> import sphear
        >>> simulation = sphear.Simulation(
        ...     sphear.Rectangle((0, 0), (1, 1)),
        ...     spacing=0.1,
        ...     fluid=sphear.Fluid(kinematic_viscosity=0.01),
        ...     boundaries={"upper": sphear.NoSlip(velocity=(1.0, 0.0))},
        ... )
        >>> len(simulation.positions), simulation.reynolds
        (100, 100.0)
        >>> simulation.run(until=0.1).end, simulation.steps
        ('time', 2)
    """

    def __init__(
        self,
        region: Shape,
        *,
        spacing: float,
        fluid: Fluid,
        boundaries: Mapping[str, Condition] | None = None,
        scheme: Scheme | str | None = None,
        observers: Sequence[Observer] = (),
        velocity: Velocity = None,
        body_force: Force | None = None,
        speed: float | None = None,
        length: float | None = None,
        filled: Shape | None = None,
    ) -> None:
        given: Any = {} if boundaries is None else boundaries
        for observer in observers:
            check_observer(observer)
        chosen = chosen_scheme(scheme)
        problem = problem_of(region, spacing, fluid, given, velocity, body_force, speed, length, filled)
        conditions = dict(given)
        super().__init__(flow_of(problem, chosen), Watch(problem), observers)
        self._judge = self._plausible = _Plausible(steps=1)
        self.filled = filled
        self.region, self.fluid, self.boundaries, self.scheme = region, fluid, conditions, chosen

    @property
    def time(self) -> float:
        """The time reached, in the unit of time of velocities and viscosity."""
        return self.flow.time

    @property
    def steps(self) -> int:
        """The number of steps made since the start."""
        return self.flow.steps

    @property
    def positions(self) -> Array:
        """The places of the particles now, (N, d), in lengths; within the box along periodic axes."""
        return self.flow.positions

    @property
    def velocities(self) -> Array:
        """The velocities of the particles now, (N, d), in lengths over times, in the order of `positions`."""
        return self.flow.velocities

    @property
    def density(self) -> Array:
        """The densities of the particles now, (N,), in masses over volumes; constant in incompressible flow."""
        return self.flow.density

    @property
    def pressure(self) -> Array:
        """The pressures at the particles now, (N,), in forces over areas; up to a constant between walls."""
        return self.flow.pressure

    @property
    def reynolds(self) -> float:
        """U L / nu of the expected speed and the length; infinite without viscosity."""
        problem = self.flow.problem
        nu = problem.kinematic_viscosity
        return problem.speed * problem.length / nu if nu else math.inf

    @property
    def history(self) -> dict[str, Array]:
        """The table of the first `History` among the observers: numbers by name, one a look.

        Raises:
            SphearError: there is none.
        """
        for observer in self.observers:
            if isinstance(observer, History):
                return observer.table
        raise SphearError("this simulation has no history: give it an observer, as in observers=[History(every=0.1)]")

    def run(self, until: float, keep: str | Path | None = None) -> Self:
        """Advance to a time; called again with a later one, it goes on.

        Args:
            until: the time; the last step may end up to a step beyond it.
            keep: a file that the state is saved to every 10 seconds and at the end.

        Raises:
            FlowFailure: the flow broke down; it stays as it was at that moment.
            SphearError: the time is not later than that reached.
        """
        end = number(until)
        if not end > self.time:
            raise SphearError(f"a run goes on to a time later than {self.time:g}, not to {quoted(until)}")
        return self._advanced(end, PLENTY, None if keep is None else Path(keep))

    def step(self, count: int = 1) -> Self:
        """Make steps.

        Raises:
            FlowFailure: the flow broke down.
            SphearError: the number of steps is not positive.
        """
        if not whole(count):
            raise SphearError(f"steps are made in a positive number, not {quoted(count)}")
        return self._advanced(math.inf, self.steps + count)

    def _advanced(self, until: float, max_steps: int, keep: Path | None = None) -> Self:
        if self.failed:
            raise FlowFailure(self.end.removeprefix("failed: "))
        self.end = ""
        self._begin()
        planned = min((until - self.time) / self.flow.time_step, max_steps - self.steps)
        self._plausible.steps = max(1, min(round(planned / LOOKS), SELDOM)) if math.isfinite(planned) else SELDOM
        self._to_end(until, max_steps, keep=keep)
        if self.failed:
            raise FlowFailure(self.end.removeprefix("failed: "))
        return self

    def _save(self, path: Path, kept: Kept) -> None:
        state = kept[0]
        about = About(case="simulation", settings=self._described(), history=[], seconds=self.seconds, end="")
        write(path, about, state)
        self.saved = float(state["clock"][0])

    def restore(self, path: str | Path) -> Self:
        """Go on from a file that `save` wrote for the same simulation; observers begin anew.

        Raises:
            SphearError: it cannot be read, or is of another simulation.
        """
        about, state = read(Path(path))
        check(Path(path), about, "simulation", self._described(), {})
        self.flow.restore(state)
        self.seconds, self.end = about.seconds, ""
        return self

    def _described(self) -> dict[str, Any]:
        """The parts that must be equal for a saved state to be gone on with."""
        return {
            "region": repr(self.region),
            "fluid": repr(self.fluid),
            "boundaries": repr(self.boundaries),
            "scheme": str(self.scheme),
            "particles": self.flow.count,
            **{key: str(getattr(self.flow.problem, key)) for key in ("spacing", "body_force", "speed", "length")},
            "filled": repr(self.filled),
        }

    def __repr__(self) -> str:
        """The number of particles, the time and steps reached, and the end."""
        end = f", end: {self.end}" if self.end else ""
        return f"<Simulation of {self.flow.count} particles: t = {self.time:.6g}, {self.steps} steps{end}>"

    def __str__(self) -> str:
        """The physics, the numerics, the limits of the step, and what a run will take."""
        return described(self)
