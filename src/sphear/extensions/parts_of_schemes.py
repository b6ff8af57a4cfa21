"""Decorators that give parts of schemes names: ways of shifting, wall models, integrators, preconditioners."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar, dataclass_transform

from sphear.boundaries.models import WALL_MODELS, AnyWallModel
from sphear.extensions import protocol
from sphear.extensions.naming import decorator_of
from sphear.pressure import PRECONDITIONERS, Preconditioner
from sphear.schemes.weakly_compressible.integrators import INTEGRATORS, Integrator
from sphear.shifting import SHIFTING, ShiftingMethod

ShiftingT = TypeVar("ShiftingT", bound="ShiftingMethod | type[ShiftingMethod]")
WallModelT = TypeVar("WallModelT", bound="AnyWallModel | type[AnyWallModel]")
IntegratorT = TypeVar("IntegratorT", bound="Integrator | type[Integrator]")
PreconditionerT = TypeVar("PreconditionerT", bound="Preconditioner | type[Preconditioner]")


@dataclass_transform(frozen_default=True)
def shifting_method(name: str, *, aliases: Sequence[str] = ()) -> Callable[[ShiftingT], ShiftingT]:
    """Give a way of shifting a name, which incompressible flows take as the setting `shifting` from then on.

    It decorates a class derived from `ShiftingMethod`, or an object of one, with the method `drift`: a sum over
    neighbours, a `sphear.interactions.Part` of the role "drift". The setting `shifting_strength` is its field
    `strength`, if it has one.

    Args:
        name: of the method, found whatever the case, with '-' and ' ' read as '_'.
        aliases: other names of it.

    Returns:
        The decorator, which gives back the class or object it is given.

    Raises:
        SphearError: a name is taken, with what has it, or is no name; the class lacks a method or a default; or the
            thing is no way of shifting.

    Examples:
        >>> import sphear
        >>> @sphear.shifting_method("weak")
        ... class Weak(sphear.Lind):
        ...     strength: float = 0.2
        ...
        >>> sphear.SHIFTING["weak"]
        Weak(strength=0.2)
    """
    return decorator_of(protocol.SHIFTING, SHIFTING, name, aliases)


@dataclass_transform(frozen_default=True)
def wall_model(name: str, *, aliases: Sequence[str] = ()) -> Callable[[WallModelT], WallModelT]:
    """Give a wall model a name, which flows take as the setting `walls` from then on.

    It decorates a class derived from `WallModel`, of incompressible flows, from `ExplicitWallModel`, of explicit ones,
    or from one of the package's models, or an object of one, that changes methods of it: all have one. The settings
    `continuation`, `wall_divergence` and `wall_particles` are its fields, if it has them.

    Args, returns and raises: as `shifting_method`.

    Examples:
        >>> import sphear
        >>> linear = sphear.wall_model("linear_points")(sphear.MirrorPoints(continuation="linear"))
        >>> print(sphear.Incompressible(walls="linear_points"))
        Incompressible(walls='linear_points')
    """
    return decorator_of(protocol.WALL_MODEL, WALL_MODELS, name, aliases)


@dataclass_transform(frozen_default=True)
def integrator(name: str, *, aliases: Sequence[str] = ()) -> Callable[[IntegratorT], IntegratorT]:
    """Give a time integrator a name, which explicit flows take as the setting `integrator` from then on.

    It decorates a class derived from `Integrator`, or an object of one, with the methods `step`, the stages of a time
    step, and `kept`, the fields whose values at its start these need.

    Args, returns and raises: as `shifting_method`.

    Examples:
        >>> import sphear
        >>> @sphear.integrator("mine")
        ... class Mine(sphear.Midpoint):
        ...     pass
        ...
        >>> print(sphear.WeaklyCompressible(integrator="mine"))
        WeaklyCompressible(integrator='mine')
    """
    return decorator_of(protocol.INTEGRATOR, INTEGRATORS, name, aliases)


@dataclass_transform(frozen_default=True)
def preconditioner(name: str, *, aliases: Sequence[str] = ()) -> Callable[[PreconditionerT], PreconditionerT]:
    """Give a preconditioner a name, which incompressible flows take as the setting `preconditioner` from then on.

    It decorates a class derived from `Preconditioner`, or an object of one, with the method `build`, which makes of a
    `PressureSystem` the function that applies nearly its inverse.

    Args, returns and raises: as `shifting_method`.

    Examples:
        >>> import sphear
        >>> coarse = sphear.preconditioner("coarse")(sphear.Grid(coarsening=4.0))
        >>> print(sphear.Incompressible(preconditioner="coarse"))
        Incompressible(preconditioner='coarse')
    """
    return decorator_of(protocol.PRECONDITIONER, PRECONDITIONERS, name, aliases)
