"""The methods and attributes that a kind of thing needs before it can have a name."""

from __future__ import annotations

import dataclasses
from typing import Any, NamedTuple

from sphear.boundaries.models import AnyWallModel
from sphear.corrections import Correction
from sphear.equations_of_state import EquationOfState
from sphear.errors import SphearError, quoted
from sphear.kernels import Kernel
from sphear.pressure import Preconditioner
from sphear.schemes.weakly_compressible.integrators import Integrator
from sphear.shifting import ShiftingMethod
from sphear.viscosity import LaplacianTerm, ViscousTerm


class Protocol(NamedTuple):
    """A kind of thing: its base class, and what each class of the kind defines itself.

    Attributes:
        decorator: that names things of it.
        base: the class to derive from.
        said: the base class as users write it.
        methods: the names of its methods.
        attributes: the names of class attributes.
        fields: those that are given values when one is made, so that they need no defaults.
        instances: an object of the class may have a name too, not the class alone.
    """

    decorator: str
    base: type
    said: str
    methods: tuple[str, ...]
    attributes: tuple[str, ...] = ()
    fields: tuple[str, ...] = ()
    instances: bool = False


TERM = Protocol(
    "viscous_term", ViscousTerm, "sphear.ViscousTerm or sphear.LaplacianTerm", ("acceleration",), instances=True
)
KERNEL = Protocol("kernel", Kernel, "sphear.Kernel", ("shape", "slope", "curvature"), ("support", "sigma"), ("h",))
CORRECTION = Protocol(
    "correction", Correction, "sphear.Correction", ("preparation", "value", "gradient"), instances=True
)
EQUATION = Protocol(
    "equation_of_state", EquationOfState, "sphear.EquationOfState or sphear.Barotropic",
    ("pressure", "sound_speed", "density"), fields=("rho0", "c0"),
)  # fmt: skip
SHIFTING = Protocol("shifting_method", ShiftingMethod, "sphear.ShiftingMethod", ("drift",), instances=True)
WALL_MODEL = Protocol("wall_model", AnyWallModel, "sphear.WallModel or sphear.ExplicitWallModel", (), instances=True)
INTEGRATOR = Protocol("integrator", Integrator, "sphear.Integrator", ("step", "kept"), instances=True)
PRECONDITIONER = Protocol("preconditioner", Preconditioner, "sphear.Preconditioner", ("build",), instances=True)


def checked(thing: Any, protocol: Protocol) -> type:
    """The class of what is decorated, or of the object, made a frozen dataclass unless it is one.

    Args:
        thing: that is to have a name.
        protocol: its kind.

    Raises:
        SphearError: it is of another kind, or lacks a method, an attribute or a default.
    """
    kind = thing if isinstance(thing, type) else type(thing)
    if not issubclass(kind, protocol.base) or not (protocol.instances or isinstance(thing, type)):
        what = f"the class {kind.__name__}" if isinstance(thing, type) else f"{quoted(thing)}"
        either = ", or an object of one" if protocol.instances else ""
        raise SphearError(
            f"@sphear.{protocol.decorator} names a class derived from {protocol.said}{either}, not {what}"
        )
    _complete(kind, protocol)
    if isinstance(thing, type) and "__dataclass_fields__" not in vars(kind):
        _as_dataclass(kind)
    if isinstance(thing, type):
        _defaults(kind, protocol)
    return kind


def _complete(kind: type, protocol: Protocol) -> None:
    """Refuse a class without the methods and attributes of its kind."""
    needed = ("weight",) if issubclass(kind, LaplacianTerm) else protocol.methods
    base = LaplacianTerm if issubclass(kind, LaplacianTerm) else protocol.base
    other = ("acceleration", "acceleration_stages") if issubclass(kind, ViscousTerm) else ()  # which do without
    own = [name for name in (*needed, *other) if getattr(kind, name) is not getattr(base, name)]
    for name in () if any(name in own for name in other) else needed:
        if name not in own:
            raise SphearError(f"the class {kind.__name__} lacks the method {name} of {base.__name__}")
    for name in protocol.attributes:
        if not hasattr(kind, name):
            raise SphearError(f"the class {kind.__name__} lacks the attribute {name} of {base.__name__}")


def _as_dataclass(kind: type) -> None:
    try:
        dataclasses.dataclass(frozen=True, repr=not issubclass(kind, ViscousTerm))(kind)
    except (TypeError, ValueError) as error:
        raise SphearError(f"the class {kind.__name__} cannot be made a dataclass: {error}") from error


def _defaults(kind: type, protocol: Protocol) -> None:
    """Refuse a class of which no object can be made by its name alone."""
    for field in dataclasses.fields(kind):
        given = (field.default, field.default_factory) != (dataclasses.MISSING, dataclasses.MISSING)
        if field.init and not given and field.name not in protocol.fields:
            instead = ", or name an object of the class" if protocol.instances else ""
            raise SphearError(f"the field {field.name} of {kind.__name__} has no default: give it one{instead}")
