"""Particles with their neighbours and volumes: what all operators of one call are applied to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from sphear.corrections import Correction, NoCorrection
from sphear.errors import SphearError, TooFewNeighboursError
from sphear.interactions import Gradient
from sphear.kernels import Kernel
from sphear.neighbours import Domain, Neighbours
from sphear.operators import arguments
from sphear.operators.input_checks import check_isolated, check_volumes
from sphear.operators.pipeline import Operation, run
from sphear.operators.scaling import ScaledField, ScaledParticles, unscaled
from sphear.viscosity import ViscousTerm, uncorrected, with_varying_viscosity
from sphear.viscosity.base import LaplacianTerm

Array = np.ndarray[Any, Any]
Fallback = Literal["uncorrected", "nan"]


def _as_it_is(term: ViscousTerm) -> ViscousTerm:
    return term


def needing_neighbours(term: ViscousTerm, correction: Correction) -> str:
    """Parts of a term with a correction that are solved for at each particle, and so need enough neighbours."""
    return f"viscosity {term.name!r}" if term.own_correction else f"correction {correction.name!r}"


def too_few_neighbours(
    lacking: Array,
    positions: Array,
    what: str,
    first: str,
    larger: str,
    fallback: Fallback | None = None,
    *,
    of: str = "particles",
) -> TooFewNeighboursError:
    """The error of too few neighbours.

    Args:
        lacking: the particles that have too few.
        positions: of all particles, (N, d).
        what: needs more.
        first: words between "the first" and the place of the first that lacks them.
        larger: the setting to enlarge.
        fallback: that did not help.
        of: what lacks them.
    """
    place = ", ".join(f"{x:.6g}" for x in positions[lacking[0]])
    remedy = "" if fallback == "nan" else ", or ask for fallback 'uncorrected' or 'nan'"
    return TooFewNeighboursError(
        f"{len(lacking)} of {len(positions)} {of} have too few neighbours for {what}, the first {first} ({place}):"
        f" take a larger {larger}{remedy}"
    )


def ignores_constants(term: ViscousTerm, correction: Correction, fallback: Fallback | None) -> bool:
    """True if a constant that is added to the field changes nothing but the rounding of the result."""
    if fallback == "uncorrected" and correction.name != "none" and not ignores_constants(term, NoCorrection(), None):
        return False
    if not isinstance(term, LaplacianTerm):
        return term.radial
    # sums in several stages are over values, unless a correction makes them sums over differences
    staged = type(term).laplacian_stages is not LaplacianTerm.laplacian_stages
    return term.of_differences(correction) and (correction.zeroth_order or not staged)


@dataclass(frozen=True, repr=False)
class Particles:
    """Particles whose neighbours are known; made once, operated on many times.

    Attributes:
        positions: places of the particles, (N, d), in lengths.
        kernel: with its smoothing length.
        neighbours: the pairs within the kernel's support.
        volumes: of the particles, (N,), in lengths^d.
        precision: "float64" or "float32", of the sums.
        each_pair_once: compute both sides of a pair together where nothing is prepared for either: half the pair list,
            and faster for the costlier terms, such as the radial ones (`benchmarks/`).
    """

    positions: Array
    kernel: Kernel
    neighbours: Neighbours
    volumes: Array
    precision: str = "float64"
    each_pair_once: bool = False

    def __repr__(self) -> str:
        """The number of particles, their dimension, kernel and precision."""
        count, dimension = self.positions.shape
        return f"<Particles: {count} in {dimension}-D, {self.kernel!r}, {self.precision}>"

    @classmethod
    def read(
        cls,
        positions: ArrayLike,
        *,
        kernel: str | Kernel = "cubic_spline",
        h_over_dx: float | None = None,
        spacing: float | None = None,
        volumes: ArrayLike | None = None,
        domain: Domain | None = None,
        threads: int | None = None,
        precision: str = "float64",
        each_pair_once: bool = False,
    ) -> Particles:
        """Check what a user gives, and find the neighbours; see `sphear.laplacian` for the arguments."""
        places = arguments.read_positions(positions, domain)
        given = None if volumes is None else arguments.read_property(volumes, "volumes", len(places))
        if isinstance(kernel, Kernel):
            if spacing is not None:
                raise SphearError(f"{kernel!r} has its own h: spacing goes with a kernel's name")
            chosen = arguments.read_kernel(kernel, h_over_dx, 1.0)
        else:
            dx = arguments.read_spacing(spacing, places, given, domain)
            chosen = arguments.read_kernel(kernel, h_over_dx, dx)
        neighbours = Neighbours(places, chosen.radius, domain, threads=threads, each_pair_once=each_pair_once)
        if given is not None:
            check_volumes(given, chosen, neighbours)
        if given is None:
            given = arguments.particle_volumes(chosen, neighbours, each_pair_once)
        return cls(places, chosen, neighbours, given, arguments.read_precision(precision), each_pair_once)

    @cached_property
    def in_units(self) -> ScaledParticles:
        """The same with lengths of order one, where the precision of the sums asks for it."""
        return ScaledParticles.of(self.kernel, self.neighbours, self.volumes, self.precision)

    def laplacian(
        self, values: Array, term: ViscousTerm, correction: Correction, fallback: Fallback | None = None
    ) -> Array:
        """The Laplacian of each column of values (N, k)."""
        if not isinstance(term, LaplacianTerm):
            raise SphearError(
                f"viscosity {term.name!r} cannot act on scalar fields: its pair force has a part along the line of"
                f" centres, so it needs a velocity; use viscous_acceleration, or a term that is a Laplacian of each"
                f" component"
            )
        shifted = ignores_constants(term, correction, fallback)
        field = ScaledField.of(values, self.precision, shifted=shifted)
        result = self._apply(term, correction, {"values": field.values}, fallback, "laplacian_stages", self.in_units)
        return unscaled(result, field.size / self.in_units.unit**2)

    def viscous_acceleration(
        self,
        velocities: Array,
        dynamic_viscosity: Array,
        density: Array,
        term: ViscousTerm,
        correction: Correction,
        fallback: Fallback | None = None,
    ) -> Array:
        """The viscous acceleration (1/rho) div tau of each particle, (N, d)."""
        # one that is constant asks for no neighbour's
        varies = bool((dynamic_viscosity != dynamic_viscosity[:1]).any())
        adapted = with_varying_viscosity if varies else _as_it_is
        stages = "acceleration_stages"
        if not term.homogeneous:  # a term with constants in the user's units
            units = ScaledParticles(self.kernel, self.neighbours, self.volumes, 1.0)
            fields = {"velocity": velocities, "dynamic_viscosity": dynamic_viscosity, "density": density}
            return unscaled(self._apply(term, correction, fields, fallback, stages, units, adapted), 1.0)
        shifted = ignores_constants(term, correction, fallback)
        u = ScaledField.of(velocities, self.precision, shifted=shifted, together=True)
        mu, rho = (ScaledField.of(x[:, None], self.precision, shifted=False) for x in (dynamic_viscosity, density))
        fields = {"velocity": u.values, "dynamic_viscosity": mu.values[:, 0], "density": rho.values[:, 0]}
        result = self._apply(term, correction, fields, fallback, stages, self.in_units, adapted)
        return unscaled(result, u.size * (mu.size / rho.size) / self.in_units.unit**2)

    def gradient(
        self, values: Array, correction: Correction, of_differences: bool = True, fallback: Fallback | None = None
    ) -> Array:
        """The gradient of each column of values (N, k), (N, k d)."""
        units = self.in_units
        shifted = of_differences or (correction.zeroth_order and fallback != "uncorrected")
        field = ScaledField.of(values, self.precision, shifted=shifted)

        def operation(c: Correction) -> Operation:
            return Operation((Gradient(units.kernel, c, of_differences),), c.preparation(units.kernel))

        what = f"correction {correction.name!r}"
        fields = {"values": field.values}
        result = self.applied(operation(correction), operation(NoCorrection()), fields, fallback, what, units)
        return unscaled(result, np.repeat(field.size / units.unit, self.neighbours.dimension))

    def _apply(
        self,
        term: ViscousTerm,
        correction: Correction,
        fields: dict[str, Array],
        fallback: Any,
        stages: str,
        units: ScaledParticles,
        adapted: Callable[[ViscousTerm], ViscousTerm] = _as_it_is,
    ) -> Array:
        def operation(t: ViscousTerm, c: Correction) -> Operation:
            return Operation(getattr(adapted(t), stages)(units.kernel, c), t.preparation(units.kernel, c))

        what = needing_neighbours(term, correction)
        return self.applied(operation(term, correction), operation(*uncorrected(term)), fields, fallback, what, units)

    def applied(
        self,
        operation: Operation,
        plain: Operation,
        fields: dict[str, Array],
        fallback: Fallback | None,
        what: str,
        units: ScaledParticles,
    ) -> Array:
        """The result of an operation; where its preparation is deficient `plain` stands in, or it is refused."""
        if fallback not in (None, "uncorrected", "nan"):
            raise SphearError(f"fallback must be 'uncorrected' or 'nan', not {fallback!r}")
        outcome = run(
            operation,
            units.neighbours,
            {"volume": units.volumes, **fields},
            plain=None if fallback is None else plain,
            each_pair_once=self.each_pair_once,
            dtype=self.precision,
        )
        lacking = outcome.deficient
        if len(lacking) and fallback is None:
            raise too_few_neighbours(lacking, self.positions, what, f"is particle {lacking[0]} at", "h")
        if fallback == "nan" and len(lacking):
            outcome.values[lacking] = np.nan
        else:
            self.check_isolated(fallback)
        return outcome.values

    def check_isolated(self, fallback: Fallback | None) -> None:
        """Refuse particles none of which has a neighbour; warn of some that have none, unless a fallback is chosen."""
        if len(self.positions) > 1:
            alone = self.neighbours.alone
            check_isolated(self.positions, alone, self.neighbours.support, warn=fallback is None)
