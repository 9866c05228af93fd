"""The Dask cluster whose workers answer a sweep, on this computer or elsewhere."""

import asyncio
import logging
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from typing import Any

from linear_theory.common import validation
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.extras import optional

USE = "a sweep with several workers (with workers = 1 it needs nothing more)"

PATIENCE = 10.0
"""Seconds to wait for a scheduler to answer."""

SILENT = 10 * logging.CRITICAL
"""Level of the logs of Dask: what goes wrong is told here, in a line."""

DEATHS = 0
"""Workers that may die before Dask tells of it; of a local cluster. `flight` tries again itself."""


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
        with suppress(TimeoutError):  # one that is being started again would complain on stderr
            if len(cluster.scheduler_info["workers"]) < len(cluster.worker_spec):
                cluster.wait_for_workers(len(cluster.worker_spec), timeout=PATIENCE)
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
