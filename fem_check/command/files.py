"""Checks, before any work, that pictures and films can be made and written."""

from collections.abc import Iterator
from contextlib import contextmanager

from fem_check.command.options import Options

PICTURES = (".png", ".pdf", ".svg")


def check_files(options: Options) -> None:
    """Raise ValueError for an unknown file type, and OSError for a file that cannot be written."""
    if options.plot is None and options.movie is None:
        return
    from fem_check.output import writers  # here: it loads matplotlib
    from fem_check.output.files import writable

    with _as_option("--plot"):
        if options.plot is not None:
            writable(options.plot, PICTURES)
    with _as_option("--movie"):
        if options.movie is not None:
            writable(options.movie, tuple(writers.WRITERS))
    if options.movie is not None:
        try:
            writers.require(options.movie.suffix.lower())
        except ModuleNotFoundError as missing:
            raise ValueError(str(missing)) from None


@contextmanager
def _as_option(name: str) -> Iterator[None]:
    """Within it an error about a path names the option by which it was given."""
    try:
        yield
    except ValueError as problem:
        raise ValueError(str(problem).replace("path = ", f"{name} ", 1)) from None
