"""Sweeps whose scenes cost next to nothing, for tests of what keeps and distributes them."""

import os
import signal
import time
from dataclasses import replace
from pathlib import Path

from fem_check.files import RunSettings
from fem_check.sweeps import Between, Grid, Plan
from fem_check.sweeps.plan import plan_of
from fem_check.sweeps.records.record import Record, State, circumstances
from fem_check.sweeps.work.answering import Task, record_of
from linear_theory import Scene, Sheet, SineWave

LOG = "SHEETCRAWL_TEST_LOG"
"""A file that is told of every scene that is computed, an environment variable."""

FIRST = 0.01
"""Growth of the first scenes."""

PAUSE = 0.01
"""Seconds."""


def plan(count: int = 200) -> Plan:
    """That many scenes, a grid over growth and Poisson ratio, answered in milliseconds."""
    scene = Scene(Sheet(), SineWave(), alpha=0.1)
    over = {
        "growth.alpha": Between(FIRST, 0.2, count=count // 4),
        "sheet.poisson": [0.0, 0.2, 0.3, 0.5],
    }
    return plan_of(scene, over, Grid(), RunSettings(level="strip", rtol=0.1))


def logged(task: Task) -> Record:
    """The answer, after a pause, and a line in the log."""
    time.sleep(PAUSE)
    found = record_of(task)
    file = os.open(os.environ[LOG], os.O_WRONLY | os.O_APPEND | os.O_CREAT)
    os.write(file, f"{task.key}\n".encode())  # one write: whole lines, whoever writes beside
    os.close(file)
    return found


def free(task: Task) -> Record:
    """A record that costs nothing, with a number that depends on the scene alone."""
    scene = task.question.scene
    return Record(
        task.key,
        State.ANSWERED,
        "free",
        mean=scene.alpha**2 * (1 + scene.sheet.poisson) / 3,
        error=0.0,
        level="none",
        converged=True,
        cpu_seconds=0.0,
        seconds=0.0,
        **circumstances(task.question, str(os.getpid())),
    )


def deadly(task: Task) -> Record:
    """The first scene ends its worker each time, as a crash of a library does; others are free."""
    scene = task.question.scene
    if scene.alpha == FIRST and scene.sheet.poisson == 0.0:
        with Path(os.environ[LOG]).open("a") as log:
            log.write(f"{task.key}\n")
        os.kill(os.getpid(), signal.SIGKILL)
    return free(task)


def broken(task: Task) -> Record:
    """What workers raise that lack the program."""
    raise ModuleNotFoundError("No module named 'fem_check'")


def old(task: Task) -> Record:
    """What workers with another version of the program answer."""
    return replace(free(task), program="0.0.1")


def clean(path: Path) -> None:
    """Remove a file of records with what stands beside it."""
    for suffix in ("", "-wal", "-shm"):
        Path(f"{path}{suffix}").unlink(missing_ok=True)
