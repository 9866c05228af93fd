"""A sweep answered by the workers of a Dask cluster, on this computer or elsewhere."""

import asyncio
import itertools
import logging
import queue
import time
import uuid
from collections.abc import Generator, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from typing import Any

from fem_check.sweeps.records.record import Record, State, circumstances
from fem_check.sweeps.work.answering import Answering, Task, record_of
from linear_theory.common import validation
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.extras import optional

USE = "a sweep with several workers (with workers = 1 it needs nothing more)"

PATIENCE = 10.0
"""Seconds to wait for a scheduler to answer, and for a result that is said to be there."""

SOON = 0.5
"""Seconds for a result when others before it have not come."""

STALLED = 60.0
"""Seconds beyond those of a scene, after which workers that are there must have answered."""

LEAST, EACH = 32, 4
"""Tasks that wait at the workers: in all, and to each thread, so that none is idle."""

LOOK = 5.0
"""Seconds after which it is asked again how many workers there are."""

SILENT = 10 * logging.CRITICAL
"""Level of the logs of Dask: what goes wrong is told here, in a line."""

DEATHS = 3
"""Workers that may die with a scene, before it counts as the scene's fault; of a local cluster."""


class LostScheduler(SheetcrawlError):
    """The scheduler is gone, and with it the answers that were not yet here."""


LOST = "the scheduler is lost"


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
        quiet.setLevel(SILENT)
        yield held.enter_context(_client(distributed, scheduler))


@contextmanager
def _local(distributed: Any, workers: int) -> Iterator[Any]:
    """One thread to a worker: a scene keeps to one core."""
    try:
        cluster = distributed.LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            dashboard_address=":0",
            silence_logs=SILENT,
            preload="fem_check.sweeps.work.worker",
        )
    except (RuntimeError, OSError) as problem:
        raise WrongWorkers(
            f"the workers cannot start ({problem}); a script must begin its sweep under "
            "`if __name__ == '__main__':`, since each worker imports the script"
        ) from None
    try:
        yield cluster
    finally:
        with suppress(TimeoutError):  # its processes end with this one at the latest
            cluster.close(timeout=PATIENCE)


@contextmanager
def _client(distributed: Any, scheduler: Any) -> Iterator[Any]:
    try:
        if isinstance(scheduler, str):
            asyncio.run(_tried(distributed, scheduler))
        client = distributed.Client(scheduler, timeout=PATIENCE, set_as_default=False)
    except Exception as problem:  # whatever answers at an address may be no scheduler at all
        shown, reason = validation.shown(scheduler), " ".join(str(problem).split())
        said = f" ({reason})" if isinstance(problem, ValueError) else ""
        raise ValueError(
            f"scheduler = {shown}: no scheduler answers there within {PATIENCE:g} s{said}; its address "
            "is like tcp://10.0.0.1:8786, as `dask scheduler` prints it"
        ) from None
    try:
        yield client
    finally:
        with suppress(TimeoutError):
            client.close(timeout=PATIENCE)


async def _tried(distributed: Any, address: str) -> None:
    """Raise what is wrong with an address; a client that fails there would not end for a while."""
    comm = await distributed.comm.connect(address, timeout=PATIENCE)
    await comm.close()


def records(
    client: Any, tasks: Iterator[Task], answering: Answering = record_of
) -> Generator[Record | None]:
    """As they arrive, in any order; None where a while has passed without one.

    Raises LostScheduler and WrongWorkers.
    """
    flight = _Flight(client, answering)
    flight.fill(tasks)
    while flight.tasks:
        yield from flight.landed()
        flight.fill(tasks)


class _Flight:
    """The tasks that are at the workers."""

    def __init__(self, client: Any, answering: Answering) -> None:
        self.tasks: dict[str, Task] = {}
        self._client, self._answering = client, answering
        self._local = type(getattr(client, "cluster", None)).__name__ == "LocalCluster"
        self._futures: dict[str, Any] = {}
        self._done: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self._numbers = itertools.count()
        self._name = f"sheetcrawl-{uuid.uuid4().hex[:12]}"  # another sweep may ask the same scheduler
        self._looked, self._most, self._heard = -LOOK, LEAST, time.monotonic()

    def fill(self, tasks: Iterator[Task]) -> None:
        """Send tasks until the workers have enough."""
        if time.monotonic() - self._looked > LOOK:
            threads = sum(self._client.nthreads().values())
            self._most, self._looked = max(LEAST, EACH * threads), time.monotonic()
        while len(self.tasks) < self._most:
            task = next(tasks, None)
            if task is None:
                return
            self._send(task)

    def _send(self, task: Task) -> None:
        """To some worker, under a name that no task had before."""
        name = f"{self._name}-{next(self._numbers)}"
        future = self._client.submit(self._answering, task, key=name, pure=False)
        self.tasks[name], self._futures[name] = task, future
        future.add_done_callback(self._done.put)

    def landed(self) -> Iterator[Record | None]:
        """Records of those that are done, after at most a second."""
        try:
            done = [self._done.get(timeout=1.0)]
        except queue.Empty:
            if self._client.status != "running":
                raise LostScheduler(LOST) from None
            self._check_alive()
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
            task = self.tasks.pop(future.key)
            del self._futures[future.key]
            if isinstance(result, TimeoutError):
                self._send(task)
            else:
                yield result if isinstance(result, Record) else self._failed(task, result)

    def _check_alive(self) -> None:
        """Raise WrongWorkers where none has answered for longer than a scene may take."""
        quiet = time.monotonic() - self._heard
        if quiet > STALLED and self._local and not self._client.nthreads():
            raise WrongWorkers("the workers have died, and do not start again")
        most = max(task.seconds for task in self.tasks.values()) + STALLED
        if quiet < most:
            return
        if not self._client.nthreads():  # they may be waiting in the queue of a cluster
            self._heard = time.monotonic()
            return
        raise WrongWorkers(f"the workers have answered nothing for {most:.0f} s")

    def _gathered(self, done: list[Any]) -> list[Any]:
        """What they hold, or the exceptions instead.

        A worker that dies with a result takes it along; Dask may then wait for it without end.
        """
        gather = partial(self._client.gather, done, asynchronous=True)
        try:
            return list(self._client.sync(gather, callback_timeout=PATIENCE))
        except Exception:  # one by one
            end = time.monotonic() + PATIENCE
            return [self._result(one, max(end - time.monotonic(), SOON)) for one in done]

    def _result(self, future: Any, patience: float) -> Any:
        try:
            return future.result(timeout=patience)
        except Exception as problem:
            return problem

    def _failed(self, task: Task, problem: Any) -> Record:
        """Of a scene with which workers die. Raises what else is wrong with the workers."""
        kind = type(problem).__name__
        if kind in ("CancelledError", "FutureCancelledError", "CommClosedError"):
            raise LostScheduler(LOST)
        if kind != "KilledWorker":
            words = " ".join(str(problem).split())
            raise WrongWorkers(
                f"the workers cannot answer, {kind}: {words}; they need the same sheetcrawl as this "
                "process"
            )
        deaths = "its worker has died each time it was tried (out of memory, or ended from outside)"
        return Record(task.key, State.FAILED, deaths, **circumstances(task.question, ""))
