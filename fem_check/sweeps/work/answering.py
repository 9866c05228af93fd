"""What a worker does: one scene answered within its time, whatever happens, as a record."""

import os
import socket
import time
import warnings
from collections.abc import Callable
from typing import Any, NamedTuple

from fem_check.choice import solving
from fem_check.choice.result import Prediction
from fem_check.sweeps.plan import Question
from fem_check.sweeps.records.record import Record, State, answer_of, circumstances
from fem_check.sweeps.work.bound import OutOfTime, bounded
from linear_theory.common.threads import one_blas_thread


class Task(NamedTuple):
    """What is sent to a worker. key: of the question; seconds: after which it is given up."""

    key: str
    question: Question
    seconds: float


def record_of(task: Task) -> Record:
    """The record of a scene: its answer, or its failure with the reason. Raises nothing but Ctrl-C."""
    clock, processor = time.perf_counter(), time.thread_time()
    with warnings.catch_warnings(record=True, action="always") as seen:
        state, fields = _outcome(task)
    return Record(
        key=task.key,
        state=str(state),
        cpu_seconds=time.thread_time() - processor,
        seconds=time.perf_counter() - clock,
        warnings="\n".join(dict.fromkeys(_line(str(one.message)) for one in seen)),
        **fields,
        **circumstances(task.question, f"{socket.gethostname()}:{os.getpid()}"),
    )


def _outcome(task: Task) -> tuple[State, dict[str, Any]]:
    """How it ended, and what is known."""
    try:
        with bounded(task.seconds):
            return State.ANSWERED, answer_of(solved(task.question))
    except OutOfTime:
        return State.LATE, {"reason": f"no answer within {task.seconds:g} s"}
    except ValueError as refused:
        return State.REFUSED, {"reason": _line(str(refused))}
    except Exception as failure:  # a record for each scene: one that fails must not end the others
        return State.FAILED, {"reason": _line(f"{type(failure).__name__}: {failure}")}


@one_blas_thread
def solved(question: Question) -> Prediction:
    """The answer. Raises what the level that gives it raises."""
    return solving.solved(question.scene, question.settings).answer


def _line(text: str) -> str:
    return " ".join(text.split())


Answering = Callable[[Task], Record]
"""`record_of`, or what a test puts in its place."""
