"""The operators as functions of NumPy arrays: Laplacian, viscous acceleration, gradient, interpolation."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from sphear.corrections import Correction
from sphear.errors import SphearError
from sphear.kernels import Kernel
from sphear.neighbours import Domain, Neighbours
from sphear.operators import arguments
from sphear.operators.interpolation import interpolated
from sphear.operators.particles import Fallback, Particles
from sphear.viscosity import ViscousTerm

Array = np.ndarray[Any, Any]


def laplacian(
    positions: ArrayLike,
    values: ArrayLike,
    *,
    viscosity: str | ViscousTerm = "morris",
    kernel: str | Kernel = "cubic_spline",
    h_over_dx: float | None = None,
    spacing: float | None = None,
    correction: str | int | Correction = "none",
    volumes: ArrayLike | None = None,
    domain: Domain | None = None,
    fallback: Fallback | None = None,
    precision: str = "float64",
    threads: int | None = None,
) -> Array:
    """The Laplacian of a field carried by particles, as a viscous term computes it.

    lap f_i = sum_j V_j w_ij (f_j - f_i), with the weights of the term; `sphear show viscosity NAME` shows its formula.

    Args:
        positions: (N, d), in any unit of length, d = 1, 2 or 3.
        values: (N,) or (N, k), the field or fields.
        viscosity: name, alias (a paper's label too) or object of a term that is a Laplacian of each component.
        kernel: by name, with `h_over_dx`, or an object such as `CubicSpline(h)`.
        h_over_dx: smoothing length over particle spacing; default: a support of 3.14 dx, about 30 neighbours in 2-D.
        spacing: dx; default: from the volumes, a fully periodic domain, or how near the particles are to each other.
        correction: "none", "shepard" (level 0), "bonet_lok" (level 1), "renormalised", or an object.
        volumes: (N,) or one number; default: V_i = 1 / sum_j W_ij.
        domain: a box with periodic axes; default: open space.
        fallback: what to do where a particle has too few neighbours for a correction or a fit: "uncorrected" (the term
            without correction, or `morris` for a term with its own), "nan", or (default) refuse.
        precision: "float64" or "float32", of the sums.
        threads: default: all processors for many particles, one for few.

    Returns:
        An array of the shape of `values`, in units of value over length squared.

    Raises:
        SphearError: unknown names, shapes that disagree, values that are not finite or no plain numbers (masked, with
            units, in the order of an index), coincident particles, sizes that are not positive, particles none of which
            has a neighbour, more memory than half of what is free; TooFewNeighboursError where a correction or a fit
            cannot be computed.

    Warns:
        SphearWarning: of particles without neighbours where no fallback is chosen, and of volumes over which the
            kernel does not sum to one.

    Examples:
        >>> import numpy as np
        >>> import sphear
        >>> positions = np.argwhere(np.ones((20, 20))) / 20
        >>> print(sphear.laplacian(positions, positions[:, 0] ** 2, spacing=0.05)[210].round(1))
        2.0
    """
    particles = Particles.read(
        positions, kernel=kernel, h_over_dx=h_over_dx, spacing=spacing, volumes=volumes, domain=domain,
        threads=threads, precision=precision,
    )  # fmt: skip
    term = arguments.read_viscosity(viscosity)
    field = arguments.read_field(values, "values", len(particles.positions))
    result = particles.laplacian(field, term, arguments.read_correction(correction, term), fallback)
    return result.reshape(np.shape(values))


def viscous_acceleration(
    positions: ArrayLike,
    velocities: ArrayLike,
    *,
    dynamic_viscosity: ArrayLike = 1.0,
    density: ArrayLike = 1.0,
    viscosity: str | ViscousTerm = "morris",
    kernel: str | Kernel = "cubic_spline",
    h_over_dx: float | None = None,
    spacing: float | None = None,
    correction: str | int | Correction = "none",
    volumes: ArrayLike | None = None,
    domain: Domain | None = None,
    fallback: Fallback | None = None,
    precision: str = "float64",
    threads: int | None = None,
) -> Array:
    """The viscous acceleration (1/rho) div tau of a velocity field, by any viscous term.

    Args:
        positions: (N, d).
        velocities: (N, d), in units of length over time.
        dynamic_viscosity: mu, one number or (N,), in units of density times length squared over time; kinematic
            viscosity nu is given as mu = nu rho.
        density: rho, one number or (N,).
        viscosity: name, alias or object of any viscous term. Where the viscosity varies, terms differ in how much of
            div(mu grad u) + (grad u)^T grad mu they have; their cards say it. Terms that are a Laplacian of each
            component have the first part, by the mean viscosity of two particles; `takeda` is refused.
        kernel, h_over_dx, spacing, correction, volumes, domain, fallback, precision, threads: as in `laplacian`.

    Returns:
        (N, d), in units of length over time squared.

    Raises:
        SphearError: as `laplacian`.

    Examples:
        >>> import numpy as np
        >>> import sphear
        >>> positions = np.argwhere(np.ones((20, 20))) / 20
        >>> u = np.stack((positions[:, 1] ** 2, np.zeros(400)), axis=1)
        >>> print(sphear.viscous_acceleration(positions, u, dynamic_viscosity=0.01, spacing=0.05)[210, 0].round(3))
        0.02
    """
    particles = Particles.read(
        positions, kernel=kernel, h_over_dx=h_over_dx, spacing=spacing, volumes=volumes, domain=domain,
        threads=threads, precision=precision,
    )  # fmt: skip
    count, dimension = particles.positions.shape
    term = arguments.read_viscosity(viscosity)
    velocity = arguments.read_field(velocities, "velocities", count)
    if velocity.shape[1] != dimension:
        raise SphearError(
            f"velocities must have the shape ({count}, {dimension}) of the positions, not {velocity.shape}"
        )
    return particles.viscous_acceleration(
        velocity,
        arguments.read_property(dynamic_viscosity, "dynamic_viscosity", count),
        arguments.read_property(density, "density", count),
        term,
        arguments.read_correction(correction, term),
        fallback,
    )


def gradient(
    positions: ArrayLike,
    values: ArrayLike,
    *,
    of_differences: bool = True,
    kernel: str | Kernel = "cubic_spline",
    h_over_dx: float | None = None,
    spacing: float | None = None,
    correction: str | int | Correction = "none",
    volumes: ArrayLike | None = None,
    domain: Domain | None = None,
    fallback: Fallback | None = None,
    precision: str = "float64",
    threads: int | None = None,
) -> Array:
    """The gradient of a field, sum_j V_j (f_j - f_i) grad W_ij, with a corrected kernel gradient where asked for.

    Args:
        positions: (N, d).
        values: (N,) or (N, k).
        of_differences: else the sum over f_j itself (Basa, Quinlan & Lastiwka 2009, eq. 2), which differs without a
            correction of order zero.
        kernel, h_over_dx, spacing, correction, volumes, domain, fallback, precision, threads: as in `laplacian`.

    Returns:
        (N, d) or (N, k, d).

    Raises:
        SphearError: as `laplacian`.

    Examples:
        >>> import sphear
        >>> corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]
        >>> print(sphear.gradient(corners, [1.0, 2.0, 3.0], spacing=1.0, correction="renormalised")[0].round(6))
        [1. 2.]
    """
    particles = Particles.read(
        positions, kernel=kernel, h_over_dx=h_over_dx, spacing=spacing, volumes=volumes, domain=domain,
        threads=threads, precision=precision,
    )  # fmt: skip
    chosen = arguments.read_correction(correction)
    field = arguments.read_field(values, "values", len(particles.positions))
    result = particles.gradient(field, chosen, of_differences, fallback)
    return result.reshape(*np.shape(values), particles.positions.shape[1])


def interpolate(
    positions: ArrayLike,
    values: ArrayLike,
    *,
    at: ArrayLike | None = None,
    kernel: str | Kernel = "cubic_spline",
    h_over_dx: float | None = None,
    spacing: float | None = None,
    correction: str | int | Correction = "none",
    volumes: ArrayLike | None = None,
    domain: Domain | None = None,
    fallback: Fallback | None = None,
    precision: str = "float64",
    threads: int | None = None,
) -> Array:
    """A field at any points, sum_j V_j f_j W_ij, divided by sum_j V_j W_ij with a correction of order zero.

    With correction="moving_least_squares" (or "linear"), the value of the plane that fits the particles within the
    support best, each with the weight V_j W_ij: exact for linear fields, of second order for smooth ones, also near
    edges and on disordered particles.

    Args:
        positions: (N, d).
        values: (N,) or (N, k).
        at: (M, d), where; default: at the particles.
        kernel, h_over_dx, spacing, correction, volumes, domain, fallback, precision, threads: as in `laplacian`;
            "bonet_lok" has the same value as "shepard", "renormalised" the same as "none".

    Returns:
        (M,) or (M, k); NaN where a corrected value is asked for and no particle is within the kernel's support.

    Raises:
        SphearError: as `laplacian`; TooFewNeighboursError where a point has particles within the support, but too few
            or too much in one line for a plane.

    Examples:
        >>> import sphear
        >>> corners, inside = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)], [(0.5, 0.25)]
        >>> print(sphear.interpolate(corners, [1.0, 2.0, 3.0], at=inside, spacing=1.0, correction="linear").round(6))
        [2.]
    """
    particles = Particles.read(
        positions, kernel=kernel, h_over_dx=h_over_dx, spacing=spacing, volumes=volumes, domain=domain,
        threads=threads, precision=precision,
    )  # fmt: skip
    count = len(particles.positions)
    field = arguments.read_field(values, "values", count)
    chosen = arguments.read_correction(correction, of_values=True)
    points = particles.positions if at is None else arguments.read_positions(at, domain, "at")
    if points.shape[1] != particles.positions.shape[1]:
        raise SphearError(f"at has {points.shape[1]} axes but positions has {particles.positions.shape[1]}")
    neighbours = Neighbours(particles.positions, particles.kernel.radius, domain, threads=threads, at=points)
    result = interpolated(particles, neighbours, points, field, chosen, fallback)
    return result.reshape(len(points), *np.shape(values)[1:])
