"""The examples: each at a small size against what it is compared with, and its page in the documentation."""

import ast
import importlib
import re
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
EXAMPLES, PAGES = ROOT / "examples", ROOT / "docs" / "examples"
LARGEST = 150_000  # bytes of a picture

# a small resolution, and for some of the numbers the bounds between which they are; measured values beside them
NUMBERS: dict[str, tuple[int, dict[str, tuple[float, float]]]] = {
    "first_flow": (24, {  # from 15 to 18 a side it scatters with the particles from 0.032 to 0.061
        "deviation from the published one": (0.0, 0.04),  # 0.009, 0.024
    }),
    "own_region": (20, {
        "net flow over flow": (-0.08, 0.08),  # -0.0633
        "particles in solids": (0, 0),  # 0
    }),
    "own_viscous_term": (20, {
        "rate of decay over the exact one, less 1": (-0.022, 0.0),  # -0.0170
        "error of the velocities": (0.0, 0.0095),  # 0.00775
    }),
    "patch_test": (40, {
        "order of morris": (-0.9, -0.7),  # -0.793
        "order of fatehi_manzari": (1.85, 2.05),  # 1.930
        "order of least_squares_3": (1.9, 2.05),  # 1.975
    }),
    "convergence": (40, {
        "observed order": (2.6, 3.3),  # 2.98
        "error of the velocities": (0.0, 0.0036),  # 0.00299
    }),
    "channel_between_plates": (16, {
        "largest deviation from the series": (0.0, 0.002),  # 0.00155
        "at the end": (0.0, 1e-4),  # 0.000059
    }),
    "cavity_against_reference": (24, {  # from 15 to 18 a side they scatter with the particles from 0.005 to 0.011
        "mean deviation of u": (0.0, 0.006),  # 0.0034, 0.0042
        "mean deviation of v": (0.0, 0.006),  # 0.0035, 0.0036
    }),
    "turning_drum": (16, {
        "largest deviation from the series": (0.0, 0.05),  # 0.0435
        "angular momentum over the exact one": (0.99, 1.01),  # 1.0074
    }),
    "dam_break": (10, {
        "mean deviation of the front": (0.0, 0.25),  # 0.220
        "speed of the front over the measured one": (0.93, 1.05),  # 0.993
    }),
    "sweep_read_into_a_table": (32, {
        "error at the finest spacing": (0.0, 0.045),  # 0.0399
        "order at Re = 100": (1.4, 2.0),  # 1.69
    }),
}  # fmt: skip


def imported(name: str, monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.syspath_prepend(ROOT)
    return importlib.import_module(f"examples.{name}")


def page(name: str) -> str:
    return (PAGES / f"{name}.md").read_text(encoding="utf-8")


def source(name: str) -> str:
    return (EXAMPLES / f"{name}.py").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", NUMBERS)
def test_an_example_comes_near_what_it_is_compared_with(
    name: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    resolution, bounds = NUMBERS[name]
    found = imported(name, monkeypatch).main(resolution=resolution, folder=tmp_path)
    assert all(least <= found[number] <= most for number, (least, most) in bounds.items()), found
    assert (tmp_path / f"{name}.png").stat().st_size > 1000
    assert all(f"\n{number}: " in page(name) for number in found)  # as the page shows them


def test_every_example_is_tested_and_has_a_page_in_the_index() -> None:
    names = sorted(path.stem for path in EXAMPLES.glob("*.py"))
    assert sorted(NUMBERS) == names
    assert sorted(path.stem for path in PAGES.glob("*.md")) == sorted(["README", *names])
    assert sorted(path.name for path in (PAGES / "images").iterdir()) == [f"{name}.png" for name in names]
    index = (PAGES / "README.md").read_text(encoding="utf-8")
    assert sorted(re.findall(r"^\| \[\w+\]\((\w+)\.md\) \|", index, re.MULTILINE)) == names


@pytest.mark.parametrize("name", NUMBERS)
def test_a_page_shows_the_code_and_the_picture_of_its_example(name: str) -> None:
    blocks = re.findall(r"```python\n(.*?)```", page(name), re.DOTALL)
    assert blocks
    assert all(f"\n{block}" in source(name) for block in blocks), "the page shows code that the example has not"
    said = ast.get_docstring(ast.parse(source(name)))
    assert said is not None
    assert f"\n\n{said}\n\n" in page(name)
    assert f"(../../examples/{name}.py)" in page(name)
    assert f"](images/{name}.png)" in page(name)
    assert (PAGES / "images" / f"{name}.png").stat().st_size < LARGEST


@pytest.mark.parametrize("name", NUMBERS)
def test_an_example_imports_what_any_user_has(name: str) -> None:
    tree = ast.parse(source(name))
    roots = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            roots |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.module is not None
            roots.add(node.module.split(".")[0])
            assert not node.module.startswith("sphear"), "an example has its names from `import sphear`"
    assert "sphear" in roots
    assert roots <= {"sphear", "numpy", "scipy", "matplotlib", *sys.stdlib_module_names}
    said = ast.get_docstring(tree)
    assert said is not None
    assert 3 <= len(said.splitlines()) <= 8
