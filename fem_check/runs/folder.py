"""The folder of a run: the names of its files, and a lock that keeps a second run out of it."""

import contextlib
import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

SCENE, SCENE_DATA = "scene.toml", "scene.json"
"""The scene as it was resolved; the second where no scene file holds it."""

RESULT, TRAJECTORY, SNAPSHOT, REPORT = "result.json", "trajectory.nc", "snapshot.npz", "report.html"

LOCK = ".sheetcrawl.lock"
"""It stays in the folder, by which a run is known; the operating system frees it with its process."""


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Make the folder and keep other runs out of it.

    Raises ValueError, before any work, where it cannot be made or written to, where it holds files but
    no run, and where another run is at work in it. The lock of a process that has died is free.
    """
    _make(folder)
    try:
        file = open(folder / LOCK, "a+", encoding="utf-8")  # noqa: SIM115, held to the end of the run
    except OSError as error:
        raise ValueError(_unwritable(folder, error)) from None
    with file:
        if not _held(file):
            file.seek(0)
            raise ValueError(
                f"folder = {str(folder)!r}: another run is at work in it ({file.read().strip()}); wait "
                "for it, or name another folder"
            )
        _sign(file, folder)
        yield


def holds_a_run(folder: Path) -> bool:
    """Whether a run was begun in the folder."""
    return (folder / LOCK).exists()


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if not holds_a_run(folder) and any(folder.iterdir()):
            raise ValueError(
                f"folder = {str(folder)!r}: must be new, empty, or that of an earlier run; it holds "
                "other files"
            )
        # Writing is tried, as permissions alone do not tell.
        probe = folder / f".{os.getpid()}.part"
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise ValueError(_unwritable(folder, error)) from None


def _unwritable(folder: Path, error: OSError) -> str:
    return f"folder = {str(folder)!r}: cannot be written: {error.strerror or error}"


def _sign(file: IO[str], folder: Path) -> None:
    """Say who holds the lock."""
    try:
        file.seek(0)
        file.truncate()
        file.write(f"process {os.getpid()} on {socket.gethostname()}\n")
        file.flush()
    except OSError as error:
        raise ValueError(_unwritable(folder, error)) from None


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
