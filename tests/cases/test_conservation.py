"""What is conserved, measured: against what each formula's symmetry implies, and against the committed cards."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest

from sphear import VISCOSITY, LeastSquares, Monaghan, Morris, Violeau, ViscousTerm
from sphear.cases.conservation import Conservation, conservation, is_linear
from sphear.cases.lattice import lattice
from sphear.cases.patch_test import PatchTest
from sphear.corrections import BonetLok, NoCorrection
from sphear.operators import Particles
from sphear.viscosity.card import measured

# equal and opposite forces keep linear momentum; along the line of centres, angular momentum too
BY_SYMMETRY = {
    "violeau": (True, True),
    "cleary": (True, True),
    "monaghan": (True, True),
    "morris": (True, False),
    "gotoh": (True, False),
    "espanol_revenga": (True, False),
    "schwaiger": (False, False),
    "oger": (False, False),
    "fatehi_manzari": (False, False),
    "least_squares": (False, False),
}


@cache
def kept(name: str) -> dict[str, bool]:
    return conservation(VISCOSITY[name]).kept()


def acceleration(term: ViscousTerm) -> Callable[[Any], Any]:
    grid = lattice(5, 2, jitter=0.5)
    particles = Particles.read(grid.positions, spacing=grid.spacing, volumes=grid.volume, threads=1)
    ones = np.ones(len(grid.positions))
    return lambda u: particles.viscous_acceleration(u, ones, ones, term, NoCorrection())


@pytest.mark.parametrize("name", BY_SYMMETRY)
def test_linear_momentum(name: str) -> None:
    assert kept(name)["linear_momentum"] == BY_SYMMETRY[name][0]


@pytest.mark.parametrize("name", BY_SYMMETRY)
def test_angular_momentum(name: str) -> None:
    assert kept(name)["angular_momentum"] == BY_SYMMETRY[name][1]


@pytest.mark.parametrize("name", ["violeau", "morris", "gotoh", "espanol_revenga", "monaghan"])
def test_equal_and_opposite_forces_of_one_sign_only_dissipate(name: str) -> None:
    assert kept(name)["dissipative"]


@pytest.mark.parametrize("name", ["takeda", "schwaiger", "oger", "fatehi_manzari", "least_squares"])
def test_one_sided_weights_can_gain_energy(name: str) -> None:
    assert not kept(name)["dissipative"]


def test_what_is_not_kept_is_far_from_rounding() -> None:
    assert conservation(Morris(), seeds=1, trials=3).angular_momentum > 1e-4


def test_a_correction_takes_conservation_away() -> None:
    found = conservation(Violeau(), BonetLok(), seeds=1, trials=3).kept()
    assert found == {"linear_momentum": False, "angular_momentum": False, "dissipative": False}


def test_kept_is_by_rounding() -> None:
    assert Conservation(1e-12, 1e-8, -0.3).kept() == {
        "linear_momentum": True,
        "angular_momentum": False,
        "dissipative": True,
    }


def test_the_velocity_that_gains_most_is_found_though_random_ones_lose() -> None:
    """Among random velocities least squares dissipate; an eigenvector of the symmetric part gains all the same."""
    term, grid = LeastSquares(), lattice(8, 2, jitter=0.5)
    particles = Particles.read(grid.positions, spacing=grid.spacing, h_over_dx=2.2, volumes=grid.volume, threads=1)
    ones, random = np.ones(81), np.random.default_rng(0)
    velocities = (random.standard_normal((81, 2)) for _ in range(20))
    powers = [(u * particles.viscous_acceleration(u, ones, ones, term, NoCorrection())).sum() for u in velocities]
    assert max(powers) < 0 < conservation(term, seeds=1).energy


@pytest.mark.parametrize(
    ("term", "linear"),
    [
        (Morris(), True),
        (Violeau(), True),
        (Monaghan(), False),
        (Monaghan(receding=True), True),
        (Monaghan(beta=1.0), False),
    ],
)
def test_linearity(term: ViscousTerm, linear: bool) -> None:
    u, v = np.random.default_rng(0).standard_normal((2, 36, 2))
    assert is_linear(acceleration(term), u, v) is linear


@pytest.mark.parametrize("name", list(VISCOSITY))
def test_the_cards_say_what_is_conserved(name: str) -> None:
    committed = measured()[name]
    assert {key: committed[key] for key in kept(name)} == kept(name), "run python validation/measure_cards.py"


def test_every_term_has_a_card_and_no_other() -> None:
    assert list(measured()) == list(VISCOSITY)


@pytest.mark.parametrize("name", ["violeau", "morris", "schwaiger", "fatehi_manzari", "least_squares_4"])
@pytest.mark.parametrize(("kind", "sizes", "jitter"), [("lattice", (160, 320), 0.0), ("jittered", (80, 160), 0.3)])
def test_the_cards_say_the_orders(name: str, kind: str, sizes: tuple[int, int], jitter: float) -> None:
    test = PatchTest(
        viscosity=(name,), sizes=sizes, field="sine", velocity=VISCOSITY[name].radial, jitter=jitter, seeds=8
    )
    assert test.rows()[-1]["order"] == pytest.approx(measured()[name][f"order_{kind}"], abs=0.02)
