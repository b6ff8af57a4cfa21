"""The patch test: its settings, which particles count, what stands in for neighbours that lack, orders."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import pytest
from pydantic import ValidationError

import sphear.cases.patch_test as module
from sphear import VISCOSITY
from sphear.cases.lattice import Lattice, lattice
from sphear.cases.patch_test import PatchTest
from sphear.errors import SphearError, TooFewNeighboursError

ERRORS = ("l1", "l2", "max", "paper")
RADIAL = [name for name in VISCOSITY if VISCOSITY[name].radial]
SCARCE: dict[str, Any] = {"h_over_dx": 0.7, "jitter": 1.0, "viscosity": ("least_squares",), "sizes": (12,)}


def rows(**settings: Any) -> list[dict[str, Any]]:
    return PatchTest.model_validate({"sizes": (12,)} | settings).rows()


def row(**settings: Any) -> dict[str, Any]:
    (only,) = rows(**settings)
    return only


def samples(found: dict[str, Any]) -> int:
    """M, from the definition of the paper's error."""
    return round(float(found["l1"]) / float(found["paper"]))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("viscosity", ()),
        ("viscosity", "morris"),
        ("sizes", ()),
        ("sizes", (0,)),
        ("sizes", (20, -20)),
        ("sizes", (20.5,)),
        ("sizes", (10**30,)),
        ("h_over_dx", 0.0),
        ("h_over_dx", -1.0),
        ("h_over_dx", math.nan),
        ("h_over_dx", math.inf),
        ("h_over_dx", 1e300),
        ("dimension", 1),
        ("dimension", 4),
        ("jitter", -0.1),
        ("jitter", 1.1),
        ("jitter", math.nan),
        ("seed", -1),
        ("seeds", 0),
        ("edges", "open"),
        ("samples", "some"),
        ("fallback", "none"),
        ("precision", "float16"),
        ("threads", 0),
        ("unheard_of", 1),
    ],
)
def test_a_setting_that_makes_no_sense_is_refused(name: str, value: object) -> None:
    with pytest.raises(ValidationError, match=name):
        PatchTest.model_validate({name: value})


@pytest.mark.parametrize(
    ("settings", "sentence"),
    [
        ({"viscosity": ("moris",)}, "no viscosity named 'moris': did you mean morris"),
        ({"kernel": "cubik"}, "no kernel named 'cubik': did you mean cubic"),
        ({"correction": "shepherd"}, "no correction named 'shepherd': did you mean shepard"),
        ({"field": "quartik"}, "did you mean quartic"),
        ({"field": "x*z"}, "not so many dimensions"),
        ({"field": "sqrt(x)"}, r"sqrt\(x\) has no finite real value at x = -"),
        ({"viscosity": ("oger",), "correction": "shepard"}, "'oger' carries its own correction"),
        ({"field": "1e307*x**4", "edges": "truncated", "sizes": (40,)}, "too large for float64"),
        ({"field": "1e38*x**4", "precision": "float32"}, "too large for float32"),
        ({"sizes": (10_000,), "dimension": 3}, "10000 intervals a side.* too many"),
    ],
)
def test_what_cannot_be_computed_is_refused_in_a_sentence(settings: dict[str, Any], sentence: str) -> None:
    with pytest.raises(SphearError, match=sentence):
        rows(**settings)


def test_settings_do_not_change() -> None:
    with pytest.raises(ValidationError, match="frozen"):
        PatchTest().jitter = 0.5


@pytest.mark.parametrize("name", RADIAL)
def test_a_radial_term_needs_a_velocity(name: str) -> None:
    with pytest.raises(SphearError, match=f"{VISCOSITY[name].name!r} cannot act on a scalar field.*--velocity"):
        rows(viscosity=(name,))


@pytest.mark.parametrize(("h_over_dx", "least"), [(1.0, 4), (1.1, 6), (2.0, 8)])
def test_the_least_size_has_one_particle_whose_support_is_inside(h_over_dx: float, least: int) -> None:
    with pytest.raises(SphearError, match=f"size {least - 1} is too small.* at least {least},"):
        rows(sizes=(least - 1,), h_over_dx=h_over_dx)
    assert samples(row(sizes=(least,), h_over_dx=h_over_dx)) == 1


@pytest.mark.parametrize("dimension", [2, 3])
def test_interior_samples_are_those_whose_support_is_inside(dimension: int) -> None:
    assert samples(row(sizes=(9,), h_over_dx=1.0, dimension=dimension)) == 6**dimension


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("edges", ["continued", "truncated"])
def test_all_samples_are_those_of_the_whole_square(edges: str, dimension: int) -> None:
    found = row(sizes=(4,), h_over_dx=1.0, samples="all", edges=edges, dimension=dimension)
    assert samples(found) == 5**dimension


