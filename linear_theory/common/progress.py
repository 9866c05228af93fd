"""How far long work has come, for whoever waits: `progress=` of the functions that may take seconds.

Solvers say what they go through by `track`; who listens is kept in a context variable, so that nothing
between the function that the user calls and the loop that takes the time has to pass it on. Without a
listener `track` costs nothing.
"""

import math
import sys
import time
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import NamedTuple, TypeVar

from linear_theory.common import validation
from linear_theory.common.shown import Shown

T = TypeVar("T")


class _Progress(NamedTuple):
    task: str
    share: float
    seconds: float
    left: float


class Progress(Shown, _Progress):
    """task: what is done, in words; share: of this task, from 0 to 1; seconds: since the call.

    left: seconds that the rest of this task will take at the pace so far, NaN until something of it is
    done. Another task may follow: how many finer meshes or times are needed shows only on the way.
    """


Report = Callable[[Progress], None]


class _Watch(NamedTuple):
    """Who listens, since when, and what the present tasks are part of."""

    report: Report
    start: float
    part_of: str = ""

    def note(self, task: str, done: int, count: int, begin: float) -> None:
        """Report that `done` of `count` equal parts of a task are done, the first begun at `begin`."""
        now = time.perf_counter()
        left = (now - begin) * (count - done) / done if done else math.nan
        words = f"{self.part_of}: {task}" if self.part_of else task
        self.report(Progress(words, done / count if count else 1.0, now - self.start, left))


_WATCH: ContextVar[_Watch | None] = ContextVar("watch", default=None)


@contextmanager
def watched(progress: bool | Report | None, call: str) -> Iterator[None]:
    """Tell `progress` of all that is tracked inside; `call` names the function for Ctrl-C.

    progress: None or False leaves a listener that is there already, True prints on stderr, a function
    is called with a `Progress`. Raises ValueError for anything else, and KeyboardInterrupt after
    Ctrl-C, with a line that says what is kept: nothing.

    >>> from linear_theory.common.progress import track, watched
    >>> with watched(lambda p: print(f"{p.task} {p.share:.0%}"), "an example"):
    ...     squares = [n * n for n in track("squares", [2, 3])]
    squares 0%
    squares 50%
    squares 100%
    """
    report = _printed if progress is True else progress
    if report is not None and report is not False and not callable(report):
        raise ValueError(
            f"progress = {validation.shown(progress)}: must be True, which prints, or a function that "
            "is called with a Progress"
        )
    token = _WATCH.set(_Watch(report, time.perf_counter())) if callable(report) else None
    try:
        yield
    except KeyboardInterrupt:
        # As `simulate` does: from None, since where in the work it struck tells the user nothing.
        text = f"{call} was stopped; it keeps nothing to go on from, the same call starts anew"
        raise KeyboardInterrupt(text) from None
    finally:
        if token is not None:
            _WATCH.reset(token)
        if progress is True:
            print(file=sys.stderr)


@contextmanager
def part_of(whole: str) -> Iterator[None]:
    """Tasks inside are named as parts of `whole`."""
    watch = _WATCH.get()
    if watch is None:
        yield
        return
    outer = f"{watch.part_of}, " if watch.part_of else ""
    token = _WATCH.set(watch._replace(part_of=outer + whole))
    try:
        yield
    finally:
        _WATCH.reset(token)


def track(task: str, items: Collection[T]) -> Iterator[T]:
    """The items, one after another, each of which takes about as long; who listens hears of them."""
    watch = _WATCH.get()
    if watch is None:
        yield from items
        return
    begin = time.perf_counter()
    watch.note(task, 0, len(items), begin)
    for done, item in enumerate(items, 1):
        yield item
        watch.note(task, done, len(items), begin)


def _printed(progress: Progress) -> None:
    left = "" if math.isnan(progress.left) else f", {progress.left:.0f} s left"
    text = f"{progress.task} {progress.share:.0%}{left}"
    print(f"\r{text:<70}", end="", file=sys.stderr, flush=True)
