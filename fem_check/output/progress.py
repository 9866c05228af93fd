"""Progress of long computations, printed on stderr."""

import math
import sys
import threading
import time
from collections.abc import Callable
from types import TracebackType
from typing import Self, TextIO


class Progress:
    """Print the progress and the remaining time of a slow computation on stderr.

        with Progress("fig3", total=len(alphas)) as progress:
            for alpha in alphas:
                ...
                progress.advance()

    Nothing is printed before `delay` seconds. `total` and the steps may be in any unit of work, so
    that the time left is right for steps of unequal cost. A thread prints, because a single step
    may be slow. On a terminal the line is overwritten, in a log new lines are added occasionally.
    """

    def __init__(
        self,
        label: str,
        total: float,
        *,
        stream: TextIO | None = None,
        delay: float = 2.0,
        interval: float | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        if not (math.isfinite(total) and total > 0):
            raise ValueError(f"total = {total}: must be finite and > 0")
        self._label, self._total, self._clock, self._delay = label, total, clock, delay
        self._stream = sys.stderr if stream is None else stream
        self._rewrite = self._stream.isatty()
        self._interval = interval or (0.5 if self._rewrite else 10.0)
        self._start = clock()
        # Work done and its time in one tuple: the thread always reads a consistent pair.
        self._done = (0.0, 0.0)
        self._shown = False
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._print_until_stopped, daemon=True)

    def __enter__(self) -> Self:
        self._start = self._clock()
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stop.set()
        self._thread.join()
        if self._shown:
            word = "done in" if kind is None else "stopped after"
            self._print(f"{self._label}: {word} {_duration(self._clock() - self._start)}")
            if self._rewrite:
                self._stream.write("\n")

    def advance(self, amount: float = 1.0) -> None:
        """Report that one more step (or `amount` of the total) is done."""
        self._done = (self._done[0] + amount, self._clock() - self._start)

    def line(self) -> str:
        """The state in words: fraction done, time spent, time left."""
        elapsed = self._clock() - self._start
        done, when = self._done
        share = f"{self._label}: {min(done / self._total, 1):4.0%}, {_duration(elapsed)}"
        if done <= 0:
            return f"{share}, time left unknown"
        # From the average rate up to the last step; between steps the estimate counts down.
        left = max(when * self._total / done - elapsed, 0.0)
        return f"{share}, about {_duration(left)} left"

    def _print_until_stopped(self) -> None:
        pause = self._delay
        while not self._stop.wait(pause):
            self._print(self.line())
            self._shown = True
            pause = self._interval

    def _print(self, line: str) -> None:
        self._stream.write(f"\r\x1b[K{line}" if self._rewrite else f"{line}\n")
        self._stream.flush()


def _duration(seconds: float) -> str:
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    minutes, rest = divmod(whole, 60)
    if minutes < 60:
        return f"{minutes} min {rest:02d} s"
    return f"{minutes // 60} h {minutes % 60:02d} min"
