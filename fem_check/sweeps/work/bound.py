"""A bound on the time of a piece of work, on any thread."""

import ctypes
import threading
from collections.abc import Iterator
from contextlib import contextmanager


class OutOfTime(BaseException):
    """Raised in the work when its time is over; no `except Exception` in it can swallow it."""


@contextmanager
def bounded(seconds: float) -> Iterator[None]:
    """Raise OutOfTime in what is done inside once the seconds are over.

    It is raised between two instructions of Python: one long call into a library ends first.

    >>> from fem_check.sweeps.work.bound import OutOfTime, bounded
    >>> try:
    ...     with bounded(0.05):
    ...         while True:
    ...             pass
    ... except OutOfTime:
    ...     print("over")
    over
    """
    watch = _Watch(threading.get_ident())
    timer = threading.Timer(min(seconds, threading.TIMEOUT_MAX), watch.fire)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        watch.end()


class _Watch:
    """Interrupts a thread once, and never after its work has ended."""

    def __init__(self, thread: int) -> None:
        self._thread, self._lock, self._ended, self._fired = thread, threading.Lock(), False, False

    def fire(self) -> None:
        """Have the exception raised in the thread."""
        with self._lock:
            if not self._ended:
                self._fired = True
                _raise_in(self._thread, OutOfTime)

    def end(self) -> None:
        """The work has ended; an exception that is still to come is called off."""
        while not self._ended:
            try:
                with self._lock:
                    self._ended = True
                    if self._fired:
                        _raise_in(self._thread, None)
            except OutOfTime:  # it came after all, here
                continue


def _raise_in(thread: int, kind: type[BaseException] | None) -> None:
    """None calls off an exception that was not yet raised."""
    what = ctypes.py_object() if kind is None else ctypes.py_object(kind)
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), what)
