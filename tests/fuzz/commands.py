"""Malformed command lines, drawn at random: each is wrong by construction, whatever is drawn."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from typing import NamedTuple

from .words import broken_expression, broken_shape, no_float, no_int, no_name, no_text

CASES = ("poiseuille", "couette", "taylor-green", "cavity", "cavity-cylinder", "dam-break")
BOTH = ("poiseuille", "couette", "taylor-green", "cavity")  # schemes
INCOMPRESSIBLE = ("dam-break",)
POSITIVE = ("reynolds", "until", "time_step", "h_over_dx", "shifting_strength")
COUNTS = ("resolution", "max_steps", "threads")
NAMES = ("kernel", "viscosity", "correction", "continuation", "initial", "scheme")
EXPLICIT_ONLY = ("density=continuity", "walls=fixed", "sound_speed=10", "integrator=midpoint", "transport=none")
INCOMPRESSIBLE_ONLY = ("alpha=0.1", "projection=start", "tolerance=1e-3", "viscous_step=explicit")
CONTRADICTIONS = (
    ("explicit", "density=summation", "momentum=products"), ("explicit", "density=continuity", "momentum=squares"),
    ("explicit", "density=summation", "density_diffusion=0.1"),
    ("explicit", "density=summation", "wall_divergence=slipping"),
    ("explicit", "density=continuity", "walls=fixed", "wall_divergence=slipping"),
    ("explicit", "walls=fixed", "wall_particles=true"),
    ("explicit", "density=continuity", "transport=transport_velocity"),
    ("explicit", "equation_of_state=ideal_gas", "transport=shifting", "walls=mirror"),
    ("explicit", "equation_of_state=ideal_gas", "sound_speed=3", "walls=mirror"),
    ("incompressible", "gradient=symmetric", "gradient_correction=bonet_lok"), ("incompressible", "alpha=2"),
    ("incompressible", "tolerance=1"), ("incompressible", "resolution=2"), ("explicit", "resolution=2"),
    ("explicit", "time_step=1e6"), ("incompressible", "time_step=1e6"), ("explicit", "h_over_dx=0.01"),
)  # fmt: skip
PATCH_NAMES = ("--viscosity", "--kernel", "--correction", "--edges", "--samples", "--fallback", "--precision")
PATHS = ("", " ", "taken", "taken/below", "/dev/null", "/dev/null/below", "x" * 300, "nowhere")


class Command(NamedTuple):
    """A command line and the kind of what is wrong with it."""

    kind: str
    arguments: list[str]


Draw = random.Random


def commands(count: int, seed: int = 0) -> Iterator[Command]:
    """So many malformed command lines, the kinds in turn."""
    draw = random.Random(seed)
    makers = list(MAKERS.items())
    for number in range(count):
        kind, make = makers[number % len(makers)]
        yield Command(kind, make(draw))


def _case(draw: Draw) -> tuple[str, str]:
    """A case and a scheme that it has."""
    case = draw.choice(CASES)
    return case, draw.choice(("explicit", "incompressible")) if case in BOTH else "incompressible"


def _wrapped(draw: Draw, case: str, scheme: str, *settings: str) -> list[str]:
    """Wrong settings of a run, or of a sweep over something that is right."""
    options = [text for setting in (f"scheme={scheme}", *settings) for text in ("--set", setting)]
    options += draw.choice(((), ("--json",), ("--out", "results")))
    if draw.random() < 0.7:
        return ["run", case, *options]
    return ["sweep", case, "--over", "seed=1,2", *options, *(() if "--out" in options else ("--out", "results"))]


def _unknown_command(draw: Draw) -> list[str]:
    return [no_name(draw, ("run", "sweep", "list", "show", "patch-test", "reproduce")), *draw.choice(((), ("cavity",)))]


def _unknown_case(draw: Draw) -> list[str]:
    case = no_name(draw, CASES)
    return draw.choice((["run", case], ["sweep", case, "--over", "reynolds=1,2", "--out", "r"], ["show", "case", case]))


def _no_float(draw: Draw) -> list[str]:
    case, scheme = _case(draw)
    key = draw.choice(POSITIVE if scheme == "explicit" else (*POSITIVE, "tolerance"))
    return _wrapped(draw, case, scheme, f"{key}={no_float(draw)}")


def _no_int(draw: Draw) -> list[str]:
    case, scheme = _case(draw)
    return _wrapped(draw, case, scheme, f"{draw.choice(COUNTS)}={no_int(draw)}")


def _no_option_number(draw: Draw) -> list[str]:
    option = draw.choice(("--reynolds", "--until", "--resolution"))
    text = no_int(draw) if option == "--resolution" else no_float(draw)
    return ["run", draw.choice(CASES), f"{option}={text}"]


def _no_choice(draw: Draw) -> list[str]:
    case, scheme = _case(draw)
    key = draw.choice(NAMES)
    if key == "scheme":
        return ["run", case, "--set", f"scheme={no_name(draw, ('explicit', 'incompressible'))}"]
    return _wrapped(draw, case, scheme, f"{key}={no_name(draw, ('morris', 'cubic_spline', 'lattice', 'linear'))}")


def _no_bool(draw: Draw) -> list[str]:
    case, scheme = _case(draw)
    return _wrapped(draw, case, scheme, f"force={draw.choice(('2', 'maybe', '-1', 'ja'))}")


def _unknown_setting(draw: Draw) -> list[str]:
    case, scheme = _case(draw)
    return _wrapped(draw, case, scheme, f"{no_name(draw, (*POSITIVE, *COUNTS, *NAMES))}={draw.choice('1ab')}")


def _other_scheme(draw: Draw) -> list[str]:
    if draw.random() < 0.3:
        return ["run", draw.choice(INCOMPRESSIBLE), "--set", "scheme=explicit"]
    case, scheme = _case(draw)
    return _wrapped(draw, case, scheme, draw.choice(EXPLICIT_ONLY if scheme != "explicit" else INCOMPRESSIBLE_ONLY))


def _contradiction(draw: Draw) -> list[str]:
    scheme, *settings = draw.choice(CONTRADICTIONS)
    return _wrapped(draw, draw.choice(("poiseuille", "cavity")), scheme, *settings)


def _form(draw: Draw) -> list[str]:
    """Settings that are not KEY=VALUE, given twice, or in two ways."""
    case = draw.choice(CASES)
    return ["run", case, *draw.choice((
        ["--set", "kernel"], ["--set", "reynolds=1", "--set", "reynolds=2"], ["--set"], ["--reynolds"],
        ["--reynolds", "1", "--set", "reynolds=1"], ["--set", ""], ["--set", "="], ["--set", "=1"], ["extra"],
        [f"--{no_name(draw, ('reynolds', 'json'))}"], ["--preset", no_name(draw, ("basa2009", "zheng2018"))],
        ["--set", f"kernel={no_text(draw)}"], ["--set", no_text(draw)], ["--viscosity", no_text(draw)],
    ))]  # fmt: skip


def _solid(draw: Draw) -> list[str]:
    return _wrapped(draw, draw.choice(("cavity", "poiseuille")), "incompressible", f"solid={broken_shape(draw)}")


def _place(draw: Draw) -> list[str]:
    """Output folders that cannot be, and runs to go on with that are not there."""
    out = draw.choice(PATHS)
    if draw.random() < 0.3:
        return ["run", draw.choice(CASES), "--resume", *draw.choice(((), ("--out", out)))]
    out = out if out != "nowhere" else "taken"
    return draw.choice((
        ["run", draw.choice(CASES), "--out", out], ["patch-test", "--sizes", "12", "--out", out],
        ["sweep", "cavity", "--over", "seed=1,2", "--out", out], ["reproduce", "zheng2018", "table-1", "--out", out],
    ))  # fmt: skip


def _sweep(draw: Draw) -> list[str]:
    over = draw.choice((
        ["--over", f"reynolds=1,{no_float(draw)}"], ["--over", f"resolution=10,{no_int(draw)}"],
        ["--over", "seed=1,,2"],
        ["--over", "seed"], ["--over", "=1,2"], [], ["--over", "seed=1", "--over", "seed=2"], ["--over", "seed="],
        ["--over", "seed=1,2", "--set", "seed=1"], ["--over", "kernel=a,b"], ["--over", f"{no_text(draw)}=1,2"],
        ["--over", f"scheme=explicit,{no_name(draw, ('incompressible',))}"], ["--over", "reynolds=(1,2"],
        ["--over", "seed=1,2", "--workers", draw.choice(("0", "-1", "1.5", "a", "nan", ""))],
        ["--over", "seed=1,2", "--scheduler", draw.choice(("", " ", "nowhere", "tcp://", "a:b", "x://y:1", "::"))],
        ["--over", "seed=1,2", "--workers", "2", "--scheduler", "tcp://127.0.0.1:9"],
        ["--over", "seed=" + ",".join(map(str, range(400))), "--over", "reynolds=" + ",".join(map(str, range(1, 401)))],
    ))  # fmt: skip
    return ["sweep", draw.choice(CASES), *over, "--out", "results"]


def _patch_number(draw: Draw) -> list[str]:
    option = draw.choice(("--h-over-dx", "--jitter", "--seeds", "--seed", "--threads", "--sizes", "--dim"))
    if option in ("--h-over-dx", "--jitter"):
        text = draw.choice(("nan", "inf", "-1", "1e9", "a", "", "0x1", "1,5", "½"))
    else:
        text = no_int(draw) if option != "--seed" else draw.choice(("-1", "a", "1.5", "nan", ""))
    return ["patch-test", f"{option}={text}", *draw.choice(((), ("--json",), ("--out", "results")))]


def _patch_name(draw: Draw) -> list[str]:
    name = no_name(draw, ("morris", "cubic_spline", "shepard", "continued", "all", "nan", "float64"))
    return ["patch-test", f"{draw.choice(PATCH_NAMES)}={name}", "--sizes", "12"]


def _field(draw: Draw) -> list[str]:
    return ["patch-test", f"--field={broken_expression(draw)}", "--sizes", "12", *draw.choice(((), ("--velocity",)))]


def _catalogue(draw: Draw) -> list[str]:
    kind = draw.choice(("kernel", "viscosity", "correction", "preconditioner", "case", "study"))
    return draw.choice((
        ["show", kind, no_name(draw, ("morris", "cavity", "zheng2018"))], ["show", kind], ["show"],
        ["show", no_name(draw, ("kernel", "case")), "morris"], ["list", no_name(draw, ("kernels", "cases"))],
        ["list", "kernels", "more"], ["reproduce", no_name(draw, ("zheng2018", "basa2009"))], ["reproduce"],
        ["reproduce", "zheng2018", no_name(draw, ("table-1", "figure-2"))],
        ["reproduce", "zheng2018", "table-1", "--workers", draw.choice(("0", "-1", "a", "1.5", "nan"))],
        ["show", kind, no_text(draw)], ["list", no_text(draw)],
    ))  # fmt: skip


MAKERS: dict[str, Callable[[Draw], list[str]]] = {
    "command": _unknown_command, "case": _unknown_case, "float": _no_float, "int": _no_int,
    "option": _no_option_number, "choice": _no_choice, "bool": _no_bool, "setting": _unknown_setting,
    "scheme": _other_scheme, "contradiction": _contradiction, "form": _form, "solid": _solid, "place": _place,
    "sweep": _sweep, "patch number": _patch_number, "patch name": _patch_name, "field": _field,
    "catalogue": _catalogue,
}  # fmt: skip