def test_edges_do_not_matter_to_particles_whose_support_is_inside() -> None:
    continued, truncated = (row(edges=edges) for edges in ("continued", "truncated"))
    assert [truncated[e] for e in ERRORS] == pytest.approx([continued[e] for e in ERRORS], rel=1e-9)


def test_truncated_edges_spoil_the_particles_near_them() -> None:
    continued, truncated = (row(edges=edges, samples="all") for edges in ("continued", "truncated"))
    assert truncated["l1"] > 100 * continued["l1"]


def on_layers(monkeypatch: pytest.MonkeyPatch, more: int, keep: int) -> None:
    """Lets the patch test have the lattice with `more` layers than it asks for, cut off `keep` layers beyond that."""

    def cut(size: int, dimension: int, *, layers: int, jitter: float, seed: int) -> Lattice:
        grid = lattice(size, dimension, layers=layers + more, jitter=jitter, seed=seed)
        kept = grid.inside >= -(layers + keep)
        return Lattice(grid.positions[kept], grid.inside[kept], grid.spacing)

    monkeypatch.setattr(module, "lattice", cut)


@pytest.mark.parametrize("velocity", [False, True])
def test_the_outer_edge_does_not_reach_the_samples_of_two_passes(
    velocity: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = []
    for keep in (0, 2):
        on_layers(monkeypatch, more=2, keep=keep)
        found.append(row(viscosity=("two_pass",), samples="all", jitter=1.0, velocity=velocity)["l2"])
    assert found[0] == pytest.approx(found[1], rel=1e-12)


@pytest.mark.parametrize(("name", "enough"), [("morris", True), ("two_pass", False)])
def test_the_layers_of_one_support_are_enough_for_one_pass_only(
    name: str, enough: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    expected = row(viscosity=(name,), samples="all")["l1"]
    on_layers(monkeypatch, more=0, keep=-6)  # leaves 3, and a support is 3.14 dx
    assert (row(viscosity=(name,), samples="all")["l1"] == pytest.approx(expected, rel=1e-9)) is enough


def test_the_order_is_that_of_the_error_between_one_size_and_the_next() -> None:
    first, *others = found = rows(viscosity=("schwaiger",), sizes=(40, 12, 20))
    assert first["order"] is None
    for before, after in itertools.pairwise(found):
        slope = math.log(after["l1"] / before["l1"]) / math.log(after["dx"] / before["dx"])
        assert after["order"] == pytest.approx(slope)
    assert [one["order"] for one in others] == pytest.approx([2, 2], abs=0.2)


def test_an_error_of_zero_has_no_order() -> None:
    assert [one["order"] for one in rows(field="3", sizes=(12, 20))] == [None, None]


def test_a_term_or_size_given_twice_counts_once() -> None:
    found = rows(viscosity=("morris", "gotoh", "VISC-01", "Morris", "E"), sizes=(12, 16, 12))
    expected = [("morris", 12), ("morris", 16), ("gotoh", 12), ("gotoh", 16)]
    assert [(one["viscosity"], one["particles"]) for one in found] == expected


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("velocity", [False, True])
def test_a_term_exact_for_cubics_is_exact(velocity: bool, dimension: int) -> None:
    """As VISC-04 is on a lattice, whose symmetry takes cubic and mixed terms out."""
    field = "polynomial-4" if velocity else "polynomial-3"  # a velocity is of one degree less
    assert row(viscosity=("oger",), velocity=velocity, dimension=dimension, field=field)["max"] < 1e-8


def regularisation(eta: float) -> float:
    """What r^2 / (r^2 + eta^2) takes away from Violeau's term in 2-D, by quadrature over the cubic spline's support."""
    r = (np.arange(200_000) + 0.5) / 100_000
    slope = np.where(r < 1, -3 * r + 2.25 * r**2, -0.75 * (2 - r) ** 2)
    return float(1 - (slope * r**4 / (r**2 + eta**2)).sum() / (slope * r**2).sum())


def test_violeau_on_a_velocity_approaches_the_laplacian_but_for_its_regularisation() -> None:
    """On a cubic velocity, where odd terms cancel, only the lattice and eta make errors, and the lattice's vanish."""
    coarse, finer, finest = (
        abs(row(viscosity=("violeau",), velocity=True, sizes=(24,), h_over_dx=h)["l1"] - regularisation(0.1))
        for h in (1.0, 2.0, 6.0)
    )
    assert coarse > 10 * finer > 1000 * finest


@pytest.mark.parametrize("name", ["violeau", "morris"])
def test_velocities_in_space(name: str) -> None:
    found = row(viscosity=(name,), velocity=True, dimension=3, field="sin(x + 2*y - z)", sizes=(8,), h_over_dx=1.6)
    assert found["l1"] < 0.05


def test_a_named_field_is_its_expression() -> None:
    named, written = row(field="quartic"), row(field="x**4 + y**4")
    assert named == written


def test_an_expression_of_the_user() -> None:
    assert row(field="sin(3*x)*exp(y)", viscosity=("least_squares_4",), sizes=(40,))["max"] < 1e-3


def test_a_harmonic_field_has_absolute_errors() -> None:
    """Of the order of rounding: 1e-16 over dx^2, whatever the number of samples."""
    assert 0 < row(field="x**2 - y**2", sizes=(40,))["l1"] < 1e-11


@pytest.mark.parametrize(
    ("settings", "what"), [({}, "viscosity 'least_squares'"), ({"viscosity": ("morris",)}, "correction 'bonet_lok'")]
)
def test_too_few_neighbours_are_counted_placed_and_have_a_remedy(settings: dict[str, Any], what: str) -> None:
    correction = {"correction": "bonet_lok", "h_over_dx": 0.5} if settings else {}
    sentence = rf"\d+ of \d+ particles have too few neighbours for {what}, the first at \(0\.\d+, 0\.\d+\): .*'nan'"
    with pytest.raises(TooFewNeighboursError, match=sentence):
        rows(**SCARCE | settings | correction)


def test_the_counted_particles_are_those_that_lack() -> None:
    with pytest.raises(TooFewNeighboursError) as refused:
        rows(**SCARCE)
    count, total = (int(word) for word in str(refused.value).split() if word.isdigit())
    kept = samples(row(**SCARCE, fallback="nan"))
    assert (total, total - count) == (9 * 9, kept)


def test_fallback_nan_leaves_out_particles_that_lack() -> None:
    assert row(**SCARCE, fallback="nan", field="polynomial-2")["max"] < 1e-6


def test_fallback_uncorrected_takes_all_particles() -> None:
    found = row(**SCARCE, fallback="uncorrected", field="polynomial-2")
    assert samples(found) == 81
    assert found["max"] > 0.1


def test_where_all_lack_the_fallback_is_morris() -> None:
    settings: dict[str, Any] = {"h_over_dx": 0.55, "jitter": 0.0}  # four neighbours
    plain = row(**settings, viscosity=("morris",))
    assert row(**settings, viscosity=("least_squares",), fallback="uncorrected") == plain | {
        "viscosity": "least_squares"
    }


def test_where_all_lack_there_is_no_error_to_give() -> None:
    with pytest.raises(TooFewNeighboursError, match=r"81 of 81 .* take a larger h_over_dx$"):
        rows(viscosity=("least_squares",), h_over_dx=0.55, fallback="nan")


def test_enough_neighbours_need_no_fallback() -> None:
    settings: dict[str, Any] = {"viscosity": ("oger",), "samples": "all", "edges": "truncated", "jitter": 0.3}
    assert rows(**settings) == rows(**settings, fallback="uncorrected") == rows(**settings, fallback="nan")


def test_errors_are_the_mean_over_the_seeds() -> None:
    settings: dict[str, Any] = {"jitter": 0.5, "sizes": (12, 16)}
    single = [rows(**settings, seed=seed) for seed in (3, 4, 5)]
    for k, mean in enumerate(rows(**settings, seed=3, seeds=3)):
        assert [mean[e] for e in ERRORS] == pytest.approx([np.mean([run[k][e] for run in single]) for e in ERRORS])


def test_a_lattice_is_computed_once_whatever_the_seeds() -> None:
    told: list[str] = []
    PatchTest(sizes=(12, 16), seeds=5).rows(told.append)
    assert told == ["12 particles a side", "16 particles a side"]


def test_progress_tells_sizes_and_seeds() -> None:
    told: list[str] = []
    PatchTest(sizes=(12,), jitter=0.1, seed=7, seeds=2).rows(told.append)
    assert told == ["12 particles a side, seed 7", "12 particles a side, seed 8"]


def test_single_precision_is_as_good_as_its_digits() -> None:
    double, single = (row(precision=precision, jitter=0.3) for precision in ("float64", "float32"))
    assert single["l1"] != double["l1"]
    assert single["l1"] == pytest.approx(double["l1"], rel=1e-3)


def test_threads_do_not_change_the_errors() -> None:
    one, two = (row(sizes=(200,), jitter=0.3, threads=threads) for threads in (1, 2))
    assert one == two
