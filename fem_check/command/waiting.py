"""A progress line on the terminal: the present task, the fraction done and the time left."""

import math
import sys
import time
from types import TracebackType
from typing import TYPE_CHECKING

from linear_theory.common.progress import Progress

if TYPE_CHECKING:
    from rich.progress import Progress as Bar

PATIENCE = 2.0
"""Delay in seconds before the line appears."""


class Waiting:
    """Shows progress on stderr if that is a terminal, and erases it at the end."""

    def __init__(self) -> None:
        self._start = time.monotonic()
        self._terminal = sys.stderr.isatty()
        self._bar: Bar | None = None

    def __enter__(self) -> "Waiting":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._bar is not None:
            self._bar.stop()

    def report(self, progress: Progress) -> None:
        """Draw the line, after the delay."""
        if not self._terminal or time.monotonic() - self._start < PATIENCE:
            return
        if self._bar is None:
            self._bar = _bar()
            self._bar.add_task("", total=1.0, left="")
        left = "" if math.isnan(progress.left) else f"{progress.left:.0f} s left of this step"
        (task,) = self._bar.task_ids
        self._bar.update(task, description=progress.task, completed=progress.share, left=left)


def _bar() -> "Bar":
    """A started progress bar of rich."""
    from rich.console import Console
    from rich.progress import BarColumn, TextColumn
    from rich.progress import Progress as Bar

    columns = TextColumn("{task.description}"), BarColumn(20), TextColumn("{task.fields[left]}")
    bar = Bar(*columns, console=Console(stderr=True), transient=True)
    bar.start()
    return bar


EVERY = 60.0
"""Seconds between lines where stderr is no terminal."""


class Lines(Waiting):
    """The same, and where stderr is no terminal a line from time to time, for work of hours."""

    def __init__(self) -> None:
        super().__init__()
        self._said = self._start

    def report(self, progress: Progress) -> None:
        """Draw the line, or write one."""
        left = "" if math.isnan(progress.left) else f", {in_words(progress.left)} left"
        super().report(progress._replace(task=f"{progress.task}{left}", left=math.nan))
        now = time.monotonic()
        if not self._terminal and now - self._said >= EVERY:
            self._said = now
            print(f"sheetcrawl: {progress.task}{left}", file=sys.stderr, flush=True)


def in_words(seconds: float) -> str:
    """Two digits in the unit that fits.

    >>> from fem_check.command.waiting import in_words
    >>> print(in_words(0.0123), in_words(75), in_words(2e4), in_words(4e5), sep=", ")
    0.012 s, 75 s, 5.6 h, 4.6 days
    """
    for unit, length in (("days", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= 2 * length:
            return f"{float(f'{seconds / length:.2g}'):g} {unit}"
    return f"{float(f'{seconds:.2g}'):g} s"
