"""Decorators that give viscous terms, kernels, corrections and equations of state names."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import FunctionType
from typing import Any, Protocol, TypeVar, dataclass_transform, overload

from sphear.corrections import CORRECTIONS, Correction
from sphear.equations_of_state import EQUATIONS_OF_STATE, EquationOfState
from sphear.extensions import protocol
from sphear.extensions.registering import checked_names, register
from sphear.extensions.weights import Weight, of_weight
from sphear.kernels import KERNELS, Kernel
from sphear.names import Registry
from sphear.viscosity import VISCOSITY, LaplacianTerm, ViscousTerm

T = TypeVar("T")
TermT = TypeVar("TermT", bound="ViscousTerm | type[ViscousTerm]")
KernelT = TypeVar("KernelT", bound=type[Kernel])
CorrectionT = TypeVar("CorrectionT", bound="Correction | type[Correction]")
EquationT = TypeVar("EquationT", bound=type[EquationOfState])


class NamesTerm(Protocol):
    """A decorator of classes, objects and functions: the first two stay what they are, a function becomes a term."""

    @overload
    def __call__(self, term: TermT, /) -> TermT: ...
    @overload
    def __call__(self, term: Weight, /) -> LaplacianTerm: ...


def decorator_of(of: protocol.Protocol, registry: Registry[Any], name: str, aliases: Sequence[str]) -> Callable[[T], T]:
    """The decorator that puts what it is given into a registry, checked by its kind."""
    names = checked_names(of.decorator, name, aliases)

    def decorate(given: Any) -> Any:
        thing = of_weight(given) if of is protocol.TERM and isinstance(given, FunctionType) else given
        kind = protocol.checked(thing, of)
        register(registry, names, thing() if of.instances and isinstance(thing, type) else thing, kind)
        return thing

    return decorate


@dataclass_transform(frozen_default=True)
def viscous_term(name: str, *, aliases: Sequence[str] = ()) -> NamesTerm:
    """Give a viscous term a name, which operators, flows, sweeps and the command line take from then on.

    It decorates a class derived from `LaplacianTerm`, with a method `weight`, or from `ViscousTerm`, with a method
    `acceleration`; it makes the class a frozen dataclass if it is none, so that its annotated numbers are settings. It
    decorates a function too, `(kernel, correction, own, d, r2)`, which becomes the term whose weight it gives. An
    object of a class is named by a call: `viscous_term("mine_3")(Mine(factor=3.0))`.

    Args:
        name: of the term, found whatever the case, with '-' and ' ' read as '_'.
        aliases: other names of it.

    Returns:
        The decorator, which gives back the class or object it is given.

    Raises:
        SphearError: a name is taken, with what has it, or is no name; the class lacks a method or a default; or the
            thing is no viscous term.

    Examples:
        >>> import numpy as np
        >>> import sphear
        >>> @sphear.viscous_term("mine", aliases=("my term",))
        ... class Mine(sphear.LaplacianTerm):
        ...     factor: float = 2.0
        ...
        ...     def weight(self, kernel, correction, own, d, r2):
        ...         return -self.factor * correction.radial(kernel, own.prepared, d, r2) / r2
        ...
        >>> positions = np.argwhere(np.ones((20, 20))) / 20
        >>> lap = sphear.laplacian(positions, positions[:, 0] ** 2, spacing=0.05, viscosity="mine")
        >>> print(lap[210].round(1))  # in the middle
        2.0
    """
    decorator: Any = decorator_of(protocol.TERM, VISCOSITY, name, aliases)
    named: NamesTerm = decorator
    return named


@dataclass_transform(frozen_default=True)
def kernel(name: str, *, aliases: Sequence[str] = ()) -> Callable[[KernelT], KernelT]:
    """Give a kernel a name, which operators, flows, sweeps and the command line take from then on.

    It decorates a class derived from `Kernel` with the methods `shape`, `slope` and `curvature`, w, w'/q and w'' of
    q = r / h, and the attributes `support`, in smoothing lengths, and `sigma`, the factors in 1-D to 3-D that make the
    integral one.

    Args:
        name: of the kernel, found whatever the case, with '-' and ' ' read as '_'.
        aliases: other names of it.

    Returns:
        The decorator, which gives back the class it is given.

    Raises:
        SphearError: a name is taken, with what has it, or is no name; the class lacks a method or an attribute; or the
            thing is no class of a kernel.

    Examples:
        >>> import sphear
        >>> @sphear.kernel("mine")
        ... class Mine(sphear.WendlandC2):
        ...     pass
        ...
        >>> print(sphear.Incompressible(kernel="mine"))
        Incompressible(kernel='mine')
    """
    return decorator_of(protocol.KERNEL, KERNELS, name, aliases)


@dataclass_transform(frozen_default=True)
def correction(name: str, *, aliases: Sequence[str] = ()) -> Callable[[CorrectionT], CorrectionT]:
    """Give a consistency correction a name, which operators, flows, sweeps and the command line take from then on.

    It decorates a class derived from `Correction` with the methods `preparation`, what is summed up beforehand, and
    `value` and `gradient`, the kernel corrected by it; a few viscous terms need `hessian` too. An object of a class is
    named by a call: `correction("mine_3")(Mine(strength=3.0))`.

    Args:
        name: of the correction, found whatever the case, with '-' and ' ' read as '_'.
        aliases: other names of it.

    Returns:
        The decorator, which gives back the class or object it is given.

    Raises:
        SphearError: a name is taken, with what has it, or is no name; the class lacks a method or a default; or the
            thing is no correction.

    Examples:
        >>> import sphear
        >>> @sphear.correction("mine")
        ... class Mine(sphear.Shepard):
        ...     pass
        ...
        >>> print(sphear.Incompressible(gradient_correction="mine"))
        Incompressible(gradient_correction='mine')
    """
    return decorator_of(protocol.CORRECTION, CORRECTIONS, name, aliases)


@dataclass_transform(frozen_default=True)
def equation_of_state(name: str, *, aliases: Sequence[str] = ()) -> Callable[[EquationT], EquationT]:
    """Give an equation of state a name, found in `EQUATIONS_OF_STATE` and taken by weakly compressible flows.

    It decorates a class derived from `EquationOfState` with the methods `pressure`, `sound_speed` and `density`. Flows
    take those derived from `Barotropic`, made with the density and the speed of sound of the flow.

    Args:
        name: of the equation, found whatever the case, with '-' and ' ' read as '_'.
        aliases: other names of it.

    Returns:
        The decorator, which gives back the class it is given.

    Raises:
        SphearError: a name is taken, with what has it, or is no name; the class lacks a method or a default; or the
            thing is no class of an equation of state.

    Examples:
        >>> import sphear
        >>> @sphear.equation_of_state("mine")
        ... class Mine(sphear.Linear):
        ...     pass
        ...
        >>> sphear.EQUATIONS_OF_STATE["mine"](rho0=1.0, c0=10.0).pressure(1.5)
        50.0
    """
    return decorator_of(protocol.EQUATION, EQUATIONS_OF_STATE, name, aliases)
