"""A lock that keeps a second process away; the operating system frees it with the first one."""

import contextlib
import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any


@contextmanager
def claimed(path: Path) -> Iterator[str]:
    """Hold the lock, a file that stays; yields who holds it instead, empty where it was free.

    Raises OSError where the file cannot be written.
    """
    with open(path, "a+", encoding="utf-8") as file:
        if _held(file):
            _sign(file)
            yield ""
        else:
            file.seek(0)
            yield file.read().strip() or "an unknown process"


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
