"""The file of a sweep: an SQLite database of sweeps, their points, and records of scenes by key.

One process writes it. Each record is a transaction of its own: whatever stops the process, every record
is there whole or not at all, and none that was there is lost. Records are kept by the key of the
question alone, so that sweeps in one file share what they have in common.
"""

import json
import sqlite3
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
  axes TEXT NOT NULL, units TEXT NOT NULL, program TEXT NOT NULL, begun TEXT NOT NULL
);
CREATE TABLE points (
  sweep INTEGER NOT NULL, place INTEGER NOT NULL, record TEXT NOT NULL, given TEXT NOT NULL,
  PRIMARY KEY (sweep, place)
) WITHOUT ROWID;
CREATE TABLE records (
  {", ".join(f"{name} {TYPES.get(name, 'TEXT')}" for name in COLUMNS)}, PRIMARY KEY (key)
) WITHOUT ROWID;
CREATE INDEX points_by_record ON points (record);
"""


class StoreError(SheetcrawlError):
    """The file could not be written; what it holds is kept."""


class Store:
    """An open file. Raises ValueError where it is none of sweeps, or of another version."""

    def __init__(self, path: Path, connection: sqlite3.Connection) -> None:
        self.path, self._db = path, connection

    def __enter__(self) -> "Store":
        return self

    def __exit__(self, *_: object) -> None:
        self._db.close()

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
        marks = ", ".join("?" * len(COLUMNS))
        with self.transaction() as db:
            db.execute(f"INSERT OR IGNORE INTO records VALUES ({marks})", astuple(record))

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
        names, marks = ", ".join(about), ", ".join("?" * len(about))
        with self.transaction() as db:
            db.execute(f"INSERT INTO sweeps ({names}) VALUES ({marks})", tuple(about.values()))
            number = int(db.execute("SELECT last_insert_rowid()").fetchone()[0])
            db.executemany(
                "INSERT INTO points VALUES (?, ?, ?, ?)",
                ((number, place, key, json.dumps(given)) for place, key, given in points),
            )
        return number

    def open_points(self, sweep: int) -> Iterator[tuple[str, list[Any]]]:
        """Key and point of the scenes without a record, each once, in their order."""
        after = -1
        while True:  # in pieces: no statement stays open while records are written
            rows = self._db.execute(
                "SELECT place, record, given FROM points WHERE sweep = ? AND place > ? AND NOT EXISTS "
                "(SELECT 1 FROM records WHERE key = record) ORDER BY place LIMIT 500",
                (sweep, after),
            ).fetchall()
            if not rows:
                return
            for place, key, given in rows:
                after = place
                first = self._one(
                    "SELECT MIN(place) FROM points WHERE record = ? AND sweep = ?", key, sweep
                )
                if first is not None and first[0] == place:
                    yield key, json.loads(given)

    def counts(self, sweep: int) -> dict[str, int]:
        """Scenes by state, those without a record as "open"; one that is there twice counts once."""
        rows = self._db.execute(
            "SELECT COALESCE(state, 'open'), COUNT(*) FROM (SELECT DISTINCT record FROM points WHERE "
            "sweep = ?) LEFT JOIN records ON key = record GROUP BY 1",
            (sweep,),
        )
        return {str(state): int(count) for state, count in rows}

    def sweeps(self) -> list[dict[str, Any]]:
        """All sweeps of the file with their columns."""
        found = self._db.execute("SELECT * FROM sweeps ORDER BY id")
        names = [column[0] for column in found.description]
        return [dict(zip(names, row, strict=True)) for row in found]

    def rows(self, sweep: int) -> Iterator[tuple[list[Any], Record | None]]:
        """Every point in order with its record, None where there is none yet."""
        names = ", ".join(f"records.{name}" for name in COLUMNS)
        found = self._db.execute(
            f"SELECT given, {names} FROM points LEFT JOIN records ON records.key = record "
            "WHERE sweep = ? ORDER BY place",
            (sweep,),
        )
        for given, *row in found:
            yield json.loads(given), None if row[0] is None else _record(row)

    def cost(self, sweep: int) -> tuple[int, float]:
        """How many scenes of a sweep have a cost, and their processor seconds."""
        row = self._one(
            "SELECT COUNT(cpu_seconds), COALESCE(SUM(cpu_seconds), 0.0) FROM (SELECT DISTINCT record "
            "FROM points WHERE sweep = ?) JOIN records ON key = record",
            sweep,
        )
        assert row is not None
        return int(row[0]), float(row[1])

    def _one(self, statement: str, *values: Any) -> tuple[Any, ...] | None:
        row: tuple[Any, ...] | None = self._db.execute(statement, values).fetchone()
        return row


def _record(row: Sequence[Any]) -> Record:
    fields = dict(zip(COLUMNS, row, strict=True))
    if fields["converged"] is not None:
        fields["converged"] = bool(fields["converged"])
    return Record(**fields)
