"""Mistakes in extensions: one sentence each, with what is wrong and where."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from importlib.metadata import EntryPoint
from pathlib import Path
from typing import Any

import pytest

import sphear
from sphear.extensions import discovery, loading

TERM: Any = sphear.viscous_term
KERNEL: Any = sphear.kernel
CORRECTION: Any = sphear.correction
EQUATION: Any = sphear.equation_of_state


class NoWeight(sphear.LaplacianTerm): ...


class NoAcceleration(sphear.ViscousTerm): ...


class NoDefault(sphear.LaplacianTerm):
    strength: float
    weight = sphear.Gotoh.weight


class NoSlope(sphear.Kernel):
    support = 2.0
    sigma = (1.0, 1.0, 1.0)
    shape = sphear.WendlandC2.shape
    curvature = sphear.WendlandC2.curvature


class NoValue(sphear.Correction):
    preparation = sphear.NoCorrection.preparation
    gradient = sphear.NoCorrection.gradient


class NoDensity(sphear.Barotropic):
    pressure = sphear.Linear.pressure
    sound_speed = sphear.Linear.sound_speed


WRONG: dict[str, tuple[Callable[[], Any], str]] = {
    "taken by the package": (lambda: TERM("Morris")(sphear.Gotoh), "'Morris' is taken by sphear's own morris: choose"),
    "an alias taken": (lambda: KERNEL("k", aliases=("cubic",))(sphear.Gaussian), "'cubic' is taken by sphear's own"),
    "taken by another": (
        lambda: TERM("tripled")(sphear.Gotoh()), "'tripled' is taken by Mine of the module my_terms: choose another",
    ),
    "taken for values": (lambda: CORRECTION("mls")(sphear.Shepard), "'mls' is taken by sphear's own"),
    "no name": (lambda: TERM(NoWeight), r'takes a name: write @sphear.viscous_term\("mine"\) above NoWeight'),
    "a name with a comma": (lambda: TERM("a,b"), "a name is made of letters, digits, .*: 'a,b' is none"),
    "aliases as text": (lambda: TERM("a", aliases="b"), "the aliases of 'a' are a sequence of names"),
    "no weight": (lambda: TERM("a")(NoWeight), "the class NoWeight lacks the method weight of LaplacianTerm"),
    "no acceleration": (lambda: TERM("a")(NoAcceleration), "NoAcceleration lacks the method acceleration of ViscousT"),
    "no default": (lambda: TERM("a")(NoDefault), "the field strength of NoDefault has no default: give it one, or"),
    "no slope": (lambda: KERNEL("a")(NoSlope), "the class NoSlope lacks the method slope of Kernel"),
    "no value": (lambda: CORRECTION("a")(NoValue), "the class NoValue lacks the method value of Correction"),
    "no density": (lambda: EQUATION("a")(NoDensity), "the class NoDensity lacks the method density of EquationOfState"),
    "another kind": (lambda: TERM("a")(sphear.WendlandC2), "names a class derived from .*, not the class WendlandC2"),
    "no class": (lambda: CORRECTION("a")(3), "derived from sphear.Correction, or an object of one, not 3"),
    "an object of a kernel": (lambda: KERNEL("a")(sphear.Gaussian(1.0)), "class derived from sphear.Kernel, not Gauss"),
    "no weight's function": (lambda: TERM("a")(lambda r2: r2), r"arguments are \(kernel, correction, own, d, r2\)"),
}  # fmt: skip


@pytest.mark.usefixtures("my_terms")
@pytest.mark.parametrize("what", WRONG)
def test_a_wrong_definition_is_refused_in_one_sentence(what: str) -> None:
    call, sentence = WRONG[what]
    with pytest.raises(sphear.SphearError, match=sentence) as raised:
        call()
    assert "\n" not in str(raised.value)
    assert set(sphear.VISCOSITY) - sphear.VISCOSITY.published == {"mine", "tripled", "by_function"}


def test_a_kernel_without_its_factors_is_refused() -> None:
    class Incomplete(sphear.Kernel):
        shape = sphear.WendlandC2.shape
        slope = sphear.WendlandC2.slope
        curvature = sphear.WendlandC2.curvature

    with pytest.raises(sphear.SphearError, match="the class Incomplete lacks the attribute support of Kernel"):
        sphear.kernel("incomplete")(Incomplete)


FILES = {
    "an error": ("import sphear\n\nx = unknown\n", "line 3, NameError: name 'unknown' is not defined"),
    "no Python": ("def f(:\n", "line 1, SyntaxError: invalid syntax"),
    "a name taken": (
        "import sphear\nsphear.viscous_term('morris')(sphear.Gotoh)\n", "line 2, the viscosity name 'morris' is taken",
    ),
    "another module": ("import nowhere_at_all\n", "line 1, ModuleNotFoundError: No module named 'nowhere_at_all'"),
    "an exit": ("import sys\nsys.exit(3)\n", "line 2, SystemExit: 3"),
}  # fmt: skip


@pytest.mark.parametrize("what", FILES)
def test_a_file_that_cannot_be_imported_is_named_with_line_and_reason(what: str, tmp_path: Path) -> None:
    text, sentence = FILES[what]
    file = tmp_path / "broken.py"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(sphear.SphearError) as raised:
        loading.load([str(file)])
    assert f"broken.py' cannot be imported: {sentence}" in str(raised.value)
    assert loading.loaded() == ()


def test_a_file_whose_name_is_that_of_a_module_is_refused(tmp_path: Path) -> None:
    (tmp_path / "colorsys.py").write_text("")
    with pytest.raises(sphear.SphearError, match="'colorsys' is no free name of a module, so give the file another"):
        loading.load([str(tmp_path / "colorsys.py")])


@pytest.mark.parametrize("name", ["nowhere.py", "nowhere", "nowhere.at_all", ""])
def test_what_is_not_there_is_said_to_be_missing(name: str) -> None:
    with pytest.raises(sphear.SphearError, match=r"there is no|cannot be imported"):
        loading.load([name])


def test_an_entry_point_that_fails_is_a_warning_and_the_others_are_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "failing_extension.py").write_text("import sphear\n1 / 0\n")
    working = "import sphear\nsphear.viscous_term('works')(sphear.Gotoh(printed=True))\n"
    (tmp_path / "working_extension.py").write_text(working)
    points = [EntryPoint(f"{name}er", f"{name}_extension", discovery.GROUP) for name in ("failing", "working")]
    monkeypatch.setattr(discovery, "entry_points", lambda group: points)
    monkeypatch.setattr(discovery, "_done", False)
    with pytest.warns(sphear.SphearWarning) as told:
        assert "works" in sphear.VISCOSITY
    assert len(told) == 1
    assert "'failing_extension' of the package failinger cannot be imported" in str(told[0].message)
    assert str(told[0].message).endswith("failing_extension.py, line 2, ZeroDivisionError: division by zero")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert "morris" in sphear.VISCOSITY


def test_a_known_name_looks_for_no_entry_points(monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patch:
        patch.setattr(discovery, "_done", False)
        patch.setattr(discovery, "entry_points", lambda group: pytest.fail("looked for"))
        assert sphear.VISCOSITY["morris"] == sphear.Morris()
        assert "morris" in sphear.VISCOSITY
