"""Tables that take hours: rows are kept as they come, by one or more processes, and a run goes on.

    filling = Filling(TABLE, out, key=lambda row: (row.alpha, row.kappa), done=lambda row: True)
    filling.fill(wanted, compute, workers=2)

One process writes a table at a time; a second one that wants to is refused.
"""

import os
import signal
from collections.abc import Callable, Hashable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from dataclasses import dataclass
from multiprocessing import get_context, parent_process
from multiprocessing.process import BaseProcess
from pathlib import Path
from threading import Thread
from typing import Any, Generic, TypeVar

from fem_check.runs.lock import claimed
from figures.common.output import Progress
from figures.common.records import Table

Key = TypeVar("Key", bound=Hashable)
Row = TypeVar("Row")


@dataclass(frozen=True)
class Filling(Generic[Key, Row]):
    """A table, the file that is filled, the key by which a row is found, and whether it counts.

    A row that does not count, for want of something that an older run did not compute, is computed
    again and stays until then.
    """

    table: Table[Row]
    path: Path
    key: Callable[[Row], Key]
    counts: Callable[[Row], bool] = lambda row: True

    def fill(self, wanted: Sequence[Key], compute: Callable[[Key], Row], workers: int = 1) -> list[Row]:
        """Compute the rows of the wanted keys that are missing; all rows, in the order of `wanted`.

        compute: a function of a module, since processes of their own look it up by its name. Rows that
        are not wanted stay, behind the others. Raises SystemExit where another process fills the file,
        ValueError for fewer than one worker.
        """
        if workers < 1:
            raise ValueError(f"workers = {workers}: must be >= 1")
        self.path.parent.mkdir(parents=True, exist_ok=True)
        with claimed(self.path.with_suffix(".lock")) as other:
            if other:
                raise SystemExit(f"{self.path}: is being filled by {other}; wait for it, or stop it")
            return self._fill(wanted, compute, workers)

    def _fill(self, wanted: Sequence[Key], compute: Callable[[Key], Row], workers: int) -> list[Row]:
        rows = {self.key(r): r for r in self._kept()}
        order = {key: k for k, key in enumerate([*wanted, *(key for key in rows if key not in wanted)])}
        left = [key for key in order if key in wanted and not (key in rows and self.counts(rows[key]))]
        with Progress(f"rows of {self.path.name}", max(len(left), 1)) as progress:
            for row in _computed(left, compute, workers):
                rows[self.key(row)] = row
                self.table.write([rows[key] for key in order if key in rows], self.path)
                progress.advance()
        return [rows[key] for key in order if key in rows]

    def _kept(self) -> list[Row]:
        return self.table.read(self.path) if self.path.exists() else []


def _computed(keys: Sequence[Any], compute: Callable[[Any], Row], workers: int) -> Iterator[Row]:
    """Rows as they are ready; in this process for one worker."""
    if workers == 1:
        yield from map(compute, keys)
        return
    pool = ProcessPoolExecutor(workers, get_context("spawn"), _begin_worker)
    try:
        pending = {pool.submit(compute, key) for key in keys}
        while pending:
            done, pending = wait(pending, return_when=FIRST_COMPLETED)
            yield from (future.result() for future in done)
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def _begin_worker() -> None:
    """Ctrl-C reaches all processes of a terminal: only the one that writes acts on it.

    One that is killed takes its workers along: their rows would be written by nobody.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_end_with, args=(parent_process(),), daemon=True).start()


def _end_with(first: BaseProcess | None) -> None:
    """Wait until the first process has ended, then end this one, in the midst of a row."""
    if first is not None:
        first.join()
        os._exit(1)
