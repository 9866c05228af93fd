"""Times beside a busy core, with the threads that BLAS takes by itself, against one thread; printed.

    python -m figures.measure.bench.threads      (or `make bench-threads`)

Some ten seconds. Each case runs in a process of its own: with one BLAS thread on a quiet machine, with
one thread beside a process that keeps one core busy, and beside that process with no setting at all,
as a user's script runs. `common.threads` is to keep the last one from waiting for the busy core:
the ratio to the first should be at most AIM, of which sharing the machine is a part, the second column.
"""

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext

from fem_check import (
    Bending,
    Friction,
    Gravity,
    Ground,
    Material,
    Membrane,
    Scene,
    cycle_speed,
    simulate,
)
from figures.measure.meters import machine, timed
from linear_theory import Sheet, SineWave, crawl_speed

AIM = 1.5
"""Largest ratio of the time beside a busy core to that of one thread on a quiet machine."""

LONGEST = 120.0
"""Seconds after which a process is given up."""

VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
ONE_THREAD = dict.fromkeys(VARIABLES, "1")

SHEET, WAVE = Sheet(), SineWave()
MATERIAL = Material(SHEET.thickness, SHEET.poisson)


def bending() -> object:
    """A lying sheet that bends, 6 x 12 elements, 16 steps of half a period."""
    effects = (
        Membrane(MATERIAL),
        Bending(MATERIAL),
        Gravity(2.5e-4),
        Ground(0.5),
        Friction(0.7, 3.5e-3),
    )
    scene = Scene(SHEET, WAVE, 0.02, curvature_coupling=2.0, effects=effects, cells=(6, 12))
    return simulate(scene, periods=1, steps=16, ramp=0.0)


def cycle() -> object:
    """The nonlinear sheet in the plane."""
    return cycle_speed(Scene(SHEET, WAVE, 0.25, effects=(Membrane(MATERIAL),), cells=(4, 8)), rtol=1e-3)


def small_strain() -> object:
    """Theory of first order."""
    return crawl_speed(SHEET, WAVE, 0.25, rtol=1e-4)


CASES: Mapping[str, Callable[[], object]] = {
    "bending 6 x 12, 16 steps": bending,
    "cycle_speed": cycle,
    "crawl_speed": small_strain,
}


@contextmanager
def busy_core() -> Iterator[None]:
    """Another process that computes all the time."""
    other = subprocess.Popen([sys.executable, "-c", "while True: pass"])
    try:
        yield
    finally:
        other.kill()
        other.wait()


def seconds(environment: Mapping[str, str], busy: bool) -> dict[str, float]:
    """Least times of the cases in a new process, infinite for those that were not finished."""
    command = [sys.executable, "-m", "figures.measure.bench.threads", "--measure"]
    others = {name: value for name, value in os.environ.items() if name not in VARIABLES}
    with busy_core() if busy else nullcontext():
        child = subprocess.Popen(
            command, env={**others, **environment}, stdout=subprocess.PIPE, text=True
        )
        try:
            printed, _ = child.communicate(timeout=LONGEST)
        except subprocess.TimeoutExpired:
            child.kill()
            printed, _ = child.communicate()
    if child.returncode > 0:
        raise subprocess.CalledProcessError(child.returncode, command)
    found = dict(json.loads(line) for line in printed.splitlines())
    return {name: found.get(name, float("inf")) for name in CASES}


def measure() -> None:
    """Print the least time of each case, a line each."""
    for name, case in CASES.items():
        print(json.dumps((name, timed(case, clock=time.perf_counter).fastest)), flush=True)


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table, or, with --measure, the times of this process."""
    if list(sys.argv[1:] if arguments is None else arguments) == ["--measure"]:
        return measure()
    quiet, shared, default = seconds(ONE_THREAD, False), seconds(ONE_THREAD, True), seconds({}, True)
    print(f"{machine()}, {os.cpu_count()} cores; seconds and ratios to one thread on a quiet machine\n")
    print(f"{'':26}{'one thread':>12}{'beside busy':>14}{'default, beside busy':>24}")
    for name in CASES:
        one, beside, free = quiet[name], shared[name], default[name]
        verdict = "" if free <= AIM * one else f"  above {AIM}"
        ratios = f"{one:12.3f}{beside:9.3f} x{beside / one:.2f}{free:18.3f} x{free / one:.2f}"
        print(f"{name:26}{ratios}{verdict}")


if __name__ == "__main__":
    main()
