"""Sweeps that are killed at a random instant and gone on with: what is lost, and what comes twice."""

import contextlib
import os
import random
import signal
import socket
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import psutil

from fem_check.sweeps.work.answering import Task, record_of
from tests.sweeps import sweep_cases

CLIENT, ALONE, WORKER, SCHEDULER = "client", "client, one process", "worker", "scheduler"

KINDS = (CLIENT, ALONE, WORKER, SCHEDULER)

EARLY, START = 0.25, 4.0
"""Share of the kills of a client at any instant of its first seconds, before it has records."""

PATIENCE = 300.0
"""Seconds that anything may take on a busy machine."""


@dataclass(frozen=True)
class Trial:
    """A sweep with one kill.

    kept: records in the file right after it; lost: of these, how many were missing or different in the
    end; twice: of these, how many were computed again. again: scenes computed more than once in all.
    missing, wrong: records of the whole sweep that were not there in the end, or had other numbers than
    without a kill. status: exit status of the killed sweep. damage: what SQLite says of the file.
    """

    kind: str
    seed: int
    kept: int
    lost: int
    twice: int
    again: int
    missing: int
    wrong: int
    status: int
    damage: str
    left: int
    """Processes of the killed sweep that were there ten seconds later."""

    @property
    def fine(self) -> bool:
        """Nothing lost, no record twice, the same numbers, and nothing computed again that was kept.

        The last not after the death of a worker: Dask may compute again what that one had answered just
        before, for which the record stays as it was.
        """
        twice = 0 if self.kind == WORKER else self.twice
        bad = (self.lost, twice, self.missing, self.wrong, self.left)
        return not any(bad) and self.damage == "ok"


@cache
def truth(scenes: int) -> dict[str, tuple[float, float]]:
    """Speeds and errors by key, without any sweep."""
    plan = sweep_cases.plan(scenes)
    found = {}
    for point in plan.points():
        question = plan.question(point)
        record = record_of(Task(question.key(), question, 60.0))
        assert record.mean is not None
        assert record.error is not None
        found[record.key] = record.mean, record.error
    return found


def trial(kind: str, seed: int, folder: Path, scenes: int = 200) -> Trial:
    """One sweep of so many scenes, killed at a random instant while it works."""
    chance = random.Random(seed)
    file, log = folder / f"kill{seed}.sqlite", folder / f"kill{seed}.log"
    right = truth(scenes)
    target = chance.randrange(1, len(right))  # so many records are there when it happens
    delay = chance.random() * 0.02
    around = {**environment(), sweep_cases.LOG: str(log)}
    with _cluster(around) if kind == SCHEDULER else contextlib.nullcontext("") as address:
        means = {CLIENT: "2", ALONE: "1", WORKER: "2"}.get(kind, address)
        child = _start(file, means, scenes, around)
        if kind in (CLIENT, ALONE) and chance.random() < EARLY:
            time.sleep(chance.random() * START)
        else:
            wait_until(lambda: count(file) >= target or child.poll() is not None)
            time.sleep(delay)
        family = [p for p in psutil.Process(child.pid).children(recursive=True) if _is_worker(p)]
        _kill(kind, child, family, chance, address)
        if kind == WORKER:  # the sweep must go on by itself
            kept, computed = _records(file), _lines(log)
            status = child.wait(PATIENCE)
        else:
            status = child.wait(PATIENCE)
            kept, computed = _records(file), _lines(log)
    wait_until(lambda: not any(p.is_running() for p in family), 10.0)
    left = sum(p.is_running() for p in family)
    if kind != WORKER:
        assert _start(file, "1", scenes, around).wait(PATIENCE) == 0
    return _judged(kind, seed, right, kept, computed, file, log, status, left)


