"""Workers of a long table end with the process that writes it, even if that is killed."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import psutil
import pytest

WAIT = 40.0
"""Seconds, of a busy machine, in which workers begin and end; a row takes much longer."""

FILL = """
import sys
from figures.common.filling import _computed
from tests.stepping.test_filling_workers import slow
if __name__ == "__main__":
    list(_computed(sys.argv[1:], slow, 2))
"""


def slow(path: str) -> None:
    """A row that is never ready in time; leaves the number of its process in a file."""
    Path(f"{path}.part").write_text(str(os.getpid()))
    Path(f"{path}.part").rename(path)
    time.sleep(10 * WAIT)


def _runs(process: psutil.Process) -> bool:
    """Whether it does; one that has ended and that nobody has asked how, does not."""
    try:
        return process.is_running() and process.status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False


def _until(condition: Callable[[], bool], what: str) -> None:
    end = time.monotonic() + WAIT
    while not condition():
        assert time.monotonic() < end, what
        time.sleep(0.05)


@pytest.mark.parametrize("way", [signal.SIGTERM, signal.SIGKILL])
def test_workers_end_with_the_process_that_writes(tmp_path: Path, way: signal.Signals) -> None:
    program = tmp_path / "fill.py"
    program.write_text(FILL)
    keys = [tmp_path / "first", tmp_path / "second"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    with subprocess.Popen([sys.executable, program, *keys], env=environment) as writer:
        try:
            _until(lambda: all(key.exists() for key in keys), "the workers do not begin")
            workers = [psutil.Process(int(key.read_text())) for key in keys]
        finally:
            writer.send_signal(way)
    try:
        _until(lambda: not any(map(_runs, workers)), "workers outlive the process that writes")
    finally:
        for worker in filter(_runs, workers):
            worker.kill()
