"""Equations of state: speed of sound against differentiation, inverses, limits, and their traced code."""

from __future__ import annotations

import math
from itertools import count
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sphear.algebra import exp, positive_part, sqrt, where_less
from sphear.engine.structure import parameters, with_symbols
from sphear.engine.trace import Trace
from sphear.equations_of_state import (
    EQUATIONS_OF_STATE,
    Barotropic,
    BatchelorTait,
    EquationOfState,
    IdealGas,
    Linear,
)
from sphear.errors import SphearError

positive = st.floats(1e-3, 1e3)
powers = st.integers(1, 12)
barotropic: st.SearchStrategy[Barotropic] = st.one_of(
    st.builds(BatchelorTait, positive, positive, powers), st.builds(Linear, positive, positive)
)
gases = st.builds(IdealGas, st.floats(1.01, 3.0))
equations: st.SearchStrategy[EquationOfState] = st.one_of(barotropic, gases)
ratios = st.floats(0.5, 2.0)


def scale_of(equation: EquationOfState) -> float:
    """A density the equation is made for."""
    return equation.rho0 if isinstance(equation, Barotropic) else 1.0


@given(equations, ratios, positive)
def test_the_speed_of_sound_is_the_isentropic_slope_of_the_pressure(
    equation: EquationOfState, ratio: float, energy: float
) -> None:
    """By a complex step, which is exact; along an isentrope de = p / rho^2 drho."""
    density = ratio * scale_of(equation)
    step = 1e-30 * density
    de = step * equation.pressure(density, energy) / density**2
    slope = equation.pressure(density + 1j * step, energy + 1j * de).imag / step
    assert equation.sound_speed(density, energy) ** 2 == pytest.approx(slope, rel=1e-12)


@given(equations, ratios, positive)
def test_the_density_is_the_inverse_of_the_pressure(equation: EquationOfState, ratio: float, energy: float) -> None:
    density = ratio * scale_of(equation)
    pressure = equation.pressure(density, energy)
    # where rho^gamma is small beside rho0^gamma, the pressure has lost its digits
    assert equation.density(pressure, energy) == pytest.approx(density, rel=1e-11)


@given(equations, ratios, st.floats(1.001, 2.0), positive)
def test_the_pressure_rises_with_the_density(
    equation: EquationOfState, ratio: float, factor: float, energy: float
) -> None:
    density = ratio * scale_of(equation)
    assert equation.pressure(factor * density, energy) > equation.pressure(density, energy)
    assert equation.sound_speed(factor * density, energy) >= equation.sound_speed(density, energy) * (1 - 1e-15)


@given(barotropic)
def test_the_reference_state(equation: Barotropic) -> None:
    assert equation.pressure(equation.rho0) == 0.0
    assert equation.sound_speed(equation.rho0) == equation.c0
    assert equation.density(0.0) == equation.rho0
    assert equation.pressure(equation.rho0 * 0.9, energy=5.0) == equation.pressure(equation.rho0 * 0.9)
    assert not equation.uses_energy


@given(positive, positive, powers)
def test_batchelor_tait_is_linear_for_small_changes(rho0: float, c0: float, gamma: int) -> None:
    """The difference is of second order: rho0 c0^2 (gamma - 1) / 2 (rho / rho0 - 1)^2."""
    stiff, linear = BatchelorTait(rho0, c0, gamma), Linear(rho0, c0)
    for change in (-1e-3, -1e-4, 1e-4, 1e-3):
        density = rho0 * (1.0 + change)
        difference = (stiff.pressure(density) - linear.pressure(density)) / (rho0 * c0**2)
        assert difference == pytest.approx(0.5 * (gamma - 1) * change**2, rel=5 * gamma * abs(change), abs=1e-14)


@given(positive, positive, st.floats(0.5, 2.0))
def test_with_the_power_one_it_is_linear(rho0: float, c0: float, ratio: float) -> None:
    stiff, linear = BatchelorTait(rho0, c0, 1), Linear(rho0, c0)
    assert stiff.pressure(ratio * rho0) == pytest.approx(linear.pressure(ratio * rho0), abs=1e-14 * rho0 * c0**2)
    assert stiff.sound_speed(ratio * rho0) == c0


def test_a_change_of_density_by_one_percent() -> None:
    """p = rho0 c0^2 / 7 (1.01^7 - 1), and the value known from water."""
    water = BatchelorTait(1000.0, 10.0)
    assert water.gamma == 7
    assert water.pressure(1010.0) == pytest.approx(1e5 / 7 * 0.0721353521070100, rel=1e-13)


def test_air_at_room_temperature() -> None:
    """R T = 287.05 J/kg/K x 293.15 K: 1.204 kg/m^3, 343.2 m/s at one atmosphere."""
    air = IdealGas()
    energy = 287.05 * 293.15 / 0.4
    assert air.pressure(1.2041, energy) == pytest.approx(101325.0, rel=1e-4)
    assert air.sound_speed(1.2041, energy) == pytest.approx(343.2, rel=1e-4)
    assert air.energy(1.2041, air.pressure(1.2041, energy)) == pytest.approx(energy, rel=1e-14)
    assert air.uses_energy


