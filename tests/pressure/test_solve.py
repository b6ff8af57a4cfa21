from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from sphear.errors import SphearError
from sphear.pressure import PressureFailure, PressureSystem, solve
from sphear.pressure.preconditioners import AlgebraicMultigrid
from tests.pressure.problems import KERNELS, Array, box, fixed, one_sided, particles, random_right


@pytest.mark.parametrize("periodic", [True, False, (True, False)])
def test_a_cosine_on_a_lattice(periodic: Any) -> None:
    """lap p = -8 pi^2 cos cos has p = cos cos up to the error of the Laplacian; it is even at walls, so Neumann holds.

    Without particles beyond a wall the wall is displaced by a share of a spacing: first order. On a periodic lattice p
    is an eigenvector, and only the sum for lap |r|^2 is in error, by the same share for all spacings.
    """
    errors = []
    for side in (16, 32, 64):
        system = box((side, side), periodic=periodic, jitter=0.0)
        x, y = system.positions.T
        exact = np.cos(2 * np.pi * x) * np.cos(2 * np.pi * y)
        found = solve(system, -8 * np.pi**2 * exact, tolerance=1e-8)
        errors.append(float(np.sqrt(np.mean((found.values - exact) ** 2))))
    assert errors[0] > errors[1] > errors[2]
    assert errors[2] < (0.01 if periodic is True else 0.05)


@pytest.mark.parametrize("counts", [(400,), (40, 20), (12, 12, 12)], ids=["1-D", "2-D", "3-D"])
@pytest.mark.parametrize(
    "flags", [(False, False, False), (True, True, True), (True, False, True), (False, True, False)]
)
def test_a_manufactured_pressure_in_boxes_of_all_kinds(counts: tuple[int, ...], flags: tuple[bool, ...]) -> None:
    system = box(counts, periodic=flags[: len(counts)])
    exact = random_right(system)
    exact -= exact.mean()
    right = system.matrix @ exact
    found = solve(system, right, tolerance=1e-8)
    assert found.preconditioner == "grid"
    assert not found.retried
    assert found.iterations <= 25
    assert found.residual <= 1.01e-8
    assert np.allclose(found.values, exact, atol=1e-4)


@pytest.mark.parametrize("side", [50, 100])
@pytest.mark.parametrize("hole", [0.0, 0.25], ids=["square", "cylinder"])
@pytest.mark.parametrize("kernel", KERNELS)
def test_at_most_15_iterations_from_a_cold_start(side: int, hole: float, kernel: str) -> None:
    system = box((side, side), hole=hole, kernel=kernel)
    for right in (random_right(system), system.positions[:, 0], np.sin(9 * system.positions).prod(axis=1)):
        found = solve(system, right)
        assert (found.method, found.preconditioner) == ("cg", "grid")
        assert found.iterations <= 15
        assert np.linalg.norm(right - right.mean() - system.matrix @ found.values) <= 1.02e-6 * np.linalg.norm(right)


@pytest.mark.parametrize("hole", [0.1, 0.35, 0.45])
def test_holes_of_any_size(hole: float) -> None:
    """The last one leaves gaps of five particles between cylinder and walls, and a third of the box."""
    system = box((100, 100), hole=hole)
    assert max(solve(system, right).iterations for right in (random_right(system), system.positions[:, 0])) <= 15


@pytest.mark.parametrize("hole", [0.0, 0.25], ids=["square", "cylinder"])
def test_at_most_25_iterations_without_symmetry(hole: float) -> None:
    system = one_sided(box((100, 100), hole=hole))
    found = solve(system, random_right(system))
    assert (found.method, found.preconditioner) == ("bicgstab", "grid")
    assert found.iterations <= 25


