"""What sweeps cost beside their scenes: processor time of the client to a record, and efficiency."""

import os
import resource
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from fem_check.files import RunSettings
from fem_check.sweeps import Between, Grid, Sweep, run
from fem_check.sweeps.plan import Plan, plan_of
from fem_check.sweeps.work.answering import Answering, record_of
from linear_theory import Scene, Sheet, SineWave
from tests.sweeps import sweep_cases

FREE, WORKING = 1200, 60
"""Scenes that cost nothing, and scenes that do."""


def working(count: int = WORKING) -> Plan:
    """Scenes of about a tenth of a second each, by the second order."""
    scene = Scene(Sheet(), SineWave(), alpha=0.1)
    over = {"growth.alpha": Between(0.01, 0.2, count=count)}
    return plan_of(scene, over, Grid(), RunSettings(level="second order", rtol=0.05))


def measured() -> dict[str, Any]:
    """All numbers, in seconds."""
    with tempfile.TemporaryDirectory() as folder:
        few, many = (
            _spent(sweep_cases.plan(n), Path(folder) / f"{n}.sqlite", 2, sweep_cases.free)
            for n in (FREE // 4, FREE)
        )
        alone = _spent(sweep_cases.plan(FREE), Path(folder) / "alone.sqlite", 1, sweep_cases.free)
        each = (many["client"] - few["client"]) / (FREE - FREE // 4)  # without the start of workers
        one = _spent(working(), Path(folder) / "one.sqlite", 1, record_of)
        two = _spent(working(), Path(folder) / "two.sqlite", 2, record_of)
    return {
        "load": os.getloadavg()[0],
        "overhead": each,
        "overhead_alone": alone["client"] / FREE,
        "start": many["client"] - FREE * each,
        "bytes": many["bytes"] / FREE,
        "one": one,
        "two": two,
        "efficiency_clock": one["between"] / (2 * two["between"]),
        "efficiency_processor": one["scenes"] / (one["scenes"] + WORKING * each),
    }


def _spent(plan: Plan, file: Path, workers: int, answering: Answering) -> dict[str, float]:
    """Processor seconds of this process (not of its workers) and of the scenes, and the clock.

    between: seconds from the first record to the last, without the start of the workers.
    """
    clock, own = time.perf_counter(), time.process_time()
    found = run(plan, file, workers=workers, answering=answering)
    return {
        "client": time.process_time() - own,
        "clock": time.perf_counter() - clock,
        "scenes": sum(record.cpu_seconds or 0.0 for _, record in found.rows() if record is not None),
        "between": _between(found),
        "bytes": float(file.stat().st_size),
    }


def _between(found: Sweep) -> float:
    from datetime import datetime

    ends = sorted(datetime.fromisoformat(r.ended) for _, r in found.rows() if r is not None)
    return (ends[-1] - ends[0]).total_seconds() * len(ends) / (len(ends) - 1)


def table(cost: dict[str, Any]) -> list[str]:
    """For the page."""
    scenes, clock = cost["one"]["scenes"] / WORKING, cost["efficiency_clock"]
    rows = {
        "what": "measured",
        "---": "---",
        "processor time of the client to a record, two workers": f"{1e3 * cost['overhead']:.1f} ms",
        "the same with `--workers 1`, without Dask": f"{1e3 * cost['overhead_alone']:.1f} ms",
        "start of two workers, processor time of the client": f"{cost['start']:.1f} s",
        "the file, to a record": f"{cost['bytes'] / 1e3:.1f} kB",
        f"efficiency on two cores by the clock, scenes of {scenes:.2f} s": f"{clock:.2f}",
        "the same by processor time": f"{cost['efficiency_processor']:.2f}",
    }
    return [f"| {name} | {value} |" for name, value in rows.items()]


def words(cost: dict[str, Any]) -> str:
    """What the table means."""
    return (
        "The client checks each scene, sends it, takes its record and writes it; with a cluster on "
        "this computer the scheduler is part of that process. The first two rows are of scenes that "
        f"cost nothing. Efficiency: {WORKING} scenes, the time from the first record to the last in "
        "one process over twice that with two workers; by processor time, that of the scenes over that "
        f"of scenes and client. Load of the machine, other work included: {cost['load']:.1f}."
    )


if __name__ == "__main__":
    print(measured(), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, file=sys.stderr)
