"""Files of numbers that are the same bytes for the same input, and progress while they are made."""

import csv
import io
import json
import math
import os
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import Self, TextIO

import numpy as np
from numpy.typing import ArrayLike

DIGITS = 9
"""Significant digits written: more than a figure shows, fewer than roundoff can change."""


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield a path to write to; it becomes `path` at the end, and vanishes after an exception.

    A reader, or a run that was interrupted, never sees half a file. Folders are made as needed.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    # In the same folder, since a rename is atomic only within one file system; the process
    # number keeps two runs apart; the suffix stays last, as writers choose a format by it.
    part = path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
    try:
        yield part
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)


def write_bytes(path: Path, content: bytes) -> Path:
    """Write `content` to `path`, all or nothing."""
    with replacing(path) as part:
        part.write_bytes(content)
    return path


def write_csv(path: Path, columns: Mapping[str, ArrayLike], digits: int = DIGITS) -> Path:
    """Write named columns of equal length; floats with `digits` significant digits, NaN as nan.

    Raises ValueError for columns that are not one-dimensional, differ in length, or hold
    anything but real numbers and text.
    """
    arrays = {name: np.asarray(values) for name, values in columns.items()}
    shapes = {name: array.shape for name, array in arrays.items()}
    if len(set(shapes.values())) != 1 or any(len(shape) != 1 for shape in shapes.values()):
        raise ValueError(f"columns of shapes {shapes}: must be one or more, 1D, of one length")
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")  # the default, CRLF, suits no tool used here
    rows.writerow(arrays)
    rows.writerows(zip(*(_cells(name, a, digits) for name, a in arrays.items()), strict=True))
    return write_bytes(path, text.getvalue().encode())


def _cells(name: str, column: np.ndarray, digits: int) -> list[str]:
    if column.dtype.kind == "f":
        return [_rounded(value, digits) for value in column.tolist()]
    if column.dtype.kind in "iuU":
        return [str(value) for value in column.tolist()]
    raise ValueError(f"column {name!r} of dtype {column.dtype}: must be real numbers or text")


def _rounded(value: float, digits: int) -> str:
    # Adding zero turns -0.0 into 0.0: which of the two a sum ends in is an accident of its order.
    return f"{value + 0.0:.{digits}g}"


def write_json(path: Path, numbers: Mapping[str, object], digits: int = DIGITS) -> Path:
    """Write the numbers that a figure shows, keys sorted, floats to `digits` significant digits.

    Values are numbers, text, arrays, or mappings and sequences of these. NaN, the mark of what
    is not known, becomes null, since JSON has no NaN. Raises ValueError for an infinite or
    complex number and for keys that are not text.
    """
    plain = _plain(numbers, digits, "numbers")
    text = json.dumps(plain, indent=2, sort_keys=True, ensure_ascii=False, allow_nan=False)
    return write_bytes(path, f"{text}\n".encode())


def _plain(value: object, digits: int, where: str) -> object:
    """`value` in the types that JSON knows; `where` names the place for messages."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    match value:
        case None | bool() | int() | str():
            return value
        case float():
            if math.isinf(value):
                raise ValueError(f"{where} = {value}: must be finite, or NaN for unknown")
            return None if math.isnan(value) else float(_rounded(value, digits))
        case Mapping():
            if not all(isinstance(key, str) for key in value):
                raise ValueError(f"{where} has keys {list(value)}: must be text")
            return {key: _plain(item, digits, f"{where}.{key}") for key, item in value.items()}
        case Sequence():
            return [_plain(item, digits, f"{where}[{i}]") for i, item in enumerate(value)]
    raise ValueError(f"{where} = {value!r}: must be a number, text, or a collection of these")


class Progress:
    """Say on stderr how far a computation is and how long it will take, once it is slow.

        with Progress("fig3", total=len(alphas)) as progress:
            for alpha in alphas:
                ...
                progress.advance()

    Nothing is printed before `delay` seconds. `total` and the steps may be any unit of work, so
    that steps of unequal cost leave the time left right. A thread prints, because a single step
    may itself be the slow one. On a terminal the line is rewritten, in a log a new one is added
    now and then.
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
        # Work done and when it was done, in one tuple: the thread always reads a pair that fits.
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
        """One more step (or `amount` of the total) is done."""
        self._done = (self._done[0] + amount, self._clock() - self._start)

    def line(self) -> str:
        """The state in words: share done, time spent, time left."""
        elapsed = self._clock() - self._start
        done, when = self._done
        share = f"{self._label}: {min(done / self._total, 1):4.0%}, {_duration(elapsed)}"
        if done <= 0:
            return f"{share}, time left not known yet"
        # From the rate up to the last step; between steps the estimate counts down.
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