@given(equations, ratios, positive)
def test_traced_code_gives_what_the_formula_gives(equation: EquationOfState, ratio: float, energy: float) -> None:
    density = ratio * scale_of(equation)
    trace, numbers = Trace(), count()
    symbolic = with_symbols(equation, lambda: trace.input(f"p{next(numbers)}"))
    inputs = trace.input("density"), trace.input("energy")
    outputs = [symbolic.pressure(*inputs), symbolic.sound_speed(*inputs)]
    lines, used = trace.code(outputs)
    known: dict[str, Any] = {f"p{k}": x for k, x in enumerate(parameters(equation))}
    known |= {"density": density, "energy": energy}
    assert used <= known.keys()
    known |= {"sqrt": sqrt, "exp": exp, "positive_part": positive_part, "where_less": where_less}
    exec("\n".join(lines), known)
    pressure, sound_speed = (eval(str(x), known) for x in outputs)
    size = equation.sound_speed(density, energy) ** 2 * density + abs(equation.pressure(density, energy))
    if isinstance(equation, Barotropic):
        size += equation.rho0 * equation.c0**2  # what cancels in the pressure
    assert pressure == pytest.approx(equation.pressure(density, energy), rel=1e-12, abs=1e-14 * size)
    assert sound_speed == pytest.approx(equation.sound_speed(density, energy), rel=1e-12)


def test_arrays_are_taken_number_by_number() -> None:
    densities, energies = np.array([900.0, 1000.0, 1100.0]), np.array([1.0, 2.0, 3.0])
    for equation in (BatchelorTait(1000.0, 20.0), BatchelorTait(1000.0, 20.0, 4), Linear(1000.0, 20.0), IdealGas()):
        pressures = equation.pressure(densities, energies)
        expected = [equation.pressure(*state) for state in zip(densities.tolist(), energies.tolist(), strict=True)]
        np.testing.assert_allclose(pressures, expected, rtol=1e-14)
        np.testing.assert_allclose(equation.density(pressures, energies), densities, rtol=1e-12)
        speeds = [equation.sound_speed(*state) for state in zip(densities.tolist(), energies.tolist(), strict=True)]
        np.testing.assert_allclose(equation.sound_speed(densities, energies), speeds, rtol=1e-14)


def test_pressures_that_no_density_has_are_refused() -> None:
    equation = BatchelorTait(1000.0, 10.0)
    assert equation.density(-1e5 / 7 * (1 - 1e-7)) == pytest.approx(100.0, rel=1e-6)
    for pressures in (-14286.0, np.array([0.0, -14286.0])):
        with pytest.raises(SphearError, match=r"at least -rho0 c0\^2 / gamma = -14285\.7, not -14286$"):
            equation.density(pressures)


def test_the_root_is_not_for_traces() -> None:
    with pytest.raises(TypeError):
        BatchelorTait(1000.0, 10.0).density(Trace().input("p"))


@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf])
@pytest.mark.parametrize("equation", [BatchelorTait, Linear])
def test_parameters_that_are_not_positive_are_refused(equation: type[Barotropic], value: float) -> None:
    with pytest.raises(SphearError, match=f"the reference density rho0 must be positive, not {value}$"):
        equation(value, 1.0)
    with pytest.raises(SphearError, match=f"the speed of sound c0 must be positive, not {value}$"):
        equation(1.0, value)


@pytest.mark.parametrize("gamma", [0, -7, 7.0, 1.4, math.nan, True, "7"])
def test_powers_that_are_not_whole_are_refused(gamma: Any) -> None:
    with pytest.raises(SphearError, match=f"gamma must be an integer of at least 1, not {gamma}$"):
        BatchelorTait(1.0, 1.0, gamma)


@pytest.mark.parametrize("gamma", [1.0, 0.0, -1.4, math.nan, math.inf])
def test_ratios_of_heat_capacities_are_above_one(gamma: float) -> None:
    with pytest.raises(SphearError, match=f"gamma must be a number above 1, not {gamma}$"):
        IdealGas(gamma)


def test_an_ideal_gas_needs_its_energy() -> None:
    for method in (IdealGas().pressure, IdealGas().sound_speed, IdealGas().density):
        with pytest.raises(SphearError, match="without its specific energy"):
            method(1.0)


def test_equations_are_found_by_name_and_alias() -> None:
    assert list(EQUATIONS_OF_STATE) == ["ideal_gas", "batchelor_tait", "linear"]
    for name, expected in {"Tait": BatchelorTait, "13": BatchelorTait, "weakly-compressible": BatchelorTait,
                           "12": IdealGas, "compressible": IdealGas, "linearised": Linear}.items():  # fmt: skip
        assert EQUATIONS_OF_STATE[name] is expected
    with pytest.raises(SphearError, match="no equation of state named 'taits': did you mean tait"):
        EQUATIONS_OF_STATE["taits"]


@given(equations)
def test_equations_are_values_with_their_formula_and_source(equation: EquationOfState) -> None:
    assert equation == type(equation)(*vars(equation).values())
    assert hash(equation) == hash(type(equation)(*vars(equation).values()))
    assert EQUATIONS_OF_STATE[equation.name] is type(equation)
    assert equation.formula.startswith("p = ")
    assert equation.source
