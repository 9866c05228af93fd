"""Checks, before any work, that pictures and films can be made and written."""

from fem_check.command.options import Options

PICTURES = (".png", ".pdf", ".svg")


def check_files(options: Options) -> None:
    """Raise ValueError for an unknown file type, and OSError for a file that cannot be written."""
    if options.plot is None and options.movie is None:
        return
    from fem_check.output import writers  # here: it loads matplotlib
    from fem_check.output.files import writable

    if options.plot is not None:
        writable(options.plot, PICTURES)
    if options.movie is not None:
        writable(options.movie, tuple(writers.WRITERS))
        try:
            writers.require(options.movie.suffix.lower())
        except ModuleNotFoundError as missing:
            raise ValueError(str(missing)) from None
