"""Kernels against their definitions: B-splines of SciPy, Wendland's integrals, and numerical quadrature."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.polynomial import Chebyshev, Polynomial
from scipy.integrate import quad
from scipy.interpolate import BSpline

from sphear import KERNELS, Kernel, SphearError

Function = Callable[[Any], Any]

SPLINE_ORDER = {"cubic_spline": 4, "quartic_spline": 5, "quintic_spline": 6}
SMOOTHNESS = {"wendland_c2": 1, "wendland_c4": 2, "wendland_c6": 3}
SPHERE = {1: 2.0, 2: 2.0 * math.pi, 3: 4.0 * math.pi}  # the surface of the unit sphere, for radial integrals

dimensions = st.integers(1, 3)
lengths = st.floats(1e-3, 1e3)
every_kernel = pytest.mark.parametrize("name", list(KERNELS))
every_dimension = pytest.mark.parametrize("dimension", [1, 2, 3])


def wendland(smoothness: int, dimension: int) -> Function:
    """Wendland's function from its definition: (1 - x)+^l, integrated `smoothness` times as int_x^1 t p(t) dt."""
    p = Polynomial([1.0, -1.0]) ** (dimension // 2 + smoothness + 1)
    for _ in range(smoothness):
        antiderivative = (Polynomial([0.0, 1.0]) * p).integ()
        p = antiderivative(1.0) - antiderivative
    return lambda q: np.where(q < 2.0, p(0.5 * q), 0.0)


def reference(name: str, dimension: int) -> Function:
    """The kernel's form from its definition, up to a factor."""
    if name in SPLINE_ORDER:
        order = SPLINE_ORDER[name]
        spline = BSpline.basis_element(np.arange(order + 1) - 0.5 * order, extrapolate=False)
        return lambda q: np.nan_to_num(spline(q))
    if name in SMOOTHNESS:
        return wendland(SMOOTHNESS[name], dimension)
    return lambda q: np.where(q < 3.0, np.exp(-(q**2)), 0.0)


def radial_integral(f: Function, dimension: int, support: float, power: int = 0) -> float:
    """The integral of f(r) r^power over space, piece by piece between possible knots."""
    knots = np.arange(0.0, support + 0.25, 0.5)
    pieces = (quad(lambda r: f(r) * r ** (dimension - 1 + power), a, b, epsabs=1e-14)[0] for a, b in pairwise(knots))
    return SPHERE[dimension] * sum(pieces)


def value(kernel: Kernel, r: Any, dimension: int) -> Any:
    return kernel.value(np.square(r), dimension)


@every_dimension
@every_kernel
def test_the_integral_is_one(name: str, dimension: int) -> None:
    kernel = KERNELS[name](1.0)
    total = radial_integral(lambda r: value(kernel, r, dimension), dimension, kernel.support)
    assert total == pytest.approx(1.0, rel=1e-12)


@every_dimension
@every_kernel
def test_values_are_those_of_the_definition(name: str, dimension: int) -> None:
    kernel, expected = KERNELS[name](1.0), reference(name, dimension)
    q = np.linspace(0.0, 1.1 * kernel.support, 101)
    factor = 1.0 / radial_integral(expected, dimension, kernel.support)
    np.testing.assert_allclose(value(kernel, q, dimension), factor * expected(q), rtol=1e-10, atol=1e-13)


@every_dimension
@every_kernel
def test_the_second_moment_is_that_of_the_definition(name: str, dimension: int) -> None:
    kernel, expected = KERNELS[name](1.0), reference(name, dimension)
    ours = radial_integral(lambda r: value(kernel, r, dimension), dimension, kernel.support, power=2)
    theirs = [radial_integral(expected, dimension, kernel.support, power) for power in (2, 0)]
    assert ours == pytest.approx(theirs[0] / theirs[1], rel=1e-11)
    assert ours > 0


@every_dimension
@every_kernel
def test_the_integral_of_the_gradient_is_zero_and_its_first_moment_minus_one(name: str, dimension: int) -> None:
    """int grad W = 0 by symmetry, and int (1/r W') x^2 = -1 by parts: W is what makes first derivatives right."""
    kernel = KERNELS[name](1.0)
    moment = radial_integral(lambda r: kernel.gradient_factor(r * r, dimension), dimension, kernel.support, power=2)
    # the Gaussian is cut where it is not zero, and its gradient misses that step
    step = value(kernel, kernel.support * (1 - 1e-12), dimension) * SPHERE[dimension] * kernel.support**dimension
    assert moment / dimension == pytest.approx(-1.0 + step / dimension, rel=1e-11)
    for d in np.eye(dimension).tolist():
        forth, back = kernel.gradient(tuple(d), 1.0), kernel.gradient(tuple(-x for x in d), 1.0)
        np.testing.assert_array_equal(np.add(forth, back), 0.0)


@every_dimension
@every_kernel
def test_derivatives_are_those_of_the_value(name: str, dimension: int) -> None:
    """Between knots a kernel is a polynomial (or a Gaussian), so that its Chebyshev interpolant is exact."""
    kernel = KERNELS[name](1.0)
    for a, b in pairwise(np.arange(0.0, kernel.support + 0.25, 0.5)):
        piece = Chebyshev.interpolate(lambda r: value(kernel, r, dimension), 18, domain=[a, b])
        r = np.linspace(a, b, 9)[1:-1]
        scale = kernel.value_at_zero(dimension)
        first, second = r * kernel.gradient_factor(r**2, dimension), kernel.second_derivative(r**2, dimension)
        np.testing.assert_allclose(first, piece.deriv()(r), rtol=1e-9, atol=1e-11 * scale)
        np.testing.assert_allclose(second, piece.deriv(2)(r), rtol=1e-9, atol=1e-9 * scale)


@every_dimension
@every_kernel
def test_values_at_no_distance_are_the_limits(name: str, dimension: int) -> None:
    kernel = KERNELS[name](0.7)
    assert kernel.value_at_zero(dimension) == pytest.approx(kernel.value(1e-16, dimension), rel=1e-7)
    d = (1e-6, *(0.0,) * (dimension - 1))
    near = kernel.hessian(d, 1e-12)
    scale = abs(near[0][0])
    np.testing.assert_allclose(kernel.hessian_at_zero(dimension), near, rtol=1e-5, atol=1e-5 * scale)


@every_dimension
@every_kernel
def test_value_and_slope_are_continuous_at_every_knot(name: str, dimension: int) -> None:
    kernel = KERNELS[name](1.0)
    for knot in np.arange(0.5, kernel.support + (0.0 if name == "gaussian" else 0.25), 0.5):
        for f in (kernel.value, kernel.gradient_factor):
            below, above = f((knot - 1e-9) ** 2, dimension), f((knot + 1e-9) ** 2, dimension)
            assert above == pytest.approx(below, rel=1e-7, abs=1e-8)


@given(st.sampled_from(list(KERNELS)), dimensions, lengths, st.floats(1.0, 100.0))
def test_nothing_is_left_outside_the_support(name: str, dimension: int, h: float, beyond: float) -> None:
    kernel = KERNELS[name](h)
    assert kernel.radius == kernel.support * h
    r2 = (kernel.radius * beyond * (1 + 1e-12)) ** 2
    assert kernel.value(r2, dimension) == 0.0
    assert kernel.gradient_factor(r2, dimension) == 0.0
    assert kernel.second_derivative(r2, dimension) == 0.0


@given(st.sampled_from(list(KERNELS)), dimensions, st.floats(1e-3, 1.0), st.floats(1e-3, 1.0))
def test_kernels_fall_from_a_positive_value(name: str, dimension: int, q1: float, q2: float) -> None:
    kernel = KERNELS[name](1.0)
    near, far = (kernel.support * (1 - 1e-9) * q for q in sorted((q1, q2)))
    assert kernel.value_at_zero(dimension) >= kernel.value(near**2, dimension)
    assert kernel.value(near**2, dimension) >= kernel.value(far**2, dimension) >= 0.0
    assert kernel.gradient_factor(far**2, dimension) <= 0.0


@given(st.sampled_from(list(KERNELS)), dimensions, lengths, st.floats(1e-3, 3.1))
def test_the_smoothing_length_only_scales(name: str, dimension: int, h: float, q: float) -> None:
    kernel, unit = KERNELS[name](h), KERNELS[name](1.0)
    for function, power in (("value", 0), ("gradient_factor", 2), ("second_derivative", 2)):
        scaled = getattr(kernel, function)((q * h) ** 2, dimension) * h ** (dimension + power)
        expected = getattr(unit, function)(q**2, dimension)
        assert scaled == pytest.approx(expected, rel=1e-9, abs=1e-9)


@every_kernel
@given(st.integers(2, 3).flatmap(lambda n: st.tuples(*[st.floats(-1.0, 1.0)] * n)))
def test_gradient_and_hessian_are_derivatives_in_space(name: str, direction: tuple[float, ...]) -> None:
    dimension = len(direction)
    kernel = KERNELS[name](1.0)
    assume(np.linalg.norm(direction) > 0.01)
    d = 0.77 / np.linalg.norm(direction) * np.array(direction)  # off the knots
    step = 1e-5

    def gradient(x: Any) -> Any:
        return np.array(kernel.gradient(tuple(x), float(x @ x)))

    def along_each_axis(f: Function) -> Any:
        return [(f(d + step * axis) - f(d - step * axis)) / (2 * step) for axis in np.eye(dimension)]

    slopes = along_each_axis(lambda x: value(kernel, np.linalg.norm(x), dimension))
    np.testing.assert_allclose(gradient(d), slopes, rtol=1e-6, atol=1e-8)
    hessian: np.ndarray = np.array(kernel.hessian(tuple(d), float(d @ d)))
    np.testing.assert_allclose(hessian, along_each_axis(gradient), rtol=1e-5, atol=1e-7)
    np.testing.assert_allclose(hessian, hessian.T)


@every_kernel
@pytest.mark.parametrize("h", [0.0, -1.0, math.nan, math.inf, -math.inf])
def test_a_smoothing_length_that_is_not_positive_is_refused(name: str, h: float) -> None:
    with pytest.raises(SphearError, match=f"smoothing length h must be positive, not {h}"):
        KERNELS[name](h)


def test_kernels_are_values() -> None:
    for name in KERNELS:
        kernel = KERNELS[name](0.5)
        assert kernel == KERNELS[name](0.5) != KERNELS[name](0.6)
        assert hash(kernel) == hash(KERNELS[name](0.5))
        with pytest.raises(AttributeError):
            kernel.h = 1.0  # type: ignore[misc]