@pytest.mark.parametrize("counts", [(20, 20), (8, 8, 8)], ids=["2-D", "3-D"])
def test_the_null_space_of_a_matrix_without_symmetry(counts: tuple[int, ...]) -> None:
    """A p + lambda 1 = b and mean(p) = 0, compared with the bordered system solved at once."""
    system = one_sided(box(counts))
    right = random_right(system) + 0.3
    found = solve(system, right, tolerance=1e-9)
    multiplier = (right - system.matrix @ found.values).mean()
    balanced = right - right.mean()
    assert np.linalg.norm(system.matrix @ found.values + multiplier - right) <= 1.02e-9 * np.linalg.norm(balanced)
    assert abs(found.values.mean()) < 1e-13 * np.abs(found.values).max()
    assert found.imbalance == pytest.approx(abs(multiplier) * np.sqrt(system.unknowns) / np.linalg.norm(right))

    unknowns = system.unknowns
    bordered = np.ones((unknowns + 1, unknowns + 1))
    bordered[:-1, :-1], bordered[-1, -1] = system.matrix.toarray(), 0.0
    direct = np.linalg.solve(bordered, np.append(right, 0.0))
    assert direct[-1] == pytest.approx(multiplier, abs=1e-8)
    assert np.allclose(found.values, direct[:-1], atol=1e-6 * np.abs(direct).max())


def test_the_null_space_of_a_symmetric_matrix() -> None:
    system = box((30, 30), hole=0.25)
    right = random_right(system) + 2.0
    found = solve(system, right)
    assert abs(found.values.mean()) < 1e-13 * np.abs(found.values).max()
    assert found.imbalance == pytest.approx(abs(right.mean()) * np.sqrt(system.unknowns) / np.linalg.norm(right))
    assert np.linalg.norm(system.matrix @ found.values + right.mean() - right) <= 1.01e-6 * np.linalg.norm(right)


def surface(side: int) -> PressureSystem:
    """A column of water in the corner of a tank, zero pressure at the particles of its top and its front."""
    spacing = 1.0 / side
    whole = box((side, side))
    x, y = whole.positions.T
    column = (x < 0.5) & (y < 0.7)
    gone = whole.positions[column]
    system = fixed(whole, ~column)  # natural: what is not there has no weight
    weights = system.matrix - np.asarray(system.matrix.sum(axis=1)).ravel() * _identity(system.unknowns)
    known = (gone[:, 0] > 0.5 - spacing) | (gone[:, 1] > 0.7 - spacing)
    return fixed(replace(system, matrix=weights, singular=True), known)


def _identity(size: int) -> Any:
    from scipy.sparse import eye_array

    return eye_array(size, format="csr")


def test_a_free_surface() -> None:
    """As many iterations for any number of particles, and the solution of a direct solver."""
    assert max(solve(fine, np.ones(fine.unknowns)).iterations for fine in (surface(50), surface(100))) <= 15
    system = surface(40)
    right = random_right(system) + 1.0
    found = solve(system, right)
    assert found.imbalance == 0.0
    assert not found.retried
    assert np.allclose(found.values, np.linalg.solve(system.matrix.toarray(), right), rtol=1e-4, atol=1e-5)


def test_all_preconditioners_agree() -> None:
    for system in (box((25, 25), hole=0.2), one_sided(box((25, 25))), surface(30)):
        right = random_right(system)
        found = [solve(system, right, preconditioner=name, tolerance=1e-9) for name in ("grid", "amg", "jacobi")]
        assert [x.preconditioner for x in found] == ["grid", "amg", "jacobi"]
        scale = np.abs(found[0].values).max()
        for other in found[1:]:
            assert np.allclose(other.values, found[0].values, atol=1e-6 * scale)


def test_a_warm_start_needs_fewer_iterations_for_the_same_residual() -> None:
    system = box((40, 40))
    right = random_right(system)
    cold = solve(system, right)
    moved = right + 1e-3 * random_right(system, 2)
    warm = solve(system, moved, cold.values)
    assert warm.iterations < solve(system, moved).iterations - 3
    assert warm.residual <= 1.01e-6
    assert solve(system, right, cold.values + 5.0).iterations <= 1  # constants do not matter


