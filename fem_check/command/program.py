"""The program: arguments in, exit status out, and one line on stderr for any failure."""

import contextlib
import os
import shutil
import sys
from collections.abc import Sequence
from typing import NoReturn

from fem_check.command.status import (
    BAD_ARGUMENTS,
    CLOSED_PIPE,
    INTERRUPTED,
    MET,
    MISSED,
    TERMINATED,
)
from fem_check.command.stopping import Stop, terminable

COLUMNS = 20, 500
"""Least and most of a terminal: what lays out the help never ends at 1, and fails at 10^20."""


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Answer and exit."""
    _fit_words()
    with terminable() as stop:
        status = _answered(sys.argv[1:] if arguments is None else arguments, stop)
    sys.exit(status)


def _answered(arguments: Sequence[str], stop: Stop) -> int:
    """The exit status, whatever happens."""
    if sys.stderr is None:  # closed: the next file to be opened would get its number, and its lines
        sys.stderr = open(os.devnull, "w")  # noqa: SIM115, to the end of the program
    if sys.stdout is None:
        _complain("cannot write the answer: the standard output is closed")
        return MISSED
    try:
        status = _run(arguments)
        sys.stdout.flush()
    except KeyboardInterrupt as stopped:
        _complain(str(stopped) or "interrupted; no partial result was kept, run the command again")
        status = TERMINATED if stop.asked else INTERRUPTED
    except BrokenPipeError:  # the reader has closed the pipe
        _forget_output()
        status = CLOSED_PIPE
    except OSError as problem:
        _forget_output()
        _complain(f"cannot write the answer: {problem}")
        status = MISSED
    except Exception as problem:
        if not _is_answer(problem):
            raise
        _complain(str(problem))
        status = MISSED
    return status


def _is_answer(problem: Exception) -> bool:
    """Whether it says why there is no answer. Its class is not imported for that, which takes long."""
    errors = sys.modules.get("linear_theory.common.errors")
    return errors is not None and isinstance(problem, errors.SheetcrawlError)


def _fit_words() -> None:
    """Have a number of columns that words can be laid out in, whatever the environment says."""
    said = os.environ.get("COLUMNS", "")
    columns = int(said) if said.isdecimal() else shutil.get_terminal_size().columns
    within = min(max(columns, COLUMNS[0]), COLUMNS[1])
    if within != columns:
        os.environ["COLUMNS"] = str(within)


def _run(arguments: Sequence[str]) -> int:
    """Run the command given by the arguments and return its exit status."""
    from cyclopts import CycloptsError, UnknownOptionError, UnusedCliTokensError

    from fem_check.command.app import app
    from fem_check.command.typed import elsewhere
    from fem_check.command.words import tidied

    try:
        found = app(tidied(arguments), exit_on_error=False, print_error=False)
    except UnusedCliTokensError as problem:
        command = tidied(arguments)[0]
        word = (problem.unused_tokens or [""])[0]
        _complain(f"{word!r}: must follow an option; see sheetcrawl {command} --help")
        return BAD_ARGUMENTS
    except UnknownOptionError as problem:
        typed = (problem.token.keyword or problem.token.value).split("=")[0]
        _complain(elsewhere(typed) or str(problem))
        return BAD_ARGUMENTS
    except (CycloptsError, ValueError) as problem:
        for line in getattr(problem, "mistakes", (str(problem),)):  # of a scene file, all of them
            _complain(line)
        return BAD_ARGUMENTS
    return found if isinstance(found, int) else MET


def _complain(problem: str) -> None:
    """Print a problem as one line on stderr."""
    print(f"sheetcrawl: {' '.join(problem.split())}", file=sys.stderr)


def _forget_output() -> None:
    """Discard unwritten output, which the interpreter would otherwise try to write at exit."""
    with contextlib.suppress(OSError, ValueError):  # a replacement of stdout has no file number
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
