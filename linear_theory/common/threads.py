"""Small dense work keeps to one BLAS thread, and the number that was set before is restored after it.

BLAS shares a factorisation of a hundred unknowns out among all cores and waits for the last one; beside
one other busy process that takes up to a thousand times as long as one thread alone. With OpenBLAS on
its own threads, as in the wheels of numpy and scipy, the number is a property of the process and not
of the caller, so that callers are counted: the first one sets it and the last one restores it. With
MKL and on OpenMP each thread has its own number, set when it enters and restored when it leaves.
"""

import functools
import os
import threading
from collections.abc import Callable
from importlib import import_module
from types import TracebackType
from typing import ParamSpec, TypeVar

from threadpoolctl import LibController, ThreadpoolController

P = ParamSpec("P")
R = TypeVar("R")

Numbers = list[tuple[LibController, int]]
"""Libraries and their numbers of threads."""


class OneBlasThread:
    """Context manager that may be entered again, by any thread; the package has one, `one_blas_thread`.

    libraries: whose threads are limited; unless given, every BLAS that is loaded when it is first
    entered, those of numpy and scipy among them. A number of threads that somebody else sets in between
    lasts until the last caller has left.
    """

    def __init__(self, libraries: list[LibController] | None = None) -> None:
        self._lock = threading.Lock()
        self._libraries = libraries
        self._callers: list[int] = []
        self._shared: Numbers = []
        self._own: dict[int, Numbers] = {}

    def __enter__(self) -> None:
        caller = threading.get_ident()
        with self._lock:
            if caller not in self._callers:
                self._limit(caller)
            self._callers.append(caller)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        caller = threading.get_ident()
        with self._lock:
            self._callers.remove(caller)
            if caller not in self._callers:
                _restore(self._own.pop(caller, []))
            if not self._callers:
                _restore(self._shared)

    def __call__(self, function: Callable[P, R]) -> Callable[P, R]:
        """The function, called at one BLAS thread; for functions that return and do not yield."""

        @functools.wraps(function)
        def limited(*args: P.args, **kwargs: P.kwargs) -> R:
            with self:
                return function(*args, **kwargs)

        return limited

    def _limit(self, caller: int) -> None:
        if self._libraries is None:  # a search among all loaded libraries, milliseconds
            # scipy has a BLAS of its own, which can be limited once it is loaded; not before it is
            # needed, since that takes longer than to import the rest of the package
            import_module("scipy.linalg")
            self._libraries = ThreadpoolController().select(user_api="blas").lib_controllers
        for library in self._libraries:
            number = library.num_threads
            if number is not None and number > 1:
                before = self._own.setdefault(caller, []) if _per_thread(library) else self._shared
                before.append((library, number))
                _set(library, 1)

    def forked(self) -> None:
        """In a child process, where of all threads the one that called fork is left."""
        self._lock = threading.Lock()
        caller = threading.get_ident()
        self._callers = [other for other in self._callers if other == caller]
        self._own = {caller: self._own.get(caller, [])}
        if not self._callers:
            _restore(self._shared)


def _per_thread(library: LibController) -> bool:
    """Whether each thread has its own number of threads."""
    return library.internal_api == "mkl" or getattr(library, "threading_layer", None) == "openmp"


def _restore(numbers: Numbers) -> None:
    while numbers:
        _set(*numbers.pop())


def _set(library: LibController, number: int) -> None:
    """Set it from any thread: threadpoolctl 3.8 lets only the first thread that ever did so."""
    release = getattr(library, "clear_controlling_thread", None)
    if release is not None:
        release(force=True)
    library.set_num_threads(number)
    if release is not None:
        release(force=True)


one_blas_thread = OneBlasThread()
"""For `with one_blas_thread:` and as a decorator, `@one_blas_thread`."""

if hasattr(os, "register_at_fork"):  # no fork on Windows
    os.register_at_fork(after_in_child=one_blas_thread.forked)
