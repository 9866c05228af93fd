"""Files that appear when they are whole, and paths that are found out to be bad before the work."""

import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield a path to write to; it becomes `path` at the end, and vanishes after an exception.

    A reader, or a run that was interrupted, never sees half a file. Folders are made as needed.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    part = _part(path)
    try:
        yield part
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


def writable(path: str | Path, suffixes: Sequence[str]) -> Path:
    """The path, found to be one that `replacing` can write to. Folders are made as needed.

    suffixes: those that the writers know, with their dots, in lower case. Raises ValueError for others
    and OSError, with the reason, where the file cannot be written.
    """
    target = Path(path)
    if target.suffix.lower() not in suffixes:
        raise ValueError(f"path = {str(path)!r}: must end in {' or '.join(suffixes)}")
    if target.is_dir():
        raise IsADirectoryError(f"path = {str(path)!r}: is a folder, must be a file")
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        part = _part(target)
        part.touch()
        part.unlink()
    except OSError as error:
        reason = error.strerror or str(error)
        raise type(error)(f"path = {str(path)!r}: cannot be written: {reason}") from None
    return target


def _part(path: Path) -> Path:
    """Where a file is written until it is whole."""
    # In the same folder, since a rename is atomic only within one file system; the process
    # number keeps two runs apart; the suffix stays last, as writers choose a format by it.
    return path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