def _judged(
    kind: str,
    seed: int,
    right: dict[str, tuple[float, float]],
    kept: dict[str, tuple[object, ...]],
    computed: list[str],
    file: Path,
    log: Path,
    status: int,
    left: int,
) -> Trial:
    final, lines = _records(file), _lines(log)
    later = set(lines[len(computed) :])
    with contextlib.closing(sqlite3.connect(file)) as db:
        damage = db.execute("PRAGMA integrity_check").fetchone()[0]
    return Trial(
        kind=kind,
        seed=seed,
        kept=len(kept),
        lost=sum(final.get(key) != row for key, row in kept.items()),
        twice=len(later & kept.keys()),
        again=len(lines) - len(set(lines)),
        missing=len(right.keys() - final.keys()) + len(final.keys() - right.keys()),
        wrong=sum(key in final and final[key][:2] != pair for key, pair in right.items()),
        status=status,
        damage=str(damage),
        left=left,
    )


def _kill(
    kind: str,
    child: "subprocess.Popen[bytes]",
    family: list[psutil.Process],
    chance: random.Random,
    address: str,
) -> None:
    if kind == WORKER:
        chance.choice(family).kill()
    elif kind == SCHEDULER:
        port = int(address.rpartition(":")[2])
        _scheduler_at(port).kill()
    else:
        child.send_signal(signal.SIGKILL)


def _start(
    file: Path, means: str, scenes: int, environment: dict[str, str]
) -> "subprocess.Popen[bytes]":
    words = [sys.executable, "-m", "tests.sweeps.sweep_child", str(file), means, str(scenes)]
    return subprocess.Popen(words, env=environment, stderr=subprocess.DEVNULL)


SCHEDULERS: dict[int, psutil.Process] = {}


def _scheduler_at(port: int) -> psutil.Process:
    return SCHEDULERS[port]


@contextlib.contextmanager
def _cluster(environment: dict[str, str]) -> Iterator[str]:
    """A scheduler with a worker, in processes of their own; its address."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    address = f"tcp://127.0.0.1:{port}"
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "env": environment}
    here = ["--host", "127.0.0.1", "--port", str(port), "--no-dashboard", "--no-show"]
    dask = [sys.executable, "-m", "distributed.cli"]
    scheduler = subprocess.Popen([*dask[:2], "distributed.cli.dask_scheduler", *here], **quiet)  # type: ignore[call-overload]
    worker = [
        *dask[:2],
        "distributed.cli.dask_worker",
        address,
        "--nthreads",
        "1",
        "--no-dashboard",
        "--no-nanny",
    ]
    started = [scheduler, subprocess.Popen(worker, **quiet)]  # type: ignore[call-overload]
    SCHEDULERS[port] = psutil.Process(scheduler.pid)
    try:
        yield address
    finally:
        for process in started:
            process.kill()
            process.wait(PATIENCE)


def _is_worker(process: psutil.Process) -> bool:
    with contextlib.suppress(psutil.NoSuchProcess):
        return any("spawn_main" in word for word in process.cmdline())
    return False


def wait_until(done: Callable[[], bool], seconds: float = PATIENCE) -> None:
    """Until it is done, or so long."""
    end = time.monotonic() + seconds
    while not done() and time.monotonic() < end:
        time.sleep(0.005)


def environment() -> dict[str, str]:
    """In which child processes find this project, wherever they run."""
    root = str(Path(__file__).parents[2])
    return {**os.environ, "PYTHONPATH": os.pathsep.join([root, os.environ.get("PYTHONPATH", "")])}


def count(file: Path) -> int:
    """Records in a file."""
    return sum(row[0] for row in _asked(file, "SELECT COUNT(*) FROM records"))


def _records(file: Path) -> dict[str, tuple[object, ...]]:
    """Speed, error, process and time of each record by its key."""
    rows = _asked(file, "SELECT key, mean, error, worker, ended FROM records")
    return {row[0]: tuple(row[1:]) for row in rows}


def _asked(file: Path, question: str) -> list[tuple[Any, ...]]:
    """What a file answers; nothing while it is not yet a file of records."""
    if not file.exists():
        return []
    with contextlib.closing(sqlite3.connect(file, timeout=30.0)) as db:
        try:
            return db.execute(question).fetchall()
        except sqlite3.OperationalError:
            return []


def _lines(log: Path) -> list[str]:
    return log.read_text().split() if log.exists() else []
