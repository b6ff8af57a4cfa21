"""Code that other processes compile: it is found in the cache, and nothing depends on them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="processes are forked on Linux only")

# functions of this process and of another, in a process without other threads
SCRIPT = """
import os, sys, threading, time
from pathlib import Path
from sphear.engine.cache import beside, cache_directory, compiled_beside, generated_module

TEXT = "from sphear.engine.cache import njit\\n@njit(nogil=True)\\ndef times{0}(x):\\n    return {0} * x\\n"
beside.processors = lambda: 3
made = Path(sys.argv[1])

def times(factor):
    function = getattr(generated_module(TEXT.format(factor)), f"times{factor}")
    assert function(2) == 2 * factor
    return function

def hits(function):
    return sum(function.stats.cache_hits.values())

def note(name):
    (made / name).touch()

def wait_for(found):
    for _ in range(600):
        if found():
            return
        time.sleep(0.1)
    raise TimeoutError

def kept(name):
    return any(cache_directory().glob(f"*{name}*.code"))
"""


def run(folder: Path, script: str) -> str:
    """What a script prints after SCRIPT, with a new cache in the folder and one for what it makes."""
    (folder / "made").mkdir()
    variables = os.environ | {"SPHEAR_CACHE_DIR": str(folder / "cache")}
    command = [sys.executable, "-W", "error", "-c", SCRIPT + script, str(folder / "made")]
    done = subprocess.run(command, env=variables, capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stderr
    assert not list((folder / "cache").glob("*.tmp"))
    return done.stdout.strip()


def test_code_that_another_process_compiles_is_loaded(tmp_path: Path) -> None:
    script = """
def job():
    print("of another process")
    times(3)

with compiled_beside([job]):
    times(2)
    wait_for(lambda: kept("times3"))
print(hits(times(2)), hits(times(3)))
"""
    assert run(tmp_path, script) == "0 1"


def test_processes_that_fail_or_die_leave_their_work_to_this_one(tmp_path: Path) -> None:
    script = """
def dies():
    note("dies")
    os._exit(7)

def fails():
    note("fails")
    raise ValueError

with compiled_beside([fails, dies]):
    times(2)
    wait_for(lambda: len(list(made.iterdir())) == 2)
    times(3)
print(hits(times(3)))
"""
    assert run(tmp_path, script) == "0"


def test_processes_end_with_the_block_whatever_they_do(tmp_path: Path) -> None:
    script = """
def sleeps():
    note(str(os.getpid()))
    time.sleep(1000)

try:
    with compiled_beside([sleeps]):
        times(2)
        wait_for(lambda: list(made.iterdir()))
        raise KeyboardInterrupt
except KeyboardInterrupt:
    print("interrupted")
try:
    os.kill(int(next(made.iterdir()).name), 0)
except ProcessLookupError:
    print("ended")
"""
    assert run(tmp_path, script).split() == ["interrupted", "ended"]


@pytest.mark.parametrize(
    ("before", "factor"),
    [
        ("times(2)", 2),
        ("beside.processors = lambda: 1", 3),
        ("threading.Thread(target=time.sleep, args=(1000,), daemon=True).start()", 3),
        ("sys.platform = 'darwin'", 3),
    ],
    ids=["nothing is compiled", "one processor", "other threads", "forking is not safe"],
)
def test_no_process_is_made_where_it_is_of_no_use_or_not_safe(tmp_path: Path, before: str, factor: int) -> None:
    script = f"""
{before}
os.fork = lambda: print("forked")
with compiled_beside([lambda: note("job")]):
    times({factor})
print("alone")
"""
    assert run(tmp_path, script) == "alone"


def test_a_process_is_made_where_something_is_compiled(tmp_path: Path) -> None:
    script = """
fork = os.fork
os.fork = lambda: print("forked", flush=True) or fork()
with compiled_beside([lambda: note("job")]):
    times(2)
print("done")
"""
    assert run(tmp_path, script).split() == ["forked", "done"]
