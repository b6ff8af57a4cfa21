"""The patch test: how exactly the viscous terms reproduce the Laplacian of a field that is known."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field

from sphear.cases.errors import PatchErrors, patch_errors
from sphear.cases.fields import Field as ScalarField
from sphear.cases.fields import field as scalar_field
from sphear.cases.lattice import Lattice, lattice
from sphear.cases.stream import stream_velocity
from sphear.checked import checked
from sphear.engine.threads import thread_count
from sphear.errors import SphearError, quoted
from sphear.names import unknown
from sphear.operators import Particles, arguments
from sphear.operators.input_checks import NoNeighboursError, check_isolated
from sphear.operators.particles import needing_neighbours, too_few_neighbours
from sphear.operators.scaling import TooLargeError
from sphear.progress import no_progress
from sphear.schemes.objects import CorrectionSetting, KernelSetting, Term, plain, text
from sphear.viscosity import VISCOSITY, ViscousTerm

Array = np.ndarray[Any, Any]


class PatchTest(BaseModel):
    """The settings of a patch test on the unit square or cube.

    Attributes:
        viscosity: the viscous terms, by names or aliases or as objects; one given twice counts once.
        sizes: particles a side, each giving one spacing dx = 1 / size; one given twice counts once.
        field: name of a field or an expression of x, y, z.
        velocity: act on the divergence-free velocity whose stream function the field is, instead of on the field
            itself; the terms whose pair force is radial can do nothing else.
        kernel: name of a kernel, or an object with its own h.
        h_over_dx: smoothing length over particle spacing; None gives a support of 3.14 dx.
        correction: consistency correction of the kernel, a name or an object; a term with its own takes no other.
        dimension: of space; particles fill a square or a cube.
        jitter: random displacement of the particles along each axis, jitter (R - 1/2) dx with R uniform in (0, 1).
        seed: of the first set of positions.
        seeds: sets of positions, whose errors are averaged.
        edges: "continued" sets particles beyond the edges too; "truncated" leaves the square alone in space.
        samples: "interior" takes the particles whose support lies inside the square, "all" those of the whole square.
        fallback: where a particle has too few neighbours for a correction or a fit, "uncorrected" takes the term
            without correction, or `morris` for a term with its own, "nan" gives no number; None refuses.
        precision: of the sums.
        threads: None takes all processors for many particles, one for few.

    Raises:
        SphearError: a setting is unknown or wrong.

    Examples:
        >>> import sphear
        >>> rows = sphear.PatchTest(viscosity=("fatehi_manzari",), sizes=(20, 40)).rows()
        >>> [(row["particles"], row["l1"] < 0.01) for row in rows]
        [(20, True), (40, True)]
        >>> round(rows[-1]["order"])
        2
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    viscosity: tuple[Term, ...] = Field(default=("morris",), min_length=1)
    sizes: tuple[Annotated[int, Field(ge=1, le=1_000_000)], ...] = Field(default=(20, 40, 60, 80, 100), min_length=1)
    field: str = "quartic"
    velocity: bool = False
    kernel: KernelSetting = "cubic_spline"
    h_over_dx: float | None = Field(default=None, ge=1e-6, le=1e6)
    correction: CorrectionSetting = "none"
    dimension: Literal[2, 3] = 2
    jitter: float = Field(default=0.0, ge=0, le=1)
    seed: int = Field(default=0, ge=0)
    seeds: int = Field(default=1, ge=1)
    edges: Literal["continued", "truncated"] = "continued"
    samples: Literal["interior", "all"] = "interior"
    fallback: Literal["uncorrected", "nan"] | None = None
    precision: Literal["float64", "float32"] = "float64"
    threads: int | None = Field(default=None, ge=1)

    if not TYPE_CHECKING:  # type checkers know the settings by the fields

        def __init__(self, **settings: Any) -> None:
            for key in settings:
                if key not in type(self).model_fields:
                    raise unknown("setting", key, type(self).model_fields)
            with checked("the setting "):
                super().__init__(**settings)

    def rows(self, progress: Callable[[str], None] = no_progress) -> list[dict[str, Any]]:
        """One row a term and size: the errors, averaged over the seeds, and the order from the size before.

        Args:
            progress: told what is being computed.

        Raises:
            SphearError: an unknown name, a field or expression without a value somewhere, too few neighbours.
        """
        terms = {text(plain(name, VISCOSITY)): arguments.read_viscosity(name) for name in self.viscosity}
        exact_field = scalar_field(self.field, self.dimension)
        for term in terms.values():
            arguments.read_correction(self.correction, term)
            if term.radial and not self.velocity:
                raise SphearError(
                    f"viscosity {term.name!r} cannot act on a scalar field, because its pair force depends on the"
                    f" velocity along the line of centres: let the patch test act on a velocity (--velocity)"
                )
        errors = {
            (name, size): PatchErrors.mean(error)
            for size in dict.fromkeys(self.sizes)
            for name, error in self._at(size, terms, exact_field, progress).items()
        }
        return [row for name in terms for row in self._of_term(name, errors)]

    def _of_term(self, name: str, errors: dict[tuple[str, int], PatchErrors]) -> Iterator[dict[str, Any]]:
        before: tuple[int, PatchErrors] | None = None
        for size in dict.fromkeys(self.sizes):
            error = errors[name, size]
            order = None
            if before is not None and min(error.l1, before[1].l1) > 0:
                order = math.log(before[1].l1 / error.l1) / math.log(size / before[0])
            yield {"viscosity": name, "particles": size, "dx": 1 / size, **error.as_dict(), "order": order}
            before = size, error

    def _at(
        self, size: int, terms: dict[str, ViscousTerm], exact_field: ScalarField, progress: Callable[[str], None]
    ) -> dict[str, list[PatchErrors]]:
        kernel = arguments.read_kernel(self.kernel, self.h_over_dx, 1.0 / size)
        reach = math.ceil(kernel.radius * size - 1e-9)  # intervals that a support covers
        if self.samples == "interior" and size < 2 * reach:
            raise SphearError(
                f"size {size} is too small: no particle has its support of {reach} spacings inside the square; "
                f"sizes must be at least {2 * reach}, or h_over_dx smaller"
            )
        # first derivatives of first derivatives need their neighbours' neighbours
        layers = 2 * reach + 1 if self.edges == "continued" else 0
        errors: dict[str, list[PatchErrors]] = {name: [] for name in terms}
        for seed in range(self.seed, self.seed + (self.seeds if self.jitter else 1)):
            progress(f"{size} particles a side" + (f", seed {seed}" if self.jitter else ""))
            grid = lattice(size, self.dimension, layers=layers, jitter=self.jitter, seed=seed)
            sample = np.flatnonzero(grid.inside >= (reach if self.samples == "interior" else 0))
            particles = Particles.read(
                grid.positions,
                kernel=kernel,
                volumes=grid.volume,
                threads=thread_count(self.threads, len(grid.positions)),
                precision=self.precision,
            )
            for name, term in terms.items():
                computed, exact = self._laplacians(particles, term, exact_field, grid, sample)
                errors[name].append(patch_errors(computed, exact))
        return errors

    def _laplacians(
        self, particles: Particles, term: ViscousTerm, exact_field: ScalarField, grid: Lattice, sample: Array
    ) -> tuple[Array, Array]:
        """Computed and exact Laplacian at the sample, (M, k)."""
        correction = arguments.read_correction(self.correction, term)
        if self.velocity:
            values, exact = stream_velocity(exact_field, grid.positions, grid.positions[sample])
            ones = np.ones(len(values))

            def compute(fallback: Literal["uncorrected", "nan"] | None) -> Array:
                return particles.viscous_acceleration(values, ones, ones, term, correction, fallback)
        else:
            values = exact_field.value(grid.positions)[:, None]
            exact = exact_field.laplacian(grid.positions[sample])[:, None]

            def compute(fallback: Literal["uncorrected", "nan"] | None) -> Array:
                return particles.laplacian(values, term, correction, fallback)

        def tell() -> None:
            neighbours, positions = particles.neighbours, grid.positions[sample]
            alone = np.flatnonzero(np.isin(sample, neighbours.alone))
            check_isolated(positions, alone, neighbours.support, "h_over_dx", warn=self.fallback is None)

        too_large = f"the sums over field {quoted(self.field)} are too large for {self.precision} numbers"
        # particles beyond the sample may lack neighbours; those of the sample may not, unless the user says so
        try:
            result = compute("nan" if self.fallback is None else self.fallback)[sample]
        except TooLargeError:
            raise SphearError(too_large) from None
        except NoNeighboursError:
            tell()
            raise
        lacking = np.isnan(result).any(axis=1)
        needs_neighbours = term.own_correction or correction.name != "none"
        if lacking.any() and not needs_neighbours:
            raise SphearError(too_large)
        if lacking.all() or (lacking.any() and self.fallback is None):
            what = needing_neighbours(term, correction)
            raise too_few_neighbours(
                np.flatnonzero(lacking), grid.positions[sample], what, "at", "h_over_dx", self.fallback
            )
        if not lacking.any():
            tell()
        return result[~lacking], exact[~lacking]