def test_nothing_to_do() -> None:
    system = box((8, 8))
    for right, imbalance in ((np.zeros(64), 0.0), (np.full(64, 0.1), 1.0)):
        found = solve(system, right, guess=random_right(system))
        assert not found.values.any()
        assert (found.iterations, found.residual, found.imbalance, found.method) == (0, 0.0, imbalance, "direct")


@pytest.mark.parametrize("unit", [1e-150, 1e150])
@pytest.mark.parametrize("symmetric", [True, False])
def test_units_do_not_matter(unit: float, symmetric: bool) -> None:
    system = box((20, 20)) if symmetric else one_sided(box((20, 20)))
    right = random_right(system)
    one, other = solve(system, right), solve(system, unit * right)
    assert one.iterations == other.iterations
    assert np.allclose(other.values / unit, one.values)


def test_a_solve_that_does_not_converge_is_repeated_with_what_is_safer(monkeypatch: pytest.MonkeyPatch) -> None:
    system = box((30, 30))
    right = random_right(system)
    found = solve(system, right, preconditioner="jacobi", most=12)
    assert (found.preconditioner, found.method, found.retried) == ("amg", "gmres", True)
    assert found.iterations > 12
    monkeypatch.setattr(AlgebraicMultigrid, "installed", staticmethod(lambda: False))
    found = solve(system, right, most=5)
    assert (found.preconditioner, found.method, found.retried) == ("jacobi", "gmres", True)
    assert np.allclose(found.values, solve(system, right).values, atol=1e-4)
    with pytest.raises(SphearError, match=r'pip install "sphear\[amg\]"'):
        solve(system, right, preconditioner="amg")


def test_a_matrix_that_is_not_symmetric_as_said_is_solved_all_the_same() -> None:
    system = one_sided(box((30, 30)))
    right = random_right(system)
    found = solve(replace(system, symmetric=True), right, tolerance=1e-9, most=30)
    assert (found.method, found.retried) == ("gmres", True)
    right_one = solve(system, right, tolerance=1e-9)
    assert np.allclose(found.values, right_one.values, atol=1e-7 * np.abs(right_one.values).max())
    assert found.imbalance == pytest.approx(right_one.imbalance, rel=1e-5)


def test_two_basins_without_a_surface_are_named() -> None:
    """Each has a constant of its own, and a right-hand side that one of them cannot have."""
    whole = box((20, 20), jitter=0.0)
    side = whole.positions[:, 0] < 0.5
    pairs = whole.matrix.tocoo()
    pairs.data[side[pairs.row] != side[pairs.col]] = 0.0
    apart = pairs.tocsr()
    apart.eliminate_zeros()
    apart = apart - np.asarray(apart.sum(axis=1)).ravel() * _identity(whole.unknowns)
    with pytest.raises(PressureFailure, match=r"falls into 2 parts .* in 1 of them nothing fixes the pressure"):
        solve(replace(whole, matrix=apart), np.where(side, 1.0, -1.0), most=20)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"right": np.ones(5)}, r"right-hand side .* 64 numbers, not of shape \(5,\)"),
        ({"right": np.full(64, np.nan)}, "right-hand side .* not finite at particle 0"),
        ({"right": np.ones(64), "guess": np.full(64, np.inf)}, "first guess .* not finite"),
        ({"right": np.ones(64), "preconditioner": "gird"}, "did you mean grid"),
        ({"right": np.ones(64), "tolerance": 0.0}, "tolerance .* between 0 and 1"),
    ],
)
def test_refusals(arguments: dict[str, Any], sentence: str) -> None:
    with pytest.raises(SphearError, match=sentence):
        solve(box((8, 8)), **arguments)


def test_particles_of_the_hole_are_gone() -> None:
    places: Array = particles((20, 20), 0.05, hole=0.25)
    assert np.hypot(*(places - 0.5).T).min() > 0.25
