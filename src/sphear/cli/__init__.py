"""The command line, `sphear` or `python -m sphear`."""

from __future__ import annotations

import io
import os
import sys
from contextlib import suppress

from sphear.errors import Interrupted, OutputError, SphearError

INTERRUPTED = 130


def main() -> None:
    """Run the command line: a user's mistake is one sentence on stderr and exit status 2."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")  # a terminal that lacks a letter shows another one
    try:
        from sphear.cli.app import run  # takes a moment, in which Ctrl-C may come too

        status = run()
        if sys.stdout is not None:
            sys.stdout.flush()
    except OutputError as error:
        _fail(str(error), 1)
    except SphearError as error:
        _fail(str(error), 2)
    except KeyboardInterrupt:
        exec("")  # without it Python, where Ctrl-C came while it ran text, would end by the signal, not by the status
        _fail("interrupted; nothing half-written is left", INTERRUPTED)
    except Interrupted as error:
        _fail(str(error), error.status)
    except MemoryError:
        _fail("there is not enough memory for this", 1)
    except BrokenPipeError:  # the reader, such as `head`, has seen enough
        _discard_output()
        sys.exit(1)
    except OSError as error:
        _discard_output()
        _fail(f"{error.filename or 'the output'} cannot be used: {error.strerror or error}", 1)
    else:
        sys.exit(status)


def _discard_output() -> None:
    """Discard what still goes to stdout, what is held back included."""
    if sys.stdout is not None:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _fail(sentence: str, status: int) -> None:
    with suppress(OSError):  # its terminal may be closed
        print(f"sphear: {' '.join(sentence.split())}", file=sys.stderr)
    sys.exit(status)
