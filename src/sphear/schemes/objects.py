"""Settings that are registered names or objects: how they are read, and how they are written down."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import is_dataclass
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BeforeValidator, InstanceOf, PlainSerializer, PlainValidator, ValidationInfo

from sphear.boundaries.models import WALL_MODELS, AnyWallModel, ExplicitWallModel, WallModel
from sphear.corrections import CORRECTIONS, Correction
from sphear.engine.structure import made_of
from sphear.equations_of_state import EQUATIONS_OF_STATE, Barotropic, IdealGas
from sphear.errors import SphearError
from sphear.kernels import KERNELS, Kernel
from sphear.names import Registry, unknown
from sphear.operators import arguments
from sphear.pressure import PRECONDITIONERS, Preconditioner
from sphear.schemes.weakly_compressible.integrators import INTEGRATORS, Integrator
from sphear.shifting import SHIFTING, ShiftingMethod
from sphear.viscosity import VISCOSITY, ViscousTerm


def text(value: Any) -> str:
    """A name as it is; an object as its class and what it is made of, such as Cleary(xi=2.0, eta=0.1)."""
    if isinstance(value, str):
        return value
    return repr(value) if isinstance(value, type) or not is_dataclass(value) else made_of(value)


def plain(name: Any, registry: Registry[Any], key: str = "") -> Any:
    """The registered name of a name or an alias; an object as it is.

    Args:
        name: or object.
        registry: of the names.
        key: the setting, where an error would not name it by what it takes.

    Raises:
        SphearError: there is no such name.
    """
    return registry.name(name, key) if isinstance(name, str) else name


def _reader(registry: Registry[Any], kind: type, read: Callable[[Any], Any]) -> Callable[[Any, ValidationInfo], Any]:
    """Take names as they are, and objects of a kind: those that are registered by their names."""

    def reader(value: Any, info: ValidationInfo) -> Any:
        if isinstance(value, kind):
            names = (name for name in registry if registry[name] == value)
            return next(names, None) or read(value)
        if isinstance(value, str):
            return value
        raise SphearError(
            f"the setting {info.field_name} should be a name, such as {next(iter(registry))!r}, or an object of the"
            f" class {kind.__name__}, not {text(value)}"
        )

    return reader


def _as_given(registry: Registry[Any], kind: type, read: Callable[[Any], Any] = lambda value: value) -> Any:
    return PlainValidator(_reader(registry, kind, read))


def _by_name(registry: Registry[Any], kind: type) -> Any:
    """Take objects of a kind, and names and aliases, of which the registered ones are kept."""
    read = _reader(registry, kind, lambda value: value)

    def reader(value: Any, info: ValidationInfo) -> Any:
        item, key = read(value, info), str(info.field_name)
        return plain(item, registry, "" if registry.kind == key else f"the setting {key}")

    return PlainValidator(reader)


def _walls(kind: type[AnyWallModel], scheme: str) -> Any:
    """Take the wall models of a scheme, by their names too; one of another scheme is refused by both names."""

    def reader(value: Any, info: ValidationInfo) -> Any:
        if not isinstance(value, str | AnyWallModel):
            raise SphearError(
                f"the setting walls should be a name, such as {_of(kind)[0]!r}, or an object of the class"
                f" {kind.__name__}, not {text(value)}"
            )
        registered = _name_of_walls(value, kind) if isinstance(value, str) else None
        item = value if registered is None else WALL_MODELS[registered]
        if not isinstance(item, kind):
            raise SphearError(
                f"walls={registered or text(item)} is no wall model of the {scheme} scheme, which has"
                f" {', '.join(_of(kind))}"
            )
        return registered or next((name for name in _of(kind) if WALL_MODELS[name] == item), item)

    return PlainValidator(reader)


def _of(kind: type[AnyWallModel]) -> list[str]:
    """The names of the wall models of a kind."""
    return [name for name in WALL_MODELS if isinstance(WALL_MODELS[name], kind)]


def _name_of_walls(given: str, kind: type[AnyWallModel]) -> str:
    """The registered name of a wall model.

    Raises:
        SphearError: there is none, with the nearest of the kind.
    """
    try:
        return WALL_MODELS.name(given)
    except SphearError:
        aliases = [alias for name in _of(kind) for alias in WALL_MODELS.aliases(name)]
        raise unknown(WALL_MODELS.kind, given, _of(kind), aliases, "the setting walls") from None


WRITTEN = PlainSerializer(text, return_type=str, when_used="json")

Term = Annotated[str | ViscousTerm, _as_given(VISCOSITY, ViscousTerm, arguments.read_viscosity), WRITTEN]
CorrectionSetting = Annotated[str | Correction, _as_given(CORRECTIONS, Correction), WRITTEN]
KernelSetting = Annotated[str | Kernel, _as_given(KERNELS, Kernel), WRITTEN]
ShiftingSetting = Annotated[str | ShiftingMethod, _by_name(SHIFTING, ShiftingMethod), WRITTEN]
WallModelSetting = Annotated[str | WallModel, _walls(WallModel, "incompressible"), WRITTEN]
ExplicitWallModelSetting = Annotated[str | ExplicitWallModel, _walls(ExplicitWallModel, "explicit"), WRITTEN]
IntegratorSetting = Annotated[str | Integrator, _by_name(INTEGRATORS, Integrator), WRITTEN]
PreconditionerSetting = Annotated[str | Preconditioner, _by_name(PRECONDITIONERS, Preconditioner), WRITTEN]


def _equation(value: Any) -> Any:
    """The default ideal gas by its name; only names and objects."""
    if not isinstance(value, str | Barotropic | IdealGas):
        raise SphearError(
            "the setting equation_of_state should be 'batchelor_tait', 'linear', 'ideal_gas' or an object of the class"
            f" Barotropic or IdealGas, not {text(value)}"
        )
    return "ideal_gas" if value == IdealGas() else value


def _extension(name: str) -> str:
    """The registered name of an equation that an extension has named, of the density alone.

    Raises:
        ValueError: there is none.
    """
    registered = EQUATIONS_OF_STATE.name(name)
    if registered in EQUATIONS_OF_STATE.published or not issubclass(EQUATIONS_OF_STATE[registered], Barotropic):
        raise ValueError(f"flows take no equation of state named {name!r}")
    return registered


EquationSetting = Annotated[
    Literal["batchelor_tait", "linear", "ideal_gas"]
    | InstanceOf[Barotropic]
    | InstanceOf[IdealGas]
    | Annotated[str, AfterValidator(_extension)],
    BeforeValidator(_equation),
    WRITTEN,
]
