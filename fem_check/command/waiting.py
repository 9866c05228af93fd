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
