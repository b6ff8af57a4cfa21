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
from sphear.viscosity import VISCOSITY, LaplacianTerm, ViscousTerm

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

    Example:
        >>> @sphear.viscous_term("mine", aliases=("my term",))
        ... class Mine(sphear.LaplacianTerm):
        ...     factor: float = 2.0
        ...
        ...     def weight(self, kernel, correction, own, d, r2):
        ...         return -self.factor * correction.radial(kernel, own.prepared, d, r2) / r2
        >>> sphear.laplacian(positions, values, viscosity="mine")
    """
    names = checked_names("viscous_term", name, aliases)

    def decorate(term: Any) -> Any:
        thing = of_weight(term) if isinstance(term, FunctionType) else term
        kind = protocol.checked(thing, protocol.TERM, "viscous_term")
        item: ViscousTerm = thing() if isinstance(thing, type) else thing
        register(VISCOSITY, names, item, kind)
        return thing

    return decorate


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

    Example:
        >>> @sphear.kernel("mine")
        ... class Mine(sphear.WendlandC2):
        ...     '''The kernel of Wendland, by a name of one's own.'''
        >>> sphear.gradient(positions, values, kernel="mine")
    """
    names = checked_names("kernel", name, aliases)

    def decorate(kind: KernelT) -> KernelT:
        item: type[Kernel] = kind
        register(KERNELS, names, item, protocol.checked(kind, protocol.KERNEL, "kernel"))
        return kind

    return decorate


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

    Example:
        >>> @sphear.correction("mine")
        ... class Mine(sphear.Shepard):
        ...     '''The correction of Shepard, by a name of one's own.'''
        >>> sphear.gradient(positions, values, correction="mine")
    """
    names = checked_names("correction", name, aliases)

    def decorate(thing: Any) -> Any:
        kind = protocol.checked(thing, protocol.CORRECTION, "correction")
        item: Correction = thing() if isinstance(thing, type) else thing
        register(CORRECTIONS, names, item, kind)
        return thing

    return decorate


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

    Example:
        >>> @sphear.equation_of_state("mine")
        ... class Mine(sphear.Linear):
        ...     '''The linear equation, by a name of one's own.'''
        >>> sphear.flow("cavity", equation_of_state="mine")
    """
    names = checked_names("equation_of_state", name, aliases)

    def decorate(kind: EquationT) -> EquationT:
        item: type[EquationOfState] = kind
        register(EQUATIONS_OF_STATE, names, item, protocol.checked(kind, protocol.EQUATION, "equation_of_state"))
        return kind

    return decorate
