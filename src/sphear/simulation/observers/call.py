"""A function of the user's own, and rules that end a run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from sphear.errors import SphearError, quoted
from sphear.simulation.observers.base import Observer

if TYPE_CHECKING:
    from sphear.simulation.run import Run


@dataclass
class Call(Observer):
    """Calls a function with the simulation at every look, and keeps what it returns, but None.

    Args:
        function: of the simulation.
        every, steps, when: of the looks, see `Observer`.
        at_start: whether to look before the first step too.

    Raises:
        SphearError: it is no function.

    Examples:
        >>> import sphear
        >>> observer = sphear.Call(lambda simulation: simulation.velocities.max(), steps=1, at_start=True)
        >>> cavity = sphear.Simulation(
        ...     sphear.Rectangle((0, 0), (1, 1)),
        ...     spacing=0.1,
        ...     fluid=sphear.Fluid(kinematic_viscosity=0.01),
        ...     boundaries={"upper": sphear.NoSlip(velocity=(1.0, 0.0))},
        ...     observers=[observer],
        ... )
        >>> cavity.run(until=0.1).steps, len(observer.rows)
        (2, 3)
    """

    function: Callable[[Any], Any] | None = None

    def __init__(
        self,
        function: Callable[[Any], Any],
        *,
        every: float | None = None,
        steps: int | None = None,
        when: Sequence[float] | None = None,
        at_start: bool = False,
    ) -> None:
        if not callable(function):
            raise SphearError(f"{type(self).__name__} calls a function of the simulation, not {quoted(function)}")
        self.function, self.every, self.steps, self.when, self.rows = function, every, steps, when, []
        self.at_start = at_start
        super().__post_init__()

    def look(self, run: Run) -> Any:
        """The value that the function returns."""
        assert self.function is not None
        return self.function(run)


@dataclass(init=False)
class StopWhen(Call):
    """Ends a run when a function of the simulation returns something true; a text is the end's name.

    Args:
        function: of the simulation.
        every, steps, when: of the looks, see `Observer`.
        at_start: whether to look before the first step too.

    Examples:
        >>> import sphear
        >>> observer = sphear.StopWhen(lambda simulation: simulation.steps == 3 and "three steps", steps=1)
        >>> cavity = sphear.Simulation(
        ...     sphear.Rectangle((0, 0), (1, 1)),
        ...     spacing=0.1,
        ...     fluid=sphear.Fluid(kinematic_viscosity=0.01),
        ...     boundaries={"upper": sphear.NoSlip(velocity=(1.0, 0.0))},
        ...     observers=[observer],
        ... )
        >>> cavity.run(until=10.0).end
        'three steps'
    """

    def look(self, run: Run) -> None:
        """End the run if the function says so."""
        said = super().look(run)
        if said and not run.end:
            run.end = said if isinstance(said, str) else "stopped"
