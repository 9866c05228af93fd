"""A sweep answered by the workers of a Dask cluster, on this computer or elsewhere."""

import logging
import queue
import time
import uuid
from collections.abc import Generator, Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

from fem_check.sweeps.answering import Answering, Task, record_of
from fem_check.sweeps.records import Record, State, circumstances
from linear_theory.common import validation
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.extras import optional

USE = "a sweep with several workers (with workers = 1 it needs nothing more)"

PATIENCE = 10.0
"""Seconds to wait for a scheduler to answer."""

LEAST, EACH = 32, 4
"""Tasks that wait at the workers: in all, and to each thread, so that none is idle."""

LOOK = 5.0
"""Seconds after which it is asked again how many workers there are."""

DEATHS = 5
"""Workers that may die with a scene, before it counts as the scene's fault; of a local cluster."""


class LostScheduler(SheetcrawlError):
    """The scheduler is gone, and with it the answers that were not yet here."""


class WrongWorkers(SheetcrawlError):
    """The workers cannot answer: they lack this program, or have another version of it."""


def require_dask() -> None:
    """Raise ModuleNotFoundError, with what to install, without Dask."""
    optional("distributed", "sweep", USE)


@contextmanager
def connected(workers: int, scheduler: Any = None) -> Iterator[Any]:
    """A client of the scheduler, an address or a cluster; of a new local cluster where it is None.

    Raises ModuleNotFoundError without Dask, and ValueError where no scheduler answers.
    """
    distributed = optional("distributed", "sweep", USE)
    dask = optional("dask", "sweep", USE)
    quiet = logging.getLogger("distributed")
    level = quiet.level
    with ExitStack() as held:
        held.callback(quiet.setLevel, level)
        held.enter_context(dask.config.set({"distributed.scheduler.allowed-failures": DEATHS}))
        if scheduler is None:
            scheduler = held.enter_context(_local(distributed, workers))
        quiet.setLevel(logging.CRITICAL)  # what goes wrong is told below, in a line
        yield held.enter_context(_client(distributed, scheduler))


@contextmanager
def _local(distributed: Any, workers: int) -> Iterator[Any]:
    """One thread to a worker: a scene keeps to one core."""
    cluster = distributed.LocalCluster(
        n_workers=workers,
        threads_per_worker=1,
        dashboard_address=None,
        silence_logs=logging.CRITICAL,
    )
    try:
        yield cluster
    finally:
        cluster.close(timeout=PATIENCE)


@contextmanager
def _client(distributed: Any, scheduler: Any) -> Iterator[Any]:
    try:
        client = distributed.Client(scheduler, timeout=PATIENCE, set_as_default=False)
    except (OSError, TimeoutError, ValueError) as problem:
        shown = validation.shown(scheduler)
        reason = str(problem).splitlines()[0] if isinstance(problem, ValueError) else ""
        raise ValueError(
            f"scheduler = {shown}: no scheduler answers there within {PATIENCE:g} s"
            + (f" ({reason})" if reason else "")
            + "; its address is like tcp://10.0.0.1:8786, as `dask scheduler` prints it"
        ) from None
    try:
        yield client
    finally:
        client.close(timeout=1.0)


def records(
    client: Any, tasks: Iterator[Task], answering: Answering = record_of
) -> Generator[Record | None]:
    """As they arrive, in any order; None where a while has passed without one.

    Raises LostScheduler and WrongWorkers.
    """
    flight = _Flight(client, answering)
    try:
        flight.fill(tasks)
        while flight.tasks:
            yield from flight.landed()
            flight.fill(tasks)
    finally:
        flight.cancel()


class _Flight:
    """The tasks that are at the workers."""

    def __init__(self, client: Any, answering: Answering) -> None:
        self.tasks: dict[str, Task] = {}
        self._client, self._answering = client, answering
        self._futures: dict[str, Any] = {}
        self._done: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self._name = f"sheetcrawl-{uuid.uuid4().hex[:12]}"  # another sweep may ask the same scheduler
        self._looked, self._most = -LOOK, LEAST

    def fill(self, tasks: Iterator[Task]) -> None:
        """Send tasks until the workers have enough."""
        if time.monotonic() - self._looked > LOOK:
            threads = sum(self._client.nthreads().values())
            self._most, self._looked = max(LEAST, EACH * threads), time.monotonic()
        while len(self.tasks) < self._most:
            task = next(tasks, None)
            if task is None:
                return
            name = f"{self._name}-{task.key}"
            future = self._client.submit(self._answering, task, key=name, pure=False)
            self.tasks[name], self._futures[name] = task, future
            future.add_done_callback(self._done.put)

    def landed(self) -> Iterator[Record | None]:
        """Records of those that are done, after at most a second."""
        try:
            done = [self._done.get(timeout=1.0)]
        except queue.Empty:
            if self._client.status != "running":
                raise LostScheduler(self._lost()) from None
            yield None
            return
        while not self._done.empty():
            done.append(self._done.get())
        if any(future.status in ("cancelled", "lost") for future in done):
            raise LostScheduler(self._lost())
        for future, found in zip(done, self._gathered(done), strict=True):
            task = self.tasks.pop(future.key)
            del self._futures[future.key]
            yield found if isinstance(found, Record) else self._failed(task, found)

    def _gathered(self, done: list[Any]) -> list[Any]:
        """Their results, or the exceptions instead of which there is none."""
        if all(future.status == "finished" for future in done):
            try:
                return list(self._client.gather(done))
            except Exception:  # a worker has died with a result: one by one, it is found again
                pass
        return [self._result(future) for future in done]

    def _result(self, future: Any) -> Any:
        try:
            return future.result()
        except Exception as problem:
            return problem

    def _failed(self, task: Task, problem: Any) -> Record:
        """Of a scene with which workers die. Raises what else is wrong with the workers."""
        kind = type(problem).__name__
        if kind in ("CancelledError", "FutureCancelledError", "CommClosedError"):
            raise LostScheduler(self._lost())
        if kind != "KilledWorker":
            words = " ".join(str(problem).split())
            raise WrongWorkers(
                f"the workers cannot answer, {kind}: {words}; they need the same sheetcrawl as this "
                "process"
            )
        deaths = "its worker has died each time it was tried (out of memory, or ended from outside)"
        return Record(task.key, State.FAILED, deaths, **circumstances(task.question, ""))

    def _lost(self) -> str:
        return "the scheduler is lost"

    def cancel(self) -> None:
        """Call off what is not done."""
        if self._futures and self._client.status == "running":
            self._client.cancel(list(self._futures.values()), force=True)
        self._futures.clear()
