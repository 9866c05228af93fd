"""The folder of a run: the names of its files, and a lock that keeps a second run out of it."""

import contextlib
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from fem_check.runs.lock import claimed

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
    with contextlib.ExitStack() as held:
        try:
            other = held.enter_context(claimed(folder / LOCK))
        except OSError as error:
            raise ValueError(_unwritable(folder, error)) from None
        if other:
            raise ValueError(
                f"folder = {str(folder)!r}: another run is at work in it ({other}); wait for it, or "
                "name another folder"
            )
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
