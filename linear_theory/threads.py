"""Small dense work keeps to one BLAS thread, and the number that was set before is restored after it.

BLAS shares a factorisation of a hundred unknowns out among all cores and waits for the last one; beside
one other busy process that takes up to a thousand times as long as one thread alone. The number of
threads is a property of the process and not of the caller, so that callers are counted: the first one
sets it, the last one restores it, and those in between, nested or in other threads, cost nothing.
"""

import functools
import os
import threading
from collections.abc import Callable
from types import TracebackType
from typing import ParamSpec, TypeVar

from threadpoolctl import LibController, ThreadpoolController

P = ParamSpec("P")
R = TypeVar("R")


class OneBlasThread:
    """Context manager that may be entered again, by any thread; `one_blas_thread` is the only one made.

    A number of threads that somebody else sets in between lasts until the last caller has left.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._callers: list[int] = []
        self._blas: ThreadpoolController | None = None
        self._before: list[tuple[LibController, int]] = []

    def __enter__(self) -> None:
        with self._lock:
            if not self._callers:
                self._limit()
            self._callers.append(threading.get_ident())

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        with self._lock:
            self._callers.remove(threading.get_ident())
            if not self._callers:
                self._restore()

    def __call__(self, function: Callable[P, R]) -> Callable[P, R]:
        """The function, called at one BLAS thread; for functions that return and do not yield."""

        @functools.wraps(function)
        def limited(*args: P.args, **kwargs: P.kwargs) -> R:
            with self:
                return function(*args, **kwargs)

        return limited

    def _limit(self) -> None:
        if self._blas is None:  # a search among all loaded libraries, milliseconds
            self._blas = ThreadpoolController().select(user_api="blas")
        numbers = [(library, library.num_threads) for library in self._blas.lib_controllers]
        self._before = [(library, n) for library, n in numbers if n is not None and n > 1]
        for library, _ in self._before:
            library.set_num_threads(1)

    def _restore(self) -> None:
        for library, number in self._before:
            library.set_num_threads(number)

    def forked(self) -> None:
        """In a child process, where of all threads the one that called fork is left."""
        self._lock = threading.Lock()
        limited = bool(self._callers)
        self._callers = [caller for caller in self._callers if caller == threading.get_ident()]
        if limited and not self._callers:
            self._restore()


one_blas_thread = OneBlasThread()
"""For `with one_blas_thread:` and as a decorator, `@one_blas_thread`."""

if hasattr(os, "register_at_fork"):  # no fork on Windows
    os.register_at_fork(after_in_child=one_blas_thread.forked)
