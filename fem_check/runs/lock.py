"""A lock that keeps a second process away; the operating system frees it with the first one."""

import contextlib
import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any


@contextmanager
def claimed(path: Path, stays: bool = True) -> Iterator[str]:
    """Hold the lock, a file; yields who holds it instead, empty where it was free.

    stays: whether the file is left behind. Raises OSError where it cannot be written.
    """
    while True:
        with open(path, "a+", encoding="utf-8") as file:
            if not _held(file):
                file.seek(0)
                yield file.read().strip() or "an unknown process"
                return
            if not stays and not _is_at(file, path):
                continue  # the one that held it has just removed it
            _sign(file)
            try:
                yield ""
            finally:
                if not stays:
                    with contextlib.suppress(OSError):  # as on Windows, while it is open
                        path.unlink()
            return


def _is_at(file: IO[Any], path: Path) -> bool:
    """Whether a file is still the one of that path."""
    try:
        return os.path.samestat(os.fstat(file.fileno()), path.stat())
    except OSError:
        return False


def _sign(file: IO[str]) -> None:
    """Say who holds the lock."""
    file.seek(0)
    file.truncate()
    file.write(f"process {os.getpid()} on {socket.gethostname()}\n")
    file.flush()


def _held(file: IO[Any]) -> bool:
    """Whether the lock is now that of this process."""
    try:
        import fcntl
    except ModuleNotFoundError:
        return _held_on_windows(file)
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def _held_on_windows(file: IO[Any]) -> bool:
    import msvcrt

    lock: Any = msvcrt
    with contextlib.suppress(OSError):
        file.seek(1_000_000)  # beyond the words, which others may read
        lock.locking(file.fileno(), lock.LK_NBLCK, 1)
        return True
    return False
