"""How cost is measured: times of repeated calls, counts of calls, memory, and words for the machine.

Times are processor seconds of this process. With one thread they are those of the clock on a machine
that has nothing else to do, and nearly the same on one that has.
"""

import cProfile
import os
import platform
import subprocess
import sys
import time
import tracemalloc
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np

Result = TypeVar("Result")

LEAST, MOST = 3, 15
"""Repeats of a measurement; more would only widen its range by rare accidents."""

LONG = 6.0
"""Seconds after which two repeats are enough."""

RSS_UNIT = 1 if sys.platform == "darwin" else 1024
"""Bytes in the unit of the largest memory that the system tells."""

PACKAGES = ("numpy", "scipy", "scikit-fem")
"""Whose versions belong to a measured time."""


@dataclass(frozen=True)
class Timing(Generic[Result]):
    """Seconds of a call, median and range over the repeats, and what the call returned."""

    result: Result
    median: float
    fastest: float
    slowest: float
    repeats: int


def timed(
    call: Callable[[], Result],
    patience: float = 0.4,
    clock: Callable[[], float] = time.process_time,
) -> Timing[Result]:
    """Times of at least three calls, of two where they take long, until `patience` seconds are spent.

    The first call, which pays for what is loaded and kept, counts only where it is long.
    """
    found: list[float] = []
    while True:
        start = clock()
        result = call()
        found.append(clock() - start)
        if _enough(found, patience):
            counted = found if sum(found) >= LONG or len(found) < LEAST else found[1:]
            return Timing(result, float(np.median(counted)), min(counted), max(counted), len(counted))


def _enough(found: list[float], patience: float) -> bool:
    if sum(found) >= LONG:
        return len(found) >= 2
    return len(found) > LEAST and (sum(found) >= patience or len(found) > MOST)


def calls(run: Callable[[], object], watched: Mapping[str, Callable[..., Any]]) -> dict[str, int]:
    """How often each of the watched functions is called in a run, by its name in `watched`."""
    profile = cProfile.Profile()
    profile.runcall(run)
    found = {entry.code: entry.callcount for entry in profile.getstats()}
    return {name: found.get(function.__code__, 0) for name, function in watched.items()}


def held_memory(build: Callable[[], Result]) -> tuple[Result, float]:
    """What `build` returns, and the MB of arrays and objects that live as long as it does."""
    tracemalloc.start()
    try:
        result = build()
        held, _ = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    return result, held / 1e6


def import_seconds(module: str) -> float:
    """Processor seconds of an import, the least of three, each in a process of its own."""
    code = f"import time; t = time.process_time(); import {module}; print(time.process_time() - t)"
    return min(float(_printed(code)) for _ in range(3))


def peak_memory(code: str) -> float:
    """MB that a process of its own takes at most to run `code`."""
    read = "import resource; print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"
    return int(_printed(f"{code}\n{read}")) * RSS_UNIT / 1e6


def _printed(code: str) -> str:
    """What a fresh interpreter prints."""
    run = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    return run.stdout


def machine() -> str:
    """What the times belong to: processor, threads, versions."""
    threads = os.environ.get("OMP_NUM_THREADS", "?")
    versions = ", ".join(f"{name} {version(name)}" for name in PACKAGES)
    words = "one thread" if threads == "1" else f"OMP_NUM_THREADS = {threads}"
    return f"{_processor()}, {words}; Python {platform.python_version()}, {versions}"


def _processor() -> str:
    """Its name where the system tells it, else its kind."""
    listing = Path("/proc/cpuinfo")
    for line in listing.read_text().splitlines() if listing.exists() else ():
        if line.startswith("model name"):
            return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()
