"""The public operators: shapes, names, units, defaults, and what is said of every bad input."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import sphear
from sphear import (
    CORRECTIONS,
    KERNELS,
    VISCOSITY,
    CubicSpline,
    Domain,
    Gaussian,
    Morris,
    NoCorrection,
    Particles,
    Shepard,
    SphearError,
    Violeau,
    gradient,
    interpolate,
    laplacian,
    viscous_acceleration,
)
from tests.particles import Array, all_pairs, box, interior, jittered, lattice

N = 24
DX = 1.0 / N
PERIODIC = Domain((0.0, 0.0), (1.0, 1.0))
LABELS = {
    "A": "takeda", "B": "two_pass", "C": "violeau", "D": "cleary", "E": "morris",
    "VISC-01": "morris", "VISC-02": "gotoh", "VISC-03": "schwaiger", "VISC-04": "oger",
}  # fmt: skip


def wave(positions: Array) -> Array:
    return np.asarray(np.sin(2.0 * np.pi * positions[:, 0]) * np.cos(2.0 * np.pi * positions[:, 1]))


@pytest.fixture
def places() -> Array:
    """Jittered particles in the periodic unit square."""
    return jittered((N, N), 0.2, seed=0, dx=DX)


@pytest.fixture
def u(places: Array) -> Array:
    return np.stack((wave(places), -wave(places[:, ::-1])), axis=1)


# what is returned, and for which input


@pytest.mark.parametrize("count", [None, 0, 1, 5])
def test_results_have_the_shape_of_the_values(places: Array, count: int | None) -> None:
    shape = (len(places),) if count is None else (len(places), count)
    f = np.random.default_rng(0).random(shape)
    assert laplacian(places, f).shape == shape
    assert interpolate(places, f).shape == shape
    assert interpolate(places, f, at=places[:7]).shape == (7, *shape[1:])
    assert gradient(places, f).shape == (*shape, 2)


@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_every_dimension(dimension: int) -> None:
    positions = lattice((5,) * dimension)
    assert laplacian(positions, positions[:, 0]).shape == (len(positions),)
    assert gradient(positions, positions).shape == (len(positions), dimension, dimension)
    assert viscous_acceleration(positions, positions).shape == positions.shape


def test_columns_are_fields_of_their_own(places: Array, u: Array) -> None:
    together = laplacian(places, u, viscosity="schwaiger", domain=PERIODIC)
    apart = [laplacian(places, u[:, k], viscosity="schwaiger", domain=PERIODIC) for k in (0, 1)]
    np.testing.assert_allclose(together, np.stack(apart, axis=1), rtol=1e-12, atol=1e-10)


@pytest.mark.parametrize("convert", [list, tuple, np.asarray, lambda x: np.asarray(x, np.float32), lambda x: x[:]])
def test_anything_array_like_is_taken(convert: Callable[[Any], Any]) -> None:
    positions, values = [[0, 0], [1, 0], [0, 1], [1, 1]], [1, 2, 3, 4]
    expected = laplacian(np.array(positions, float), np.array(values, float), spacing=1.0)
    assert laplacian(convert(positions), convert(values), spacing=1).tolist() == expected.tolist()


def test_views_and_other_memory_orders_are_taken(places: Array) -> None:
    f = wave(places)
    expected = laplacian(places, f)
    np.testing.assert_array_equal(laplacian(np.asfortranarray(places), np.repeat(f, 2)[::2]), expected)
    np.testing.assert_array_equal(laplacian(np.repeat(places, 2, axis=0)[::2], f), expected)


def test_arguments_are_not_written_to(places: Array, u: Array) -> None:
    copies = places + 1.0, u.copy(), np.full(len(places), DX**2)
    before = [x.copy() for x in copies]
    viscous_acceleration(copies[0], copies[1], volumes=copies[2], domain=PERIODIC, dynamic_viscosity=copies[2])
    for after, expected in zip(copies, before, strict=True):
        np.testing.assert_array_equal(after, expected)


# names


@pytest.mark.parametrize("label", LABELS)
def test_terms_answer_to_the_papers_labels_in_any_case(places: Array, u: Array, label: str) -> None:
    name = LABELS[label]
    expected = viscous_acceleration(places, u, viscosity=VISCOSITY[name], domain=PERIODIC)
    for spelling in (name, label, label.lower(), name.upper()):
        found = viscous_acceleration(places, u, viscosity=spelling, domain=PERIODIC)
        np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize(
    ("names", "correction"),
    [(("shepard", "0", 0, "level 0", "Zero-Order"), Shepard()), (("none", "uncorrected", "NONE"), NoCorrection()),
     (("bonet_lok", "1", 1, "Bonet-Lok"), CORRECTIONS["bonet_lok"])],
)  # fmt: skip
def test_corrections_by_name_level_or_object(places: Array, names: tuple[Any, ...], correction: Any) -> None:
    expected = gradient(places, wave(places), correction=correction)
    for name in names:
        np.testing.assert_array_equal(gradient(places, wave(places), correction=name), expected)


@pytest.mark.parametrize("name", list(KERNELS))
def test_kernels_by_name_or_object(places: Array, name: str) -> None:
    expected = interpolate(places, wave(places), kernel=KERNELS[name](1.3 * DX), domain=PERIODIC)
    found = interpolate(places, wave(places), kernel=name.upper(), h_over_dx=1.3, spacing=DX, domain=PERIODIC)
    np.testing.assert_array_equal(found, expected)


def test_every_exported_name_is_there() -> None:
    assert set(dir(sphear)) == set(sphear.__all__)
    for name in sphear.__all__:
        assert getattr(sphear, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        sphear.nothing  # type: ignore[attr-defined]  # noqa: B018


# defaults


@pytest.mark.parametrize("name", list(KERNELS))
def test_every_kernel_reaches_as_far_by_default(name: str) -> None:
    particles = Particles.read(lattice((6, 6), dx=0.5), kernel=name)
    assert particles.kernel.radius == pytest.approx(0.5 * 2 / 0.637)


@pytest.mark.parametrize(
    ("positions", "arguments", "spacing"),
    [
        (lattice((8, 8), dx=0.3), {}, 0.3),
        (lattice((5, 5, 5), dx=0.3), {}, 0.3),
        (lattice((9, 1), dx=0.3), {}, 0.3),  # a row in the plane
        (lattice((9,), dx=0.3), {}, 0.3),
        (lattice((8, 8), dx=0.3), {"spacing": 0.2}, 0.2),
        (lattice((8, 8), dx=0.3), {"volumes": 0.16}, 0.4),
        (lattice((3, 3, 3), dx=0.3), {"volumes": np.full(27, 0.064)}, 0.4),
        (jittered((8, 8), 0.5, 0, dx=0.3), {"domain": box((8, 8), dx=0.3)}, 0.3),
        (np.zeros((1, 2)), {"domain": box((1, 1), dx=0.3)}, 0.3),
    ],
)
def test_the_spacing_is_told_from_what_is_known(positions: Array, arguments: Any, spacing: float) -> None:
    particles = Particles.read(positions, h_over_dx=2.0, **arguments)
    assert particles.kernel.h == pytest.approx(2.0 * spacing)


def test_the_spacing_of_an_oblong_lattice_is_nearly_right() -> None:
    assert Particles.read(lattice((10, 40), dx=0.3), h_over_dx=1.0).kernel.h == pytest.approx(0.3, rel=0.05)


def test_volumes_are_one_over_the_sum_of_the_kernel(places: Array) -> None:
    kernel = CubicSpline(1.5 * DX)
    found = Particles.read(places, kernel=kernel, domain=PERIODIC).volumes
    i, _, d = all_pairs(places, kernel.radius, PERIODIC)
    weights = kernel.value((d**2).sum(axis=1), 2)
    expected = 1.0 / (np.bincount(i, weights) + kernel.value_at_zero(2))
    np.testing.assert_allclose(found, expected, rtol=1e-12)
    assert found.sum() == pytest.approx(1.0, rel=0.02)


def test_a_lone_particle_has_the_volume_of_its_kernel() -> None:
    particles = Particles.read([[0.0, 0.0]], kernel=CubicSpline(1.0))
    assert particles.volumes == pytest.approx([1.0 / CubicSpline(1.0).value_at_zero(2)])
    assert laplacian([[0.0, 0.0]], [1.0], kernel=CubicSpline(1.0)).tolist() == [0.0]


def test_one_volume_is_that_of_each_particle(places: Array) -> None:
    f = wave(places)
    one, each = (laplacian(places, f, volumes=v) for v in (DX**2, np.full(len(places), DX**2)))
    np.testing.assert_array_equal(one, each)


# what is computed


@pytest.mark.parametrize("viscosity", ["morris", "schwaiger", "oger", "fatehi_manzari", "least_squares"])
def test_the_laplacian_in_a_periodic_box(viscosity: str) -> None:
    positions = lattice((N, N), dx=DX)
    f = wave(positions)
    found = laplacian(positions, f, viscosity=viscosity, domain=PERIODIC)
    np.testing.assert_allclose(found, -8.0 * np.pi**2 * f, atol=0.04 * 8.0 * np.pi**2)


def test_particles_may_be_given_periods_away(places: Array) -> None:
    f = wave(places)
    expected = laplacian(places, f, domain=PERIODIC)
    moved = places + np.random.default_rng(0).integers(-3, 4, places.shape)
    np.testing.assert_allclose(laplacian(moved, f, domain=PERIODIC), expected, rtol=1e-9, atol=1e-9)


def test_the_gradient_in_a_box_periodic_along_one_axis() -> None:
    positions = lattice((N, N), dx=DX)
    channel = Domain((0.0, 0.0), (1.0, 1.0), (True, False))
    found = gradient(positions, wave(positions), domain=channel, spacing=DX, volumes=DX**2)
    x, y = (2.0 * np.pi * positions).T
    exact = 2.0 * np.pi * np.stack((np.cos(x) * np.cos(y), -np.sin(x) * np.sin(y)), axis=1)
    inside = (positions[:, 1] > 4 * DX) & (positions[:, 1] < 1 - 4 * DX)
    np.testing.assert_allclose(found[inside], exact[inside], atol=0.06 * 2.0 * np.pi)


def test_viscosity_and_density_scale_the_acceleration(places: Array, u: Array) -> None:
    plain = viscous_acceleration(places, u, domain=PERIODIC)
    scaled = viscous_acceleration(places, u, domain=PERIODIC, dynamic_viscosity=0.6, density=3.0)
    np.testing.assert_allclose(scaled, 0.2 * plain, rtol=1e-12)


@pytest.mark.parametrize("unit", [1e-6, 1e6])
@pytest.mark.parametrize("viscosity", ["violeau", "schwaiger", "fatehi_manzari", "least_squares"])
def test_the_unit_of_length_does_not_matter(places: Array, u: Array, viscosity: str, unit: float) -> None:
    domain = Domain((0.0, 0.0), (unit, unit))
    found = viscous_acceleration(unit * places, u, viscosity=viscosity, domain=domain)
    expected = viscous_acceleration(places, u, viscosity=viscosity, domain=PERIODIC)
    np.testing.assert_allclose(found * unit**2, expected, rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("viscosity", ["violeau", "morris", "schwaiger", "fatehi_manzari"])
@pytest.mark.parametrize("offset", [0.0, 1000.0])
def test_single_precision_is_close_to_double(places: Array, u: Array, viscosity: str, offset: float) -> None:
    domain = Domain((offset, offset), (offset + 1.0, offset + 1.0))
    arguments: Any = {"viscosity": viscosity, "domain": domain}
    double, single = (
        viscous_acceleration(places + offset, u, precision=precision, **arguments)
        for precision in ("float64", "float32")
    )
    assert single.dtype == np.float32
    np.testing.assert_allclose(single, double, atol=1e-4 * np.abs(double).max())


def test_the_result_does_not_depend_on_the_number_of_threads(places: Array) -> None:
    f = wave(places)
    one, three = (laplacian(places, f, viscosity="schwaiger", domain=PERIODIC, threads=threads) for threads in (1, 3))
    np.testing.assert_array_equal(one, three)


def test_particles_are_read_once_and_used_many_times(places: Array, u: Array) -> None:
    particles = Particles.read(places, domain=PERIODIC)
    one = np.ones(len(places))
    found = particles.viscous_acceleration(u, one, one, Violeau(), Shepard())
    np.testing.assert_array_equal(
        found, viscous_acceleration(places, u, viscosity="violeau", correction="shepard", domain=PERIODIC)
    )
    np.testing.assert_array_equal(
        particles.laplacian(u, Morris(), NoCorrection()), laplacian(places, u, domain=PERIODIC)
    )


# interpolation


@pytest.mark.parametrize("correction", list(CORRECTIONS))
def test_interpolation_is_the_sum_of_its_definition(places: Array, correction: str) -> None:
    f, kernel = wave(places), Gaussian(1.2 * DX)
    # on a particle, next to one, between some, and beyond the periodic edge
    at = np.array([places[17], places[17] + 1e-9, [0.5, 0.5], [0.999, 1.999]])
    found = interpolate(places, f, at=at, kernel=kernel, volumes=DX**2, domain=PERIODIC, correction=correction)
    d = at[:, None, :] - places[None, :, :]
    d -= np.round(d)
    weights = kernel.value((d**2).sum(axis=2), 2) * DX**2
    expected = weights @ f
    if correction in ("shepard", "bonet_lok"):
        expected /= weights.sum(axis=1)
    np.testing.assert_allclose(found, expected, rtol=1e-10, atol=1e-13)


def test_interpolation_is_at_the_particles_by_default(places: Array) -> None:
    f = wave(places)
    np.testing.assert_allclose(interpolate(places, f), interpolate(places, f, at=places), rtol=1e-13)


def test_points_may_be_anywhere_and_repeated(places: Array) -> None:
    f = np.ones(len(places))
    at = [[0.5, 0.5], [0.5, 0.5], [9.0, 9.0], [1e9, 0.0]]
    plain = interpolate(places, f, at=at)
    assert plain[0] == plain[1] == pytest.approx(1.0, rel=0.05)
    assert plain[2:].tolist() == [0.0, 0.0]
    corrected = interpolate(places, f, at=at, correction="shepard")
    np.testing.assert_allclose(corrected, [1.0, 1.0, np.nan, np.nan], rtol=1e-12)


def test_points_do_not_change_what_is_found_at_others(places: Array) -> None:
    f, at = wave(places), np.random.default_rng(1).random((40, 2))
    together = interpolate(places, f, at=at, domain=PERIODIC)
    alone = [interpolate(places, f, at=at[k : k + 1], domain=PERIODIC)[0] for k in range(5)]
    np.testing.assert_allclose(together[:5], alone, rtol=1e-12)


def test_a_gradient_of_values_is_that_of_differences_where_the_kernel_sums_to_nothing() -> None:
    positions = lattice((N, N), dx=DX)
    f = wave(positions)
    values, differences = (gradient(positions, f, of_differences=flag, domain=PERIODIC) for flag in (False, True))
    np.testing.assert_allclose(values, differences, atol=1e-10)
    edges = ~interior(positions, 0.2)
    values, differences = (gradient(positions, 1.0 + f, of_differences=flag) for flag in (False, True))
    assert abs(values - differences)[edges].max() > 1.0


# bad input


def some(dimension: int = 2) -> Array:
    return lattice((4,) * dimension)


def with_value(array: Array, value: float) -> Array:
    array = array.copy()
    array.flat[5] = value
    return array


F, V = np.arange(16.0), np.ones((16, 2))
BAD: list[tuple[Callable[[], Any], str]] = [
    # positions
    (lambda: laplacian([], []), r"positions must have the shape \(N, d\) with d = 1, 2 or 3, not \(0,\)"),
    (lambda: laplacian(np.empty((0, 2)), []), "positions must hold at least one"),
    (lambda: laplacian(np.arange(4.0), np.arange(4.0)), r"positions must have the shape \(N, d\).* not \(4,\)"),
    (lambda: laplacian(np.zeros((4, 4)), np.zeros(4)), r"not \(4, 4\)"),
    (lambda: laplacian(np.zeros((4, 0)), np.zeros(4)), r"not \(4, 0\)"),
    (lambda: laplacian(np.zeros((2, 2, 2)), np.zeros(2)), r"not \(2, 2, 2\)"),
    (lambda: laplacian(5.0, 1.0), "positions must have the shape"),
    (
        lambda: laplacian(with_value(some(), np.nan), F),
        "positions must be finite, but 1 of 16 are not, first particle 2",
    ),
    (lambda: gradient(with_value(some(), np.inf), F), "positions must be finite"),
    (lambda: interpolate([["a", "b"]], [1.0]), "positions must be an array of real numbers"),
    (lambda: interpolate([["0.0", "1.0"]], [1.0]), "positions must be an array of real numbers"),
    (lambda: interpolate([[0.0], [1.0, 2.0]], [1.0, 2.0]), "positions must be an array of real numbers"),
    (lambda: laplacian(None, F), "positions must"),  # type: ignore[arg-type]
    (lambda: laplacian({"x": 1}, F), "positions must be an array of real numbers"),  # type: ignore[arg-type]
    (lambda: laplacian(some() * 1j, F), "positions must be an array of real numbers"),
    (lambda: laplacian(some().astype(int).astype("M8[s]"), F), "positions must be an array of real numbers"),
    (lambda: laplacian([[0, 0], [1, 1], [0, 0]], [1, 2, 3], spacing=1), "particles 0 and 2 are at the same place"),
    (lambda: gradient([[0.0, 0.0]], [1.0]), "spacing cannot be told .*: give spacing, volumes or a kernel"),
    # values
    (lambda: laplacian(some(), F[:-1]), r"values must have the shape \(16,\) or \(16, k\) .*, not \(15,\)"),
    (lambda: gradient(some(), np.ones((4, 4))), r"values must have the shape"),
    (lambda: laplacian(some(), np.ones((16, 2, 2))), r"values must have the shape"),
    (lambda: interpolate(some(), 1.0), "values must have the shape"),
    (lambda: interpolate(some(), with_value(F, np.nan)), "values must be finite, .* first particle 5"),
    (lambda: laplacian(some(), ["a"] * 16), "values must be an array of real numbers"),
    (lambda: laplacian(some(), [None] * 16), "values must be"),  # type: ignore[arg-type]
    (lambda: viscous_acceleration(some(), F), r"velocities must have the shape \(16, 2\) of the positions"),
    (lambda: viscous_acceleration(some(), np.ones((16, 3))), r"velocities must have the shape \(16, 2\)"),
    (lambda: viscous_acceleration(some(), with_value(V, -np.inf)), "velocities must be finite"),
    # properties
    (lambda: laplacian(some(), F, volumes=0.0), "volumes must be positive, but the least is 0"),
    (lambda: laplacian(some(), F, volumes=-F - 1), "volumes must be positive, but the least is -16"),
    (lambda: laplacian(some(), F, volumes=with_value(F + 1, np.nan)), "volumes must be finite"),
    (lambda: laplacian(some(), F, volumes=np.ones(3)), r"volumes must be one number or have the shape \(16,\)"),
    (lambda: laplacian(some(), F, volumes="large"), "volumes must be an array of real numbers"),
    (lambda: viscous_acceleration(some(), V, density=-1.0), "density must be positive"),
    (lambda: viscous_acceleration(some(), V, density=np.ones((16, 1))), "density must be one number or"),
    (lambda: viscous_acceleration(some(), V, dynamic_viscosity=0.0), "dynamic_viscosity must be positive"),
    (lambda: viscous_acceleration(some(), V, dynamic_viscosity=np.inf), "dynamic_viscosity must be finite"),
    # kernel and spacing
    (lambda: laplacian(some(), F, kernel="cubik"), "there is no kernel named 'cubik': did you mean cubic"),
    (lambda: laplacian(some(), F, kernel=3), "there is no kernel named '3'"),  # type: ignore[arg-type]
    (lambda: laplacian(some(), F, kernel=CubicSpline(-1.0)), "smoothing length h must be positive, not -1.0"),
    (lambda: laplacian(some(), F, kernel=CubicSpline(1.0), h_over_dx=1.0), "CubicSpline.* has its own h"),
    (lambda: laplacian(some(), F, h_over_dx=0.0), "h_over_dx must be a positive number, not 0.0"),
    (lambda: laplacian(some(), F, h_over_dx=np.nan), "h_over_dx must be a positive number, not nan"),
    (lambda: laplacian(some(), F, h_over_dx="wide"), "h_over_dx must be a positive"),  # type: ignore[arg-type]
    (lambda: laplacian(some(), F, spacing=-0.1), "the particle spacing must be a positive number, not -0.1"),
    (lambda: laplacian(some(), F, spacing=np.inf), "the particle spacing must be a positive number, not inf"),
    (lambda: laplacian(some(), F, spacing="near"), "the particle spacing must be a pos"),  # type: ignore[arg-type]
    # viscosity, correction and how they go together
    (lambda: laplacian(some(), F, viscosity="moris"), "there is no viscosity named 'moris': did you mean morris?"),
    (lambda: laplacian(some(), F, viscosity="VISC-05"), "there is no viscosity named 'VISC-05': did you mean visc_0"),
    (lambda: laplacian(some(), F, viscosity=None), "there is no viscosity named 'None'"),  # type: ignore[arg-type]
    (lambda: gradient(some(), F, correction="shepherd"), "no correction named 'shepherd': did you mean shepard?"),
    (lambda: gradient(some(), F, correction=2), "there is no correction named '2'"),
    (lambda: laplacian(some(), F, viscosity="oger", correction="shepard"), "'oger' carries its own correction .*'shep"),
    (lambda: viscous_acceleration(some(), V, viscosity="lsmps", correction=1), "'least_squares' carries its own"),
    *(
        (lambda term=term: laplacian(some(), F, viscosity=term), f"{name}' cannot act on scalar fields: .*velocity")
        for term, name in (("C", "violeau"), ("D", "cleary"), ("monaghan", "monaghan"))
    ),
    (lambda: laplacian(some(), F, viscosity="espanol"), "'espanol_revenga' cannot act on scalar fields: .*velocity"),
    # the rest
    (lambda: gradient(some(), F, correction=1, fallback="zero"), "fallback must be .* not 'zero'"),  # type: ignore[arg-type]
    (lambda: laplacian(some(), F, precision="float16"), "precision must be 'float64' or 'float32', not 'float16'"),
    (lambda: laplacian(some(), F, threads=0), "threads must be a whole number of at least 1, not 0"),
    (lambda: laplacian(some(), F, threads=1.5), "threads must be a whole number"),  # type: ignore[arg-type]
    (lambda: laplacian(some(), F, threads="all"), "threads must be a whole number"),  # type: ignore[arg-type]
    (lambda: laplacian(some(3), np.ones(64), domain=PERIODIC), "the domain has 2 axes but positions has 3"),
    (lambda: laplacian(some(), F, domain=(0.0, 1.0)), "the domain must be a Domain or None"),  # type: ignore[arg-type]
    (lambda: interpolate(some(), F, at=[[0.0]]), "at has 1 axes but positions has 2"),
    (lambda: interpolate(some(), F, at=[0.0, 0.0]), r"at must have the shape \(N, d\)"),
    (lambda: interpolate(some(), F, at=[[0.0, np.nan]]), "at must be finite"),
    (lambda: interpolate(some(), F, at=np.empty((0, 2))), "at must hold at least one place"),
]


@pytest.mark.parametrize(("call", "message"), BAD, ids=[message[:60] for _, message in BAD])
def test_bad_input_is_refused_in_one_sentence(call: Callable[[], Any], message: str) -> None:
    with pytest.raises(SphearError, match=message) as caught:
        call()
    text = str(caught.value)
    assert "\n" not in text
    assert ". " not in text
    assert len(text) < 500
    # not while another error was being handled, which would be shown before it
    assert caught.value.__suppress_context__ or caught.value.__context__ is None
