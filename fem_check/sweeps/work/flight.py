"""The scenes of a sweep on their way to the workers of a cluster and back, as records."""

import itertools
import queue
import time
import uuid
from collections import Counter, deque
from collections.abc import Generator, Iterator
from functools import partial
from typing import Any

from fem_check.sweeps.records.record import Record, State, circumstances
from fem_check.sweeps.work.answering import Answering, Task, record_of
from fem_check.sweeps.work.cluster import LostScheduler, WrongWorkers

TRIES = 3
"""Workers that must die with a scene, the last one with no other scene at work, to be its fault."""

PATIENCE, SOON = 10.0, 0.5
"""Seconds for a result that is said to be there, and when others before it have not come."""

STALLED = 60.0
"""Seconds beyond those of a scene, after which workers that are there must have answered."""

GONE, GONE_HERE = 3600.0, 120.0
"""Seconds after which workers that were there must be replaced, elsewhere and on this computer."""

LEAST, EACH = 32, 4
"""Tasks that wait at the workers: in all, and to each thread, so that none is idle."""

LOOK = 5.0
"""Seconds after which it is asked again how many workers there are."""

LOST = "the scheduler is lost"

LOSSES = ("CancelledError", "FutureCancelledError", "CommClosedError")
"""Exceptions of Dask where the scheduler is gone."""


def records(
    client: Any, tasks: Iterator[Task], answering: Answering = record_of
) -> Generator[Record | None]:
    """As they arrive, in any order; None where a while has passed without one.

    A worker may die with its scene: out of memory, or in a library. The scenes that were with it are
    tried again one by one, with nothing else at work, until it is known which one it was; that one's
    record says so. Raises LostScheduler and WrongWorkers.
    """
    flight = Flight(client, answering)
    flight.fill(tasks)
    while flight.busy:
        yield from flight.landed()
        flight.fill(tasks)


class Flight:
    """The tasks that are at the workers."""

    def __init__(self, client: Any, answering: Answering) -> None:
        self._client, self._answering = client, answering
        self._workers, self._suspects = Workers(client), Suspects()
        self._tasks: dict[str, Task] = {}
        self._futures: dict[str, Any] = {}
        self._done: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self._numbers = itertools.count()
        self._name = f"sheetcrawl-{uuid.uuid4().hex[:12]}"  # another sweep may ask the same scheduler
        self._alone, self._heard = False, time.monotonic()

    @property
    def busy(self) -> bool:
        """Whether there are tasks that have no record yet."""
        return bool(self._tasks or self._suspects.waiting)

    def fill(self, tasks: Iterator[Task]) -> None:
        """Send tasks until the workers have enough; a suspect once nothing else is at work.

        On this computer that is at once; on a large cluster, which would stand idle, after the others.
        """
        self._workers.look()
        if self._alone:
            return
        if not (self._suspects.waiting and self._workers.local):
            while len(self._tasks) < self._workers.most and (task := next(tasks, None)) is not None:
                self._send(task)
        if self._suspects.waiting and not self._tasks:
            self._alone = True
            self._send(self._suspects.waiting.popleft())

    def _send(self, task: Task) -> None:
        """To some worker, under a name that no task had before."""
        name = f"{self._name}-{next(self._numbers)}"
        future = self._client.submit(self._answering, task, key=name, pure=False)
        self._tasks[name], self._futures[name] = task, future
        future.add_done_callback(self._done.put)

    def landed(self) -> Iterator[Record | None]:
        """Records of those that are done, after at most a second."""
        try:
            done = [self._done.get(timeout=1.0)]
        except queue.Empty:
            if self._client.status != "running":
                raise LostScheduler(LOST) from None
            self._check_answers()
            yield None
            return
        self._heard = time.monotonic()
        while not self._done.empty():
            done.append(self._done.get())
        if any(future.status == "cancelled" for future in done):
            raise LostScheduler(LOST)
        found = self._gathered(done)
        for future in done:  # before they are kept: Dask computes again what a worker takes along
            future.release()
        for future, result in zip(done, found, strict=True):
            yield self._judged(future.key, result)

    def _judged(self, name: str, result: Any) -> Record | None:
        """The record of a task that has ended; None where it must be tried again."""
        task, alone = self._tasks.pop(name), self._alone
        del self._futures[name]
        self._alone = False
        if isinstance(result, Record):
            return result
        if isinstance(result, TimeoutError):  # the worker has taken the result along
            self._suspects.waiting.append(task) if alone else self._send(task)
            return None
        _check_death(result)
        return self._suspects.died(task, 1 + result.allowed_failures, alone)

    def _check_answers(self) -> None:
        """Raise WrongWorkers where none has answered for longer than a scene may take."""
        self._workers.check()
        most = max((task.seconds for task in self._tasks.values()), default=0.0) + STALLED
        if not self._workers.threads:
            self._heard = time.monotonic()
        elif time.monotonic() - self._heard > most:
            raise WrongWorkers(f"the workers have answered nothing for {most:.0f} s")

    def _gathered(self, done: list[Any]) -> list[Any]:
        """What they hold, or the exceptions instead.

        A worker that dies with a result takes it along; Dask may then wait for it without end.
        """
        gather = partial(self._client.gather, done, asynchronous=True)
        try:
            return list(self._client.sync(gather, callback_timeout=PATIENCE))
        except Exception:  # whatever one of them has raised on its worker: they are asked one by one
            end = time.monotonic() + PATIENCE
            return [self._result(one, max(end - time.monotonic(), SOON)) for one in done]

    def _result(self, future: Any, patience: float) -> Any:
        try:
            return future.result(timeout=patience)
        except Exception as problem:  # whatever was raised there is the result, and is judged
            return problem


