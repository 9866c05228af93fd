"""Atomic writing of files, and checks of paths before the work."""

import contextlib
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from errno import EISDIR, ENOTDIR
from pathlib import Path


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield a path to write to; it is renamed to `path` at the end, and removed after an exception.

    Neither a reader nor an interrupted run leaves or sees an incomplete file. Folders are created as
    needed. Raises OSError, with the path and the reason, where it cannot be written.
    """
    part = _part(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield part
        part.replace(path)
    except OSError as error:
        # A plain OSError: the closed pipe of an encoder is not that of a reader of the answer.
        raise OSError(f"{path}: cannot be written: {error.strerror or error}") from error
    finally:
        with contextlib.suppress(OSError):
            part.unlink()


def writable(path: str | Path, suffixes: Sequence[str]) -> Path:
    """The path, checked to be writable by `replacing`.

    suffixes: supported suffixes, with the dot, in lower case. Raises ValueError for others and for a
    folder that is not there (it may be a mistyped one), and OSError, with the reason, if the file
    cannot be written.
    """
    target = Path(path)
    if target.suffix.lower() not in suffixes:
        raise ValueError(f"path = {str(path)!r}: must end in {' or '.join(suffixes)}")
    try:
        for folder in target.parents:
            if folder.exists() and not folder.is_dir():
                raise NotADirectoryError(ENOTDIR, f"{str(folder)!r} is a file, must be a folder")
        if target.is_dir():
            raise IsADirectoryError(EISDIR, "is a folder, must be a file")
        if not target.parent.exists():
            raise ValueError(
                f"path = {str(path)!r}: must be in a folder that is there; "
                f"{str(target.parent)!r} is not"
            )
        part = _part(target)
        part.touch()
        part.unlink()
    except OSError as error:
        reason = error.strerror or str(error)
        raise type(error)(f"path = {str(path)!r}: cannot be written: {reason}") from None
    return target


def _part(path: Path) -> Path:
    """Temporary path of a file until it is complete."""
    # In the same folder, since a rename is atomic only within one file system; the process
    # number separates two runs; the suffix stays last, as writers choose a format by it.
    return path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
