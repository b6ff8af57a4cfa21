"""A viscous term from a function, the weight of its Laplacian."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from types import FunctionType
from typing import Any

from sphear.algebra import Scalar, Vector
from sphear.corrections import Correction
from sphear.errors import SphearError
from sphear.kernels import Kernel
from sphear.viscosity import LaplacianTerm

Weight = Callable[[Kernel, Correction, Any, Vector, Scalar], Scalar]
PARAMETERS = "kernel, correction, own, d, r2"


@cache
def of_weight(function: FunctionType) -> LaplacianTerm:
    """The viscous term lap f_i = sum_j V_j w_ij (f_j - f_i) of a function that gives w_ij.

    The term takes the place of the function in its module. It has the function as an attribute, by which both are
    pickled.

    Raises:
        SphearError: the function does not take the five arguments of a weight.
    """
    try:
        inspect.signature(function).bind(*PARAMETERS.split(", "))
    except TypeError:
        raise SphearError(
            f"the function {function.__name__} is to give the weight w_ij of a viscous term, so its arguments are"
            f" ({PARAMETERS})"
        ) from None

    def weight(self: object, kernel: Kernel, correction: Correction, own: Any, d: Vector, r2: Scalar) -> Scalar:
        return function(kernel, correction, own, d, r2)

    name = function.__qualname__
    function.__qualname__ = f"{name}.function"
    members = {
        "__module__": function.__module__,
        "__qualname__": name,
        "__doc__": function.__doc__,
        "__reduce__": lambda self: (of_weight, (function,)),
        "function": staticmethod(function),
        "weight": weight,
    }
    kind: Any = type(function.__name__, (LaplacianTerm,), members)
    term: LaplacianTerm = dataclass(frozen=True, repr=False)(kind)()
    return term
