"""The file of a sweep: an SQLite database of sweeps, their points, and records of scenes by key.

One process writes it. Each record is a transaction of its own: whatever stops the process, every record
is there whole or not at all, and none that was there is lost. Records are kept by the key of the
question alone, so that sweeps in one file share what they have in common. SQLite notices damage to its
own structure, but not to the numbers in it: every row carries a checksum of the others of its columns.
"""

import json
import math
import sqlite3
import zlib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import astuple
from pathlib import Path
from typing import Any

from fem_check.sweeps.records.record import COLUMNS, ENERGY_NUMBERS, FAILURES, Record
from linear_theory.common.errors import SheetcrawlError

TYPES = {"converged": "INTEGER", **dict.fromkeys(("mean", "error", "numerical_error"), "REAL")}
TYPES |= dict.fromkeys(("wave_error", "model_error", "slip_ratio", "cpu_seconds", "seconds"), "REAL")
TYPES |= dict.fromkeys(ENERGY_NUMBERS, "REAL")

SCHEMA = f"""
CREATE TABLE sweeps (
  id INTEGER PRIMARY KEY, key TEXT NOT NULL UNIQUE, size INTEGER NOT NULL, definition TEXT NOT NULL,
  axes TEXT NOT NULL, units TEXT NOT NULL, program TEXT NOT NULL, begun TEXT NOT NULL,
  crc32 INTEGER NOT NULL
);
CREATE TABLE points (
  sweep INTEGER NOT NULL, place INTEGER NOT NULL, record TEXT NOT NULL, given TEXT NOT NULL,
  crc32 INTEGER NOT NULL, PRIMARY KEY (sweep, place)
) WITHOUT ROWID;
CREATE TABLE records (
  {", ".join(f"{name} {TYPES.get(name, 'TEXT')}" for name in COLUMNS)}, crc32 INTEGER NOT NULL,
  PRIMARY KEY (key)
) WITHOUT ROWID;
CREATE INDEX points_by_record ON points (record);
"""

SWEEPS = ("key", "size", "definition", "axes", "units", "program", "begun")
"""Columns of a sweep beside its number."""

POINT = 5
"""Columns of a point."""

DAMAGED = (
    "is damaged ({}); name another file, which computes all anew, or read what is left of it by the "
    "program sqlite3 and its command .recover"
)

UNREADABLE = (sqlite3.Error, UnicodeError)
"""What SQLite raises where a file is damaged; the second where its words quote bytes of the file."""

Row = tuple[Any, ...]


class StoreError(SheetcrawlError):
    """The file could not be written, or read where it is damaged; what it holds is kept."""


