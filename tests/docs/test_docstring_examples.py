"""Every public name has an example that a reader can paste, and it gives what it says."""

from __future__ import annotations

import doctest
import re
import sys
import warnings
from pathlib import Path
from types import FunctionType, ModuleType

import pytest

import sphear

DOCS = Path(__file__).parents[2] / "docs"
NAMES = (DOCS / "reference" / "names.md").read_text(encoding="utf-8")
RUN_ELSEWHERE = (  # by test_pages_run.py and test_extending_page.py
    "tutorial.md",
    "how-to/compare-with-a-reference.md",
    "how-to/extending.md",
    "how-to/move-from-0.1.md",
    "how-to/read-results.md",
    "how-to/resume.md",
    "how-to/run-a-case.md",
    "how-to/simulations.md",
)
BLOCK = re.compile(r"```python\n(.*?)```", re.DOTALL)
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
REGISTRIES = (
    sphear.CORRECTIONS,
    sphear.EQUATIONS_OF_STATE,
    sphear.INTEGRATORS,
    sphear.KERNELS,
    sphear.PRECONDITIONERS,
    sphear.SHIFTING,
    sphear.VISCOSITY,
    sphear.WALL_MODELS,
)


def mentions(name: str, code: str) -> bool:
    """True if code uses a public name."""
    return re.search(rf"\bsphear(\.| import ){name}\b", code) is not None


def own_docstring(name: str) -> str:
    """The docstring of a class, function or module; none of other objects, which would have that of their class."""
    found = getattr(sphear, name)
    if isinstance(found, type):
        return vars(found).get("__doc__") or ""
    return (found.__doc__ or "") if isinstance(found, FunctionType | ModuleType) else ""


def shown(name: str) -> list[str]:
    """The texts with lines at the prompt that show a name: its docstring, else the blocks of names.md that use it."""
    if code_of(own_docstring(name)):
        return [own_docstring(name)]
    return [block for block in BLOCK.findall(NAMES) if mentions(name, code_of(block))]


def code_of(text: str) -> str:
    """The code at the prompts of a text."""
    return "".join(example.source for example in doctest.DocTestParser().get_examples(text))


def gives_something(text: str) -> bool:
    """True if a line at a prompt of a text is followed by what it gives."""
    return any(example.want for example in doctest.DocTestParser().get_examples(text))


def faults(text: str, name: str) -> str:
    """Run the examples of a text as at a reader's prompt; what doctest reports."""
    module = ModuleType("example")
    sys.modules["example"] = module
    reported: list[str] = []
    test = doctest.DocTestParser().get_doctest(text, vars(module), name, None, None)
    try:
        with warnings.catch_warnings():
            doctest.DocTestRunner(optionflags=FLAGS, verbose=False).run(test, out=reported.append)
    finally:
        del sys.modules["example"]
        for registry in REGISTRIES:
            for added in set(registry) - registry.published:
                registry.remove(added)
    return "".join(reported)


@pytest.mark.parametrize("name", sphear.__all__)
def test_a_public_name_has_an_example_that_gives_what_it_says(
    name: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)  # of a sweep's results
    texts = shown(name)
    pages = (block for page in RUN_ELSEWHERE for block in BLOCK.findall((DOCS / page).read_text(encoding="utf-8")))
    assert texts or any(mentions(name, block) for block in pages), f"{name} has no example"
    assert all(gives_something(text) for text in texts), f"the example of {name} gives nothing"
    assert "".join(faults(text, name) for text in texts) == ""


def test_an_example_that_gives_something_else_is_seen() -> None:
    assert "Expected:" in faults(">>> import sphear\n>>> sphear.CubicSpline(h=0.1).radius\n0.3\n", "wrong")
    assert "Error" in faults(">>> import sphear\n>>> sphear.Nothing\n", "wrong")
    assert faults(">>> import sphear\n>>> round(sphear.CubicSpline(h=0.1).radius, 1)\n0.2\n", "right") == ""


def test_a_name_without_an_example_is_seen() -> None:
    assert not mentions("Lind", code_of("Args:\n    >>> sphear.Linear(1.0, 2.0)\n"))
    assert code_of("Args:\n    sphear.Linear(1.0, 2.0)\n") == ""
    assert not gives_something(">>> import sphear\n>>> model = sphear.SFDI()\n")
    assert own_docstring("KERNELS") == ""  # not that of its class