class Workers:
    """Those of a client: how many there are, how many tasks they need, and whether they come back."""

    def __init__(self, client: Any) -> None:
        self._client, self._cluster = client, _cluster_of(client)
        self.local = type(self._cluster).__name__ == "LocalCluster"
        self.threads, self.most = 0, LEAST
        self._looked, self._seen = -LOOK, None if not self.local else time.monotonic()

    def look(self) -> None:
        """Count them, now and then, and replace those of this computer that have not come back.

        Dask starts a worker that died again, but not one that did before its start was complete.
        """
        now = time.monotonic()
        if now - self._looked < LOOK:
            return
        self.threads = sum(self._client.nthreads().values())
        self.most, self._looked = max(LEAST, EACH * self.threads), now
        if self.threads:
            self._seen = now
        if self.local:
            self._cluster.scale(len(self._cluster.worker_spec))

    def check(self) -> None:
        """Raise WrongWorkers where all are gone for long; the first may be in a queue for any time."""
        allowed = GONE_HERE if self.local else GONE
        if not self.threads and self._seen is not None and time.monotonic() - self._seen > allowed:
            raise WrongWorkers(f"all workers have died, and none has come for {allowed:.0f} s")


def _cluster_of(client: Any) -> Any:
    return getattr(client, "cluster", None)  # none for a client of an address


class Suspects:
    """Tasks with which a worker has died, perhaps by the fault of another task that was there."""

    def __init__(self) -> None:
        self.waiting: deque[Task] = deque()
        self._deaths: Counter[str] = Counter()

    def died(self, task: Task, workers: int, alone: bool) -> Record | None:
        """The record where it was this one's fault; None where it is to be tried again, alone."""
        self._deaths[task.key] += workers
        if not alone or self._deaths[task.key] < TRIES:
            self.waiting.append(task)
            return None
        reason = (
            f"its worker died all {self._deaths[task.key]} times that it was tried, at last with no "
            "other scene at work (out of memory, a crash of a library, or ended from outside)"
        )
        return Record(task.key, State.FAILED, reason, **circumstances(task.question, ""))


def _check_death(problem: Any) -> None:
    """Raise what is wrong with the scheduler or the workers, unless it is the death of a worker."""
    kind = type(problem).__name__
    if kind in LOSSES:
        raise LostScheduler(LOST)
    if kind != "KilledWorker":
        words = " ".join(str(problem).split())
        raise WrongWorkers(
            f"the workers cannot answer, {kind}: {words}; they need the same sheetcrawl as this process"
        )
