"""Reads what a user passes to an operator: arrays, names or objects, into what the engine takes."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from sphear.corrections import CORRECTIONS, VALUE_CORRECTIONS, Correction, MovingLeastSquares
from sphear.engine.sweep import sweep
from sphear.errors import SphearError
from sphear.interactions import NumberDensity
from sphear.kernels import KERNELS, Kernel
from sphear.neighbours import Domain, Neighbours
from sphear.operators.spacing import spacing_of
from sphear.reading import positive_number, real_numbers
from sphear.viscosity import VISCOSITY, ViscousTerm

Array = np.ndarray[Any, Any]
Precision = Literal["float64", "float32"]

SUPPORT_OVER_DX = 2 / 0.637  # about 30 neighbours in 2-D (Basa, Quinlan & Lastiwka 2009, section 6)


def read_positions(positions: ArrayLike, domain: Domain | None, name: str = "positions") -> Array:
    """Positions as an array (N, d) of finite numbers, d = 1 to 3, that agrees with the domain."""
    array = real_numbers(positions, name)
    if array.ndim != 2 or array.shape[1] not in (1, 2, 3):
        raise SphearError(f"{name} must have the shape (N, d) with d = 1, 2 or 3, not {array.shape}")
    if not len(array):
        raise SphearError(f"{name} must hold at least one place")
    _finite(array, name)
    if not (domain is None or isinstance(domain, Domain)):
        raise SphearError(f"the domain must be a Domain or None, not {domain!r}")
    if domain is not None and domain.dimension != array.shape[1]:
        raise SphearError(f"the domain has {domain.dimension} axes but {name} has {array.shape[1]}")
    return array


def read_field(values: ArrayLike, name: str, count: int) -> Array:
    """A field as an array (N, k) of finite numbers."""
    array = real_numbers(values, name)
    if array.ndim not in (1, 2) or len(array) != count:
        raise SphearError(
            f"{name} must have the shape ({count},) or ({count}, k) as the positions do, not {array.shape}"
        )
    _finite(array, name)
    return array.reshape(count, -1)


def read_property(values: ArrayLike, name: str, count: int) -> Array:
    """A positive property of each particle, (N,), from one number for all or one for each."""
    array = real_numbers(values, name)
    if array.shape not in ((), (1,), (count,)):
        raise SphearError(
            f"{name} must be one number or have the shape ({count},) as the positions do, not {array.shape}"
        )
    _finite(array, name)
    if not (array > 0).all():
        raise SphearError(f"{name} must be positive, but the least is {array.min():g}")
    return np.ascontiguousarray(np.broadcast_to(array.reshape(-1), (count,)))


def read_viscosity(viscosity: str | ViscousTerm) -> ViscousTerm:
    """A viscous term by name, alias or as an object, whose attributes are all fields: the engine knows no others."""
    if not isinstance(viscosity, ViscousTerm):
        return VISCOSITY[viscosity]
    if hidden := sorted(set(vars(viscosity)) - {field.name for field in fields(viscosity)}):
        raise SphearError(
            f"the viscous term {type(viscosity).__name__} has {hidden[0]}, which is no field of it: make its class a"
            " dataclass by @dataclass(frozen=True) and name it there"
        )
    return viscosity


def read_correction(
    correction: str | int | Correction, term: ViscousTerm | None = None, *, of_values: bool = False
) -> Correction:
    """A correction by name, alias, level (0, 1) or as an object; none beside a term that has its own.

    With `of_values` also those that have values only.
    """
    if not isinstance(correction, Correction) and str(correction).lower().replace("-", "_") in VALUE_CORRECTIONS:
        correction = VALUE_CORRECTIONS[str(correction).lower().replace("-", "_")]
    chosen = correction if isinstance(correction, Correction) else CORRECTIONS[str(correction)]
    if isinstance(chosen, MovingLeastSquares) and not of_values:
        raise SphearError(
            f"correction {chosen.name!r} is of values only, for interpolate: derivatives of linear fields are exact"
            f" with 'bonet_lok' or 'renormalised'"
        )
    if term is not None and term.own_correction and chosen.name != "none":
        raise SphearError(
            f"viscosity {term.name!r} carries its own correction and takes no other: correction must be 'none',"
            f" not {chosen.name!r}"
        )
    return chosen


def read_kernel(kernel: str | Kernel, h_over_dx: float | None, spacing: float) -> Kernel:
    """A kernel object as it is, or a kernel by name with h = h_over_dx times the particle spacing."""
    if isinstance(kernel, Kernel):
        if h_over_dx is not None:
            raise SphearError(f"{kernel!r} has its own h: h_over_dx goes with a kernel's name")
        return kernel
    kind = KERNELS[kernel]
    ratio = SUPPORT_OVER_DX / kind.support if h_over_dx is None else positive_number(h_over_dx, "h_over_dx")
    return kind(ratio * spacing)


def read_spacing(spacing: float | None, positions: Array, volumes: Array | None, domain: Domain | None) -> float:
    """The particle spacing dx: as given, or from the volumes, the periodic domain, or how near the particles are."""
    count, dimension = positions.shape
    if spacing is not None:
        return positive_number(spacing, "the particle spacing")
    if volumes is not None:
        return float(volumes.mean() ** (1 / dimension))
    if domain is not None and len(domain.periodic_axes) == dimension:
        return float((np.prod(np.subtract(domain.upper, domain.lower)) / count) ** (1 / dimension))
    return spacing_of(positions if domain is None else domain.wrapped(positions))


def particle_volumes(kernel: Kernel, neighbours: Neighbours, each_pair_once: bool = False) -> Array:
    """V_i = 1 / sum_j W_ij, the volumes that the particles' own density implies."""
    return 1.0 / sweep(NumberDensity(kernel), neighbours, each_pair_once=each_pair_once)[:, 0]


def read_precision(precision: str) -> str:
    """The precision of sums: "float64" or "float32"."""
    if precision not in ("float64", "float32"):
        raise SphearError(f"precision must be 'float64' or 'float32', not {precision!r}")
    return precision


def _finite(array: Array, name: str) -> None:
    if np.isfinite(array).all():
        return
    rows = array.reshape(len(array) if array.ndim else 1, -1)
    bad = np.flatnonzero(~np.isfinite(rows).all(axis=1))
    raise SphearError(f"{name} must be finite, but {len(bad)} of {len(rows)} are not, first particle {bad[0]}")
