"""Files of sweeps opened: to be written by one process, or to be read."""

import sqlite3
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path

from fem_check.runs.lock import claimed
from fem_check.sweeps.records.store import DAMAGED, SCHEMA, UNREADABLE, Store

VERSION = 3
"""Of the tables below."""

MARK = 0x53686565
"""By which SQLite files of this kind are known: "Shee"."""

PATIENCE = 30.0
"""Seconds to wait for a process that reads."""


@contextmanager
def writing(path: Path) -> Iterator[Store]:
    """The file, made where it is not there, with no other process that writes it.

    Raises ValueError, before any work, where it cannot be made or written, is at work for another
    sweep, holds something else, or is of another version.
    """
    name = f"file = {str(path)!r}"
    if path.is_dir():
        raise ValueError(f"{name}: is a folder, must be a file")
    if path.parent.exists() and not path.parent.is_dir():
        raise ValueError(f"{name}: cannot be written: its folder is a file")
    with ExitStack() as held:
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            other = held.enter_context(claimed(path.with_name(f".{path.name}.lock")))
        except OSError as error:
            raise ValueError(f"{name}: cannot be written: {error.strerror or error}") from None
        if other:
            raise ValueError(
                f"{name}: another sweep is at work in it ({other}); wait for it, or name another file"
            )
        yield Store(path, held.enter_context(_connected(path, name, new=True)))


@contextmanager
def _connected(path: Path, name: str, new: bool) -> Iterator[sqlite3.Connection]:
    """A checked database, closed at the end. Errors of SQLite become ValueErrors while it is opened."""
    with ExitStack() as held:
        try:
            db = held.enter_context(
                closing(sqlite3.connect(path, timeout=PATIENCE, isolation_level=None))
            )
            _check(db, name, new)
            if new:
                _begin(db)
        except UNREADABLE as problem:
            raise ValueError(f"{name}: {_words(problem)}") from None
        yield db


def _begin(db: sqlite3.Connection) -> None:
    """Make the tables where there are none, and see that the file can be written."""
    # The log keeps what is written through the end of the process; after a power cut the last
    # records may be missing, which are then computed again, and none is damaged.
    db.execute("PRAGMA journal_mode = WAL")
    db.execute("PRAGMA synchronous = NORMAL")
    if not db.execute("SELECT COUNT(*) FROM sqlite_master").fetchone()[0]:
        db.executescript(
            f"BEGIN; PRAGMA application_id = {MARK}; PRAGMA user_version = {VERSION};{SCHEMA} COMMIT;"
        )
    db.execute("BEGIN IMMEDIATE")
    db.execute("ROLLBACK")


@contextmanager
def reading(path: Path) -> Iterator[Store]:
    """The file, to be read, also while a sweep is at work. Raises ValueError where there is none."""
    name = f"file = {str(path)!r}"
    if not path.is_file():
        what = "is a folder, must be the file of a sweep" if path.is_dir() else "there is no such file"
        raise ValueError(f"{name}: {what}")
    with _connected(path, name, new=False) as db:
        yield Store(path, db)


def _check(db: sqlite3.Connection, name: str, new: bool) -> None:
    """Raise ValueError for a database of something else, of another version, or damaged."""
    mark, version, tables = (
        db.execute(statement).fetchone()[0]
        for statement in (
            "PRAGMA application_id",
            "PRAGMA user_version",
            "SELECT COUNT(*) FROM sqlite_master",
        )
    )
    if not tables and not mark and new:
        return
    if mark != MARK:
        raise ValueError(f"{name}: is a database, but not of sweeps; name another file")
    if version != VERSION:
        raise ValueError(
            f"{name}: is of version {version}, this program writes and reads version {VERSION}; name "
            "another file, or use the program that wrote it"
        )
    (found,) = db.execute("PRAGMA quick_check(1)").fetchone()
    if found != "ok":
        raise ValueError(f"{name}: {DAMAGED.format(' '.join(str(found).split()))}")


def _words(problem: Exception) -> str:
    text = str(problem)
    if "not a database" in text:
        return "is not a database of sweeps; name another file"
    if "malformed" in text or isinstance(problem, UnicodeError):
        return DAMAGED.format(text)
    return f"cannot be used: {text}"
