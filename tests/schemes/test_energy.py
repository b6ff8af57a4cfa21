"""The energy budget, on motions whose work is known and on a flow."""

from __future__ import annotations

import numpy as np
import pytest

from sphear.schemes.energy import EnergyBudget
from tests.schemes.incompressible.flows import case

UP = np.array([[0.0, 1.0]])


def test_the_work_of_a_constant_force_is_the_kinetic_energy_that_it_gives() -> None:
    budget = EnergyBudget(2.0, np.zeros((1, 2)), speed=1.0)
    for number in range(10):
        budget.add(0.1, 0.1 * number * UP, 0.1 * (number + 1) * UP, np.zeros((1, 2)), UP[0])
    assert budget.force == pytest.approx(budget.kinetic(UP)) == pytest.approx(1.0)
    assert budget.residual(UP) == pytest.approx(0.0, abs=1e-14)


def test_energy_that_nobody_gave_is_created() -> None:
    budget = EnergyBudget(1.0, UP, speed=1.0)
    budget.add(1.0, UP, 0.5 * UP, np.zeros((1, 2)), np.zeros(2))  # lost to the discretisation
    budget.add(1.0, 0.5 * UP, UP, np.zeros((1, 2)), np.zeros(2))  # and made again
    assert budget.residual(0.5 * UP) == pytest.approx(-0.75)
    assert budget.created(UP) == pytest.approx(0.75)


def test_friction_that_takes_what_is_lost_leaves_no_residual() -> None:
    budget = EnergyBudget(1.0, UP, speed=1.0)
    budget.add(1.0, UP, 0.5 * UP, -0.5 * UP, np.zeros(2))
    assert budget.viscous == pytest.approx(-0.375)
    assert budget.residual(0.5 * UP) == pytest.approx(0.0, abs=1e-14)


def test_a_budget_goes_on_from_its_state() -> None:
    budget, again = EnergyBudget(1.0, UP, 1.0), EnergyBudget(1.0, 0.0 * UP, 1.0)
    budget.add(1.0, UP, 0.5 * UP, 0.1 * UP, UP[0])
    again.restore(budget.state())
    assert again.residual(UP) == budget.residual(UP)


def test_the_budget_of_vortices_closes_as_particles_get_finer() -> None:
    lost = [
        abs(case("taylor-green", resolution=size, until=0.3, threads=1).run().history[-1]["energy_residual"])
        for size in (20, 40)
    ]
    assert lost[1] < 0.01
    assert lost[1] < 0.5 * lost[0]
