"""`sphear` as a process: exit status, what is imported, Ctrl-C, pipes, letters and terminals."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import sphear

ENVIRONMENT = {**os.environ, "PYTHONPATH": str(Path(sphear.__file__).parents[1])}
ENVIRONMENT.pop("PYTHONUNBUFFERED", None)  # what is held back must come out, or fail, in time
LONG = ("patch-test", "--sizes", "30", "--jitter", "0.3", "--seeds", "1000000")
SENTENCE = "sphear: interrupted; nothing half-written is left"


@pytest.fixture(autouse=True)
def interruptible() -> Iterator[None]:
    """A process whose parent ignores Ctrl-C ignores it too, as do all that a shell has put into the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def started(*arguments: str, module: tuple[str, ...] = ("-m", "sphear"), **options: Any) -> subprocess.Popen[str]:
    pipes: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    process: subprocess.Popen[str] = subprocess.Popen(
        [sys.executable, *module, *arguments], **{**pipes, "env": ENVIRONMENT, "text": True, **options}
    )
    return process


def finished(*arguments: str, **options: Any) -> tuple[int, str, str]:
    process = started(*arguments, **options)
    try:
        out, err = process.communicate(timeout=300)
    finally:
        process.kill()
    # whether a command is the first to need some code, and so the one that compiles it, is not what it is about
    lines = [line for line in (err or "").splitlines(keepends=True) if not line.startswith("sphear: compiling")]
    return process.returncode, out or "", "".join(lines)


def test_python_m_sphear() -> None:
    status, out, err = finished("list", "corrections", "--json")
    assert (status, err) == (0, "")
    assert list(json.loads(out)) == ["corrections"]


def test_a_mistake_is_status_2_and_one_line() -> None:
    status, out, err = finished("show", "viscosity", "moris")
    assert (status, out, err.count("\n")) == (2, "", 1)


def test_a_computation_prints_one_json_document_only(tmp_path: Path) -> None:
    status, out, err = finished("patch-test", "--sizes", "12", "--json", "--out", "results", cwd=tmp_path)
    assert (status, err) == (0, "")
    assert json.loads(out)["case"] == "patch-test"


@pytest.mark.parametrize(
    ("arguments", "also"),
    [
        ("list", "numpy"),
        ("list --json", "numpy rich"),
        ("show case patch-test --help", "numpy rich"),
        ("--version", "numpy rich"),
    ],
)
def test_what_does_not_compute_imports_nothing_heavy(arguments: str, also: str) -> None:
    heavy = {"llvmlite", "matplotlib", "numba", "scipy", "yaml", *also.split()}
    code = (
        "import sys; from sphear.cli import main\n"
        "try: main()\n"
        "except SystemExit: pass\n"
        f"print({{name.partition('.')[0] for name in sys.modules}} & {heavy}, file=sys.stderr)"
    )
    assert finished(*arguments.split(), module=("-c", code))[2] == "set()\n"


def interrupted_at_its_third_set(*arguments: str) -> tuple[int, str, str]:
    """Ctrl-C from within, when two sets of particles are done."""
    code = (
        "import os, signal, sphear.cases.patch_test as case\n"
        "made, calls = case.lattice, []\n"
        "def lattice(*arguments, **options):\n"
        "    calls.append(1)\n"
        "    if len(calls) == 3:\n"
        "        os.kill(os.getpid(), signal.SIGINT)\n"
        "    return made(*arguments, **options)\n"
        "case.lattice = lattice\n"
        "from sphear.cli import main\n"
        "main()"
    )
    return finished(*LONG, *arguments, module=("-c", code))


@pytest.mark.parametrize("arguments", [(), ("--json",), ("--threads", "2")])
def test_ctrl_c_is_status_130_and_one_sentence(arguments: tuple[str, ...]) -> None:
    assert interrupted_at_its_third_set(*arguments) == (130, "", f"{SENTENCE}\n")


def test_ctrl_c_is_status_130_in_the_midst_of_text_that_python_runs() -> None:
    """As dataclasses and compilers let it do: Python would end by the signal instead."""
    code = (
        "import sphear.cases.patch_test as case\n"
        "case.lattice = lambda *arguments, **options: exec('raise KeyboardInterrupt')\n"
        "from sphear.cli import main\n"
        "main()"
    )
    assert finished(*LONG, module=("-c", code)) == (130, "", f"{SENTENCE}\n")


def test_ctrl_c_leaves_no_file(tmp_path: Path) -> None:
    interrupted_at_its_third_set("--out", str(tmp_path / "results"))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("arguments", ["list", "list --json", "show case patch-test", "show case patch-test --json"])
def test_a_reader_that_has_gone_is_no_error(arguments: str) -> None:
    with started(*arguments.split()) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.close()
        assert process.stderr.read() == ""
    assert process.returncode == 1


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no full device")
@pytest.mark.parametrize("arguments", ["list", "list --json", "show case patch-test --json"])
def test_a_disk_that_is_full_is_one_sentence(arguments: str) -> None:
    with Path("/dev/full").open("w") as full:
        status, _, err = finished(*arguments.split(), stdout=full)
    assert (status, err) == (1, "sphear: the output cannot be used: No space left on device\n")


@pytest.mark.parametrize("arguments", ["list", "list --json", "show viscosity espanol", "patch-test --sizes 12,16"])
def test_letters_that_the_output_cannot_have_are_replaced(arguments: str) -> None:
    status, out, err = finished(*arguments.split(), env=ENVIRONMENT | {"PYTHONIOENCODING": "ascii"})
    assert (status, err) == (0, "")
    assert out.isascii()


def test_json_keeps_all_letters_whatever_the_output_can_have() -> None:
    _, out, _ = finished("show", "viscosity", "espanol", "--json", env=ENVIRONMENT | {"PYTHONIOENCODING": "ascii"})
    assert json.loads(out)["source"].startswith("Español")


@pytest.fixture
def terminal() -> Iterator[tuple[int, int]]:
    """Both ends of a terminal: what is read, and what a process takes for its terminal."""
    pty = pytest.importorskip("pty")
    ends = pty.openpty()
    yield ends
    for end in ends:
        os.close(end)


def read_until(word: str, end: int) -> str:
    text = ""
    while word not in text:
        text += os.read(end, 1024).decode()
    return text


def test_a_terminal_sees_the_progress_and_stdout_stays_empty(terminal: tuple[int, int]) -> None:
    screen, keyboard = terminal
    process = started(*LONG, "--json", stderr=keyboard)
    try:
        assert "patch test: 30 particles a side" in read_until("seed", screen)
        process.send_signal(signal.SIGINT)
        read_until(SENTENCE, screen)
        out, _ = process.communicate(timeout=300)
    finally:
        process.kill()
    assert (process.returncode, out) == (130, "")


def test_progress_on_a_terminal_is_not_in_the_json(terminal: tuple[int, int]) -> None:
    status, out, _ = finished("patch-test", "--sizes", "12", "--json", stderr=terminal[1])
    assert status == 0
    assert json.loads(out)["rows"][0]["particles"] == 12
