"""The answer of `predict`, from a second process: the first stays free to draw.

A newer question ends the work on an older one at the solver's next step.
"""

import math
import multiprocessing
import os
import signal
import threading
import time
import warnings
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import NamedTuple

from fem_check.choice.prediction import predict
from fem_check.explorer.latest import SupersededError
from fem_check.explorer.question import Question
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.progress import Progress

NICE = 10
"""Of the second process: what is drawn at once goes first on a busy machine."""

SETTLED = 0.2
"""Seconds without a newer question before the work begins: until then the picture has the machine."""

PAUSE = 0.3
"""Seconds between two notes on the progress."""


class Predicted(NamedTuple):
    """What `predict` answers: mean, error (numerical) and model_error in length per period, NaN if
    there is no answer; block: the answer in lines; problem: why there is none, or what to mind."""

    mean: float = math.nan
    error: float = math.nan
    model_error: float = math.nan
    level: str = ""
    converged: bool = False
    seconds: float = 0.0
    block: str = ""
    problem: str = ""

    @property
    def total(self) -> float:
        """Numerical plus model error, `error` of the `Prediction`."""
        return self.error + self.model_error


def predicted(question: Question, report: Callable[[Progress], None] | None = None) -> Predicted:
    """Answer a question; errors become words.

    >>> from fem_check.explorer.nonlinear import predicted
    >>> from fem_check.explorer.question import Question
    >>> found = predicted(Question(alpha=0.25, rtol=0.2))
    >>> print(f"V = {found.mean:.2f} +- {found.total:.2f} by {found.level}")
    V = 0.10 +- 0.01 by strip
    """
    start = time.perf_counter()
    try:
        with warnings.catch_warnings(record=True, action="always") as seen:
            found = predict(question.scene, rtol=question.rtol, progress=report)
    except (SheetcrawlError, ValueError) as problem:
        said = " ".join(str(problem).split())
        return Predicted(seconds=time.perf_counter() - start, problem=said)
    said, speed = "; ".join(str(warning.message) for warning in seen), found.speed
    errors = speed.error, speed.model_error
    level, converged, spent = found.level, found.converged, found.seconds
    return Predicted(found.mean, *errors, level, converged, spent, str(found), said)


class Nonlinear:
    """The second process.

    told: called, in a thread of its own, with a question and either the progress or the answer, while
    the question is the newest one.
    """

    def __init__(self, told: Callable[[Question, Progress | Predicted], None]) -> None:
        self._told, self._newest, self._closed = told, Question(), False
        self._start()

    def _start(self) -> None:
        context = multiprocessing.get_context("spawn")
        self._pipe, other = context.Pipe()
        self._process = context.Process(target=work, args=(other,), name="explorer", daemon=True)
        self._process.start()
        other.close()
        threading.Thread(target=self._listen, name="explorer-nonlinear", daemon=True).start()

    def ask(self, question: Question) -> None:
        """Answer this question from now on; a process that has died is started again."""
        self._newest = question
        try:
            self._pipe.send(question)
        except OSError:
            self._start()
            self._pipe.send(question)

    def close(self) -> None:
        """End the process."""
        self._closed = True
        self._process.terminate()
        self._process.join(5)

    def _listen(self) -> None:
        pipe = self._pipe
        while True:
            try:
                question, part = pipe.recv()
            except (EOFError, OSError):
                break
            if question == self._newest:
                self._told(question, part)
        if not self._closed:
            said = "the process that computes has died; move a slider to start it again"
            self._told(self._newest, Predicted(problem=said))


def work(pipe: "Connection[object, Question]") -> None:
    """What the second process does until the pipe is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the first process ends this one
    if hasattr(os, "nice"):
        os.nice(NICE)
    while True:
        try:
            question = pipe.recv()
            while pipe.poll(SETTLED):
                question = pipe.recv()
            pipe.send((question, predicted(question, _Notes(pipe, question))))
        except SupersededError:
            continue
        except (EOFError, OSError):
            return


class _Notes:
    """Sends the progress now and then, and ends the work when there is a newer question."""

    def __init__(self, pipe: "Connection[object, Question]", question: Question) -> None:
        self._pipe, self._question, self._last = pipe, question, time.monotonic()

    def __call__(self, progress: Progress) -> None:
        if self._pipe.poll():
            raise SupersededError
        if time.monotonic() - self._last > PAUSE:
            self._last = time.monotonic()
            self._pipe.send((self._question, progress))
