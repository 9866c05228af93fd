"""One thread that works on the newest question and drops older ones."""

import threading
from collections.abc import Callable, Iterable, Iterator
from typing import Generic, TypeVar

from linear_theory.common.progress import Progress, watched

Q = TypeVar("Q")
A = TypeVar("A")


class SupersededError(BaseException):
    """Raised inside a computation whose question is no longer the newest; no solver catches it."""


class Latest(Generic[Q, A]):
    """Answers the newest question in a thread of its own, part by part.

    solve: returns or yields the parts of an answer, none of them None; called in the thread. Of all
    instances one computes at a time: warnings are caught per process. told: called in the thread with
    the question and each part, unless a newer question has come. An exception of `solve` is passed to
    `told` as a part.

    >>> import queue
    >>> from fem_check.explorer.latest import Latest
    >>> seen = queue.Queue()
    >>> latest = Latest(lambda n: [n, n * n], lambda n, part: seen.put(part))
    >>> latest.ask(3)
    >>> seen.get(timeout=10), seen.get(timeout=10)
    (3, 9)
    >>> latest.close()
    """

    _computing = threading.Lock()

    def __init__(
        self, solve: Callable[[Q], Iterable[A]], told: Callable[[Q, A | Exception], None]
    ) -> None:
        self._solve, self._told = solve, told
        self._changed = threading.Condition()
        self._question: list[Q] = []
        self._closed = False
        threading.Thread(target=self._run, name="explorer", daemon=True).start()

    def ask(self, question: Q) -> None:
        """Answer this question from now on."""
        with self._changed:
            self._question = [question]
            self._changed.notify()

    def close(self) -> None:
        """End the thread, soon."""
        with self._changed:
            self._closed = True
            self._changed.notify()

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._question or self._closed)
                if self._closed:
                    return
                question = self._question.pop()
            try:
                with watched(self._check, "explore"):
                    self._answer(question)
            except SupersededError:
                continue

    def _answer(self, question: Q) -> None:
        try:
            parts = iter(self._solve(question))
            while (part := self._next(parts)) is not None:
                self._check()
                self._told(question, part)
        except Exception as problem:  # told to the page: its thread must live on for the next
            self._check()
            self._told(question, problem)

    def _next(self, parts: Iterator[A]) -> A | None:
        """The next part, None after the last; the windows of one server take turns."""
        with self._computing:
            self._check()
            return next(parts, None)

    def _check(self, _: Progress | None = None) -> None:
        """Raise SupersededError if there is a newer question; called from inside the solvers."""
        if self._question or self._closed:
            raise SupersededError
