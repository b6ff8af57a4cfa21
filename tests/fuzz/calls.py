"""Malformed calls of the library, drawn at random: each is wrong by construction, whatever is drawn."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from .words import broken_expression, broken_shape, no_name

Draw = random.Random

SIDE = 8  # particles
NOTHING: tuple[Any, ...] = (None, "abc", object(), {}, 3, "")
NO_POSITIVE: tuple[Any, ...] = (
    0,
    0.0,
    -1,
    -0.5,
    float("nan"),
    float("inf"),
    -float("inf"),
    "a",
    "",
    [],
    {},
    1j,
    10**400,
)
NO_COUNT: tuple[Any, ...] = (0, -1, 1.5, "a", float("nan"), float("inf"), [], {}, 1j, "")


class Call(NamedTuple):
    """A call, the kind of what is wrong with it, and itself in words."""

    kind: str
    words: str
    make: Callable[[], Any]


def calls(count: int, seed: int, folder: Path) -> Iterator[Call]:
    """So many malformed calls, the kinds in turn.

    Args:
        count: of calls.
        seed: of what is drawn.
        folder: an empty one, for what takes a folder.
    """
    draw = random.Random(seed)
    makers = list(MAKERS.items())
    for number in range(count):
        kind, make = makers[number % len(makers)]
        words, call = make(draw, folder)
        yield Call(kind, words[:200], call)


Made = tuple[str, Callable[[], Any]]


def _call(function: Callable[..., Any], *arguments: Any, **named: Any) -> Made:
    words = ", ".join([*(_short(value) for value in arguments), *(f"{key}={_short(x)}" for key, x in named.items())])
    return f"{getattr(function, '__name__', function)}({words})", lambda: function(*arguments, **named)


def _short(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"array{value.shape}{value.dtype}"
    return repr(value) if isinstance(value, str | int | float | type(None)) else type(value).__name__


def particles() -> tuple[Any, Any]:
    """A lattice (N, 2) and a field on it."""
    ticks = (np.arange(SIDE) + 0.5) / SIDE
    positions = np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 2)
    return positions, np.sin(positions[:, 0])


def _with(values: Any, index: Any, wrong: Any) -> Any:
    changed = np.array(values)
    changed[index] = wrong
    return changed


def _operator(draw: Draw, _folder: Path) -> Made:
    """An operator with one argument that is wrong."""
    import sphear

    x, f = particles()
    name = draw.choice(("laplacian", "gradient", "interpolate", "viscous_acceleration"))
    fields = np.stack((f, f), axis=1) if name == "viscous_acceleration" else f
    wrong_numbers = (float("nan"), float("inf"), -float("inf"))
    positions = (
        *NOTHING, [], np.empty((0, 2)), np.zeros((4, 4)), x.astype(complex) + 1j, [[1, 2], [3]], x[:, :, None], x[:1],
        x.astype(str), _with(x, (3, 1), draw.choice(wrong_numbers)), _with(x, 1, x[0]), np.zeros_like(x), np.array(3.0),
    )  # fmt: skip
    values = (
        *NOTHING[:4], f[:-1], np.append(f, 1.0), _with(fields, 2, draw.choice(wrong_numbers)), f.astype(complex) + 1j,
        f.astype(str), [], np.zeros((len(f), 2, 2)), [object()] * len(f), np.zeros((2, len(f))),
    )  # fmt: skip
    choices: dict[str, tuple[Any, ...]] = {
        "kernel": (*NOTHING, no_name(draw, ("cubic_spline",))),
        "h_over_dx": (*NO_POSITIVE, 1e-320), "spacing": (*NO_POSITIVE, [0.1, 0.2]),
        "correction": (no_name(draw, ("shepard",)), 7, -1, object(), 1.5, []),
        "volumes": (0, -1.0, float("nan"), "a", f[:-1], -np.ones(len(f)), _with(f, 1, float("inf")), object(), []),
        "domain": ("box", 3, object(), ((0, 0), (1, 1)), []), "precision": ("half", 32, None, "", float, []),
        "threads": NO_COUNT,
    }  # fmt: skip
    if name != "interpolate":
        choices["fallback"] = ("zero", 3, [], True, "")
    if name in ("laplacian", "viscous_acceleration"):
        choices["viscosity"] = (*NOTHING, no_name(draw, ("morris",)), [])
    if name == "interpolate":
        choices["at"] = ("a", object(), np.zeros((3, 3)), [[float("nan"), 0.0]], np.zeros((2, 2, 2)), [[1j, 0]], {})
    if name == "viscous_acceleration":
        bad: tuple[Any, ...] = (-1.0, float("nan"), float("inf"), "a", f[:-1], [], object(), 1j)
        choices |= {"dynamic_viscosity": bad, "density": (*bad, 0.0)}
    which = draw.choice(("positions", "values", *choices))
    arguments, named = [x, fields], dict[str, Any]()
    if which == "positions":
        arguments[0] = draw.choice(positions)
    elif which == "values":
        arguments[1] = draw.choice(values)
    else:
        named = {which: draw.choice(choices[which])}
    return _call(getattr(sphear, name), *arguments, **named)


def _flow(draw: Draw, _folder: Path) -> Made:
    import sphear

    settings: dict[str, tuple[Any, ...]] = {
        "reynolds": NO_POSITIVE, "until": NO_POSITIVE, "time_step": NO_POSITIVE, "resolution": NO_COUNT,
        "h_over_dx": NO_POSITIVE, "seed": (-1, 1.5, "a", [], None), "max_steps": NO_COUNT, "threads": NO_COUNT,
        "kernel": (*NOTHING, no_name(draw, ("gaussian",))), "viscosity": (*NOTHING, no_name(draw, ("morris",))),
        "scheme": (*NOTHING, no_name(draw, ("explicit",))), "initial": NOTHING, "force": ("maybe", 2, [], None),
        "preset": ("q", 3, "", [], object()), no_name(draw, ("reynolds",)): (1, None),
    }  # fmt: skip
    if draw.random() < 0.2:
        return _call(sphear.flow, draw.choice((*NOTHING, no_name(draw, ("cavity",)), [], 1.5, b"cavity")))
    key = draw.choice(list(settings))
    return _call(
        sphear.flow, draw.choice(("cavity", "poiseuille", "taylor-green")), **{key: draw.choice(settings[key])}
    )


def _patch_test(draw: Draw, _folder: Path) -> Made:
    from sphear.cases.patch_test import PatchTest

    settings: dict[str, tuple[Any, ...]] = {
        "sizes": ((0,), (-3,), (), "a", ("a",), None, 3, (1.5,), (10**8,)), "jitter": (-1, 2, "a", float("nan"), None),
        "viscosity": ((), ("q",), (None,), 3, None), "kernel": (*NOTHING, "q"), "dimension": (1, 4, "a", None, 2.5),
        "field": (*NOTHING, broken_expression(draw)), "seeds": NO_COUNT, "h_over_dx": NO_POSITIVE, "samples": NOTHING,
        "edges": NOTHING, "precision": NOTHING, "threads": NO_COUNT, "correction": ("q", 9, [], object()), "q": (1, 2),
    }  # fmt: skip
    key = draw.choice(list(settings))
    words, make = _call(PatchTest, **{"sizes": (12,), key: draw.choice(settings[key])})
    return words, lambda: make().rows()


def _box(draw: Draw, _folder: Path) -> Made:
    from sphear import Domain
    from sphear.boundaries import Box

    low, high = draw.choice((
        ((0.0, 0.0), (0.0, 1.0)), ((0.0, 0.0), (-1.0, 1.0)), ((0.0, 0.0), (1.0,)), ((), ()), (None, None), ("ab", "cd"),
        ((0.0, float("nan")), (1.0, 1.0)), ((0.0, 0.0), (1.0, float("inf"))), ((0.0, "a"), (1.0, 1.0)), (1.0, 2.0),
    ))  # fmt: skip
    right, sides = ((0.0, 0.0), (1.0, 1.0)), draw.choice((("walls",), ("open", "walls"), "ab", None, (1, 2), ()))
    if draw.random() < 0.4:
        return _call(Domain, low, high, (True, True))
    if draw.random() < 0.2:
        wrong = draw.choice(((1.0,), (1.0, 2.0, 3.0), (float("nan"), 0.0), ("a", "b"), 3.0))
        return _call(Box, *right, ("walls", "walls"), **{draw.choice(("lower_velocity", "upper_velocity")): wrong})
    return _call(Box, low, high, ("walls", "walls")) if draw.random() < 0.5 else _call(Box, *right, sides)


def _shape(draw: Draw, _folder: Path) -> Made:
    from sphear.boundaries import shapes

    point = draw.choice(((0.0,), (0.0, 0.0, 0.0), None, "ab", (float("nan"), 0.0), (0.0, float("inf")), 3.0, ((), ())))
    triangle = ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))
    return draw.choice((
        lambda: _call(shapes.Circle, point, 0.1), lambda: _call(shapes.Circle, (0.5, 0.5), draw.choice(NO_POSITIVE)),
        lambda: _call(shapes.Rectangle, point, (1.0, 1.0)), lambda: _call(shapes.Rectangle, (0.0, 0.0), (-1.0, 1.0)),
        lambda: _call(shapes.HalfPlane, point, (1.0, 0.0)), lambda: _call(shapes.HalfPlane, (0.0, 0.0), (0.0, 0.0)),
        lambda: _call(shapes.Polygon, (point, *triangle)), lambda: _call(shapes.Polygon, triangle[:2]),
        lambda: _call(shapes.Polygon, draw.choice((None, "abc", 3, (), ((0, 0), (1, 1), (2, 2))))),
        lambda: _call(shapes.Polygon, triangle, draw.choice(({9: (1, 0)}, {"a": (1, 0)}, {0: (1,)}, {0: "a"}, 3, [1]))),
        lambda: _call(shapes.written, broken_shape(draw)), lambda: _call(shapes.Circle, (0.5, 0.5), 0.1, "a"),
    ))()  # fmt: skip


def _kernel(draw: Draw, _folder: Path) -> Made:
    import sphear

    name = draw.choice(("CubicSpline", "Gaussian", "QuarticSpline", "QuinticSpline", "WendlandC2", "WendlandC6"))
    return _call(getattr(sphear, name), draw.choice((*NO_POSITIVE, None)))


def _term(draw: Draw, _folder: Path) -> Made:
    import sphear
    from sphear.corrections import CORRECTIONS
    from sphear.kernels import KERNELS
    from sphear.viscosity import VISCOSITY

    registry = draw.choice((VISCOSITY, KERNELS, CORRECTIONS))
    words = draw.choice((*NOTHING[:3], no_name(draw, ("morris",)), 1.5, (), b"morris"))
    if draw.random() < 0.3:
        return _call(sphear.Cleary, xi=draw.choice(NO_POSITIVE))
    return _call(registry.name, words)


def _settings(draw: Draw, _folder: Path) -> Made:
    from sphear.schemes.incompressible.settings import IncompressibleSettings
    from sphear.schemes.weakly_compressible.settings import WeaklyCompressibleSettings

    kind = draw.choice((WeaklyCompressibleSettings, IncompressibleSettings))
    key = draw.choice(
        ("reynolds", "resolution", "until", "time_step", "max_steps", "seed", "initial", "q", "h_over_dx")
    )
    wrong: dict[str, tuple[Any, ...]] = {
        "resolution": NO_COUNT, "max_steps": NO_COUNT, "seed": (-1, 1.5, "a", None, []), "initial": NOTHING, "q": (1,),
    }  # fmt: skip
    return _call(kind, **{key: draw.choice(wrong.get(key, NO_POSITIVE))})


def _problem(draw: Draw, _folder: Path) -> Made:
    from sphear.boundaries import Box
    from sphear.schemes.problem import Problem

    x, _ = particles()
    right: dict[str, Any] = {
        "positions": x, "velocities": np.zeros_like(x), "box": Box((0.0, 0.0), (1.0, 1.0), ("periodic", "periodic")),
        "body_force": (0.0, 0.0), "spacing": 1 / SIDE, "density": 1.0, "kinematic_viscosity": 1.0, "speed": 1.0,
        "length": 1.0,
    }  # fmt: skip
    key = draw.choice(list(right))
    arrays = (*NOTHING, x[:-1], x[:, :1], x.astype(str), x[:, 0], [[1, 2], [3]], x.astype(complex) + 1j)
    wrong = {
        "positions": arrays, "velocities": arrays, "box": NOTHING,
        "body_force": (*NOTHING, (1.0,), (1.0, float("nan")), ("a", "b"), (1.0, 2.0, 3.0)),
        "kinematic_viscosity": (-1.0, float("nan"), float("inf"), "a", None, np.ones(3), [], 1j),
    }.get(key, (*NO_POSITIVE, None, np.ones(3)))  # fmt: skip
    return _call(Problem, **{**right, key: draw.choice(wrong)})


def _sweep(draw: Draw, folder: Path) -> Made:
    from sphear.sweeps import Store, plan, run_sweep

    (folder / "taken").touch()
    right = {"seed": [1, 2]}
    over: Any = draw.choice((
        {"reynolds": [1, draw.choice(NO_POSITIVE)]}, {"seed": []}, {"seed": "12"}, {"seed": 3}, {"seed": None}, None, 3,
        {"q": [1]}, {3: [1]}, {"kernel": ["q"]}, {"kernel": [None]}, {"resolution": [10**3, 0]}, [("seed", [1])], "ab",
        {"seed": {1: 2}}, {"seed": 1.5}, {"seed": range(10**6)}, {"scheme": ["q"]},
    ))  # fmt: skip
    runs = draw.choice((None, 3, "ab", [1], [None]))
    return draw.choice((
        lambda: _call(plan, "poiseuille", over), lambda: _call(plan, "poiseuille", over),
        lambda: _call(plan, draw.choice((*NOTHING, "q")), right),
        lambda: _call(plan, "cavity", right, draw.choice((3, "ab", {"seed": 1}, {"q": 1}, [1]))),
        lambda: _call(run_sweep, [], Store(folder), workers=draw.choice(NO_COUNT)),
        lambda: _call(run_sweep, plan("cavity", right), Store(folder), scheduler=draw.choice((3, "a", "tcp://", "x://y:1"))),
        lambda: _call(run_sweep, runs, Store(folder)), lambda: _call(run_sweep, [], draw.choice((None, "a", 3))),
        lambda: _call(Store, draw.choice((None, 3, folder / "taken", 1.5, "x" * 300, "a\x00b", []))),
    ))()  # fmt: skip


MAKERS: dict[str, Callable[[Draw, Path], Made]] = {
    "operator": _operator, "flow": _flow, "patch test": _patch_test, "box": _box, "shape": _shape, "kernel": _kernel,
    "name": _term, "settings": _settings, "problem": _problem, "sweep": _sweep, "operator too": _operator,
}  # fmt: skip