class Store:
    """An open file. Raises ValueError where it is none of sweeps, or of another version."""

    def __init__(self, path: Path, connection: sqlite3.Connection) -> None:
        self.path, self._db = path, connection

    @contextmanager
    def transaction(self) -> Iterator[sqlite3.Connection]:
        """All or nothing. Raises StoreError where it cannot be written."""
        try:
            self._db.execute("BEGIN IMMEDIATE")
            yield self._db
            self._db.execute("COMMIT")
        except BaseException as problem:  # Ctrl-C, too, leaves nothing half written
            if self._db.in_transaction:
                self._db.execute("ROLLBACK")
            if isinstance(problem, sqlite3.Error):
                raise StoreError(f"{self.path}: cannot be written: {problem}") from None
            raise

    def keep(self, record: Record) -> None:
        """Write a record, in a transaction of its own; one that is there stays as it is."""
        row = astuple(record)
        marks = ", ".join("?" * (len(row) + 1))
        with self.transaction() as db:
            db.execute(f"INSERT OR IGNORE INTO records VALUES ({marks})", (*row, checksum(row)))

    def forget_failures(self, sweep: int) -> None:
        """Remove the records of a sweep that are failures, so that their scenes are tried again."""
        marks = ", ".join("?" * len(FAILURES))
        with self.transaction() as db:
            db.execute(
                f"DELETE FROM records WHERE state IN ({marks}) AND key IN "
                "(SELECT record FROM points WHERE sweep = ?)",
                (*map(str, FAILURES), sweep),
            )

    def sweep(self, key: str) -> int | None:
        """The number of a sweep in this file; None where it is not there."""
        row = self._one("SELECT id FROM sweeps WHERE key = ?", key)
        return None if row is None else int(row[0])

    def begin(self, about: dict[str, Any], points: Iterable[tuple[int, str, Sequence[Any]]]) -> int:
        """Write a new sweep with all its points (place, key of the record, what is given) at once.

        about: the other columns of its table.
        """
        row = tuple(about[name] for name in SWEEPS)
        with self.transaction() as db:
            db.execute(
                f"INSERT INTO sweeps ({', '.join(SWEEPS)}, crc32) VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
                (*row, checksum(row)),
            )
            number = int(db.execute("SELECT last_insert_rowid()").fetchone()[0])
            rows = ((number, place, key, json.dumps(given)) for place, key, given in points)
            db.executemany(
                "INSERT INTO points VALUES (?, ?, ?, ?, ?)", ((*row, checksum(row)) for row in rows)
            )
        return number

    def open_points(self, sweep: int) -> Iterator[tuple[str, list[Any]]]:
        """Key and point of the scenes without a record, each once, in their order."""
        after = -1
        while True:  # in pieces: no statement stays open while records are written
            rows = self._all(
                "SELECT * FROM points WHERE sweep = ? AND place > ? AND NOT EXISTS "
                "(SELECT 1 FROM records WHERE key = record) ORDER BY place LIMIT 500",
                sweep,
                after,
            )
            if not rows:
                return
            for row in rows:
                _, place, key, given = self._whole("a point", row)
                after = place
                first = self._one(
                    "SELECT MIN(place) FROM points WHERE record = ? AND sweep = ?", key, sweep
                )
                if first is not None and first[0] == place:
                    yield key, json.loads(given)

    def counts(self, sweep: int) -> dict[str, int]:
        """Scenes by state, those without a record as "open"; one that is there twice counts once."""
        rows = self._all(
            "SELECT COALESCE(state, 'open'), COUNT(*) FROM (SELECT DISTINCT record FROM points WHERE "
            "sweep = ?) LEFT JOIN records ON key = record GROUP BY 1",
            sweep,
        )
        return {str(state): int(count) for state, count in rows}

    def sweeps(self) -> list[dict[str, Any]]:
        """All sweeps of the file with their columns."""
        rows = self._all(f"SELECT id, {', '.join(SWEEPS)}, crc32 FROM sweeps ORDER BY id")
        return [
            {"id": number, **dict(zip(SWEEPS, self._whole("a sweep", row), strict=True))}
            for number, *row in rows
        ]

    def rows(self, sweep: int) -> Iterator[tuple[list[Any], Record | None]]:
        """Every point in order with its record, None where there is none yet."""
        found = self._selected(
            "SELECT points.*, records.* FROM points LEFT JOIN records ON records.key = record "
            "WHERE sweep = ? ORDER BY place",
            sweep,
        )
        for row in found:
            *_, given = self._whole("a point", row[:POINT])
            there = row[POINT] is not None
            yield json.loads(given), _record(self._whole("a record", row[POINT:])) if there else None

    def cost(self, sweep: int) -> tuple[int, float]:
        """How many scenes of a sweep have a cost, and their processor seconds."""
        row = self._one(
            "SELECT COUNT(cpu_seconds), COALESCE(SUM(cpu_seconds), 0.0) FROM (SELECT DISTINCT record "
            "FROM points WHERE sweep = ?) JOIN records ON key = record",
            sweep,
        )
        assert row is not None
        return int(row[0]), float(row[1])

    def _one(self, statement: str, *values: Any) -> Row | None:
        return next(iter(self._all(statement, *values)), None)

    def _all(self, statement: str, *values: Any) -> list[Row]:
        return list(self._selected(statement, *values))

    def _selected(self, statement: str, *values: Any) -> Iterator[Row]:
        try:
            for row in self._db.execute(statement, values):  # noqa: UP028 (closes what may be closed)
                yield row
        except UNREADABLE as problem:
            raise StoreError(f"{self.path}: {DAMAGED.format(problem)}") from None

    def _whole(self, what: str, row: Sequence[Any]) -> Row:
        """A row without its checksum, which must be that of the rest."""
        if checksum(row[:-1]) != row[-1]:
            raise StoreError(f"{self.path}: {DAMAGED.format(f'{what} is not what was written')}")
        return tuple(row[:-1])


def checksum(row: Sequence[Any]) -> int:
    """CRC-32 of the values of a row as SQLite gives them back: true is 1, and no number is NULL.

    Of a damaged row, whose values may be bytes, it is that of no other row.
    """
    return zlib.crc32(repr([_given_back(value) for value in row]).encode("utf-8", "backslashreplace"))


def _given_back(value: str | bytes | float | None) -> str | bytes | float | None:
    if value is None or isinstance(value, bytes):
        return value
    if isinstance(value, str):
        return str(value)  # members of an enumeration are texts there
    return None if math.isnan(value) else float(value)


def _record(row: Sequence[Any]) -> Record:
    fields = dict(zip(COLUMNS, row, strict=True))
    if fields["converged"] is not None:
        fields["converged"] = bool(fields["converged"])
    return Record(**fields)
