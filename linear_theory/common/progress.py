"""Progress of long computations: the argument `progress=` of functions that may take seconds.

Solvers report their loops by `track`; the listener is kept in a context variable, so that the functions
between the user's call and the loop need not pass it on. Without a listener `track` costs nothing.
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
    """task: what is being done, in words; share: fraction done, 0 to 1; seconds: since the call.

    left: estimated seconds to the end of this task at the present rate, NaN before any of it is done.
    Another task may follow, since the number of refinements is not known in advance.
    """


Report = Callable[[Progress], None]


class _Watch(NamedTuple):
    """The listener, the time of the call, and the task of which the present tasks are part."""

    report: Report
    start: float
    part_of: str = ""

    def note(self, task: str, done: int, count: int, begin: float) -> None:
        """Report that `done` of `count` equal parts of a task begun at time `begin` are done."""
        now = time.perf_counter()
        left = (now - begin) * (count - done) / done if done else math.nan
        words = f"{self.part_of}: {task}" if self.part_of else task
        self.report(Progress(words, done / count if count else 1.0, now - self.start, left))


_WATCH: ContextVar[_Watch | None] = ContextVar("watch", default=None)


def reporting(progress: bool | Report | None) -> Report | None:
    """What is called with a `Progress`: True prints on stderr. Raises ValueError for anything else."""
    if progress is None or progress is False:
        return None
    if progress is True:
        return _printed
    if not callable(progress):
        raise ValueError(
            f"progress = {validation.shown(progress)}: must be True, which prints, or a function that "
            "is called with a Progress"
        )
    return progress


@contextmanager
def watched(progress: bool | Report | None, call: str) -> Iterator[None]:
    """Report everything tracked inside to `progress`; `call` names the function for Ctrl-C.

    progress: None or False keeps an existing listener, True prints on stderr, a function is called with
    a `Progress`. Raises ValueError for anything else, and KeyboardInterrupt after Ctrl-C, with a line
    that says that no partial result was kept.

    >>> from linear_theory.common.progress import track, watched
    >>> with watched(lambda p: print(f"{p.task} {p.share:.0%}"), "an example"):
    ...     squares = [n * n for n in track("squares", [2, 3])]
    squares 0%
    squares 50%
    squares 100%
    """
    report = reporting(progress)
    token = _WATCH.set(_Watch(report, time.perf_counter())) if report else None
    try:
        yield
    except KeyboardInterrupt:
        # As in `simulate`: from None, since the traceback into the solver does not help the user.
        text = f"{call} was interrupted; no partial result was kept, call it again"
        raise KeyboardInterrupt(text) from None
    finally:
        if token is not None:
            _WATCH.reset(token)
        if progress is True:
            print(file=sys.stderr)


@contextmanager
def part_of(whole: str) -> Iterator[None]:
    """Report tasks inside as parts of the task `whole`."""
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
    """Iterate over items that take about equally long, and report progress to the listener."""
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
