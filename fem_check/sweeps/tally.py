"""How far a sweep is, and how much is left of it."""

import math
import time
from collections.abc import Mapping
from pathlib import Path

from fem_check.sweeps.records.record import Record, State
from linear_theory.common.progress import Progress, Report

TELL = 0.1
"""Seconds between two reports of progress."""


class Telling:
    """Reports progress, not too often."""

    def __init__(self, report: Report | None) -> None:
        self._report, self._start, self._last = report, time.perf_counter(), 0.0
        self._first: tuple[float, int] | None = None

    def __call__(self, task: str, done: int, size: int, before: int = 0) -> None:
        """Scenes done of all, of which some were there before."""
        now = time.perf_counter()
        if self._first is None and done > before:
            self._first = now, done  # what it takes workers to start is no measure of the rest
        if self._report is None or (now - self._last < TELL and done < size):
            return
        self._last, left = now, math.nan
        if self._first is not None and done > self._first[1]:
            left = (now - self._first[0]) * (size - done) / (done - self._first[1])
        self._report(Progress(task, done / size, now - self._start, left))


class Tally:
    """How many scenes have a record, and how many of them are failures."""

    def __init__(self, counts: Mapping[str, int], report: Report | None) -> None:
        self.open = counts.get("open", 0)
        self._size = sum(counts.values())
        self._before = self._done = self._size - self.open
        self._failed = self._done - counts.get(str(State.ANSWERED), 0)
        self._telling = Telling(report)

    def count(self, record: Record) -> None:
        """One more."""
        self._done += 1
        self.open -= 1
        self._failed += record.state != State.ANSWERED

    def tell(self) -> None:
        """Report it."""
        failed = f", {self._failed} failed" if self._failed else ""
        words = f"{self._done} of {self._size} scenes{failed}"
        self._telling(words, self._done, self._size, self._before)

    def words(self, path: Path) -> str:
        """What is kept."""
        return f"{self._done} of {self._size} records are kept in {path}, the rest follows by"
