"""What a sweep will cost, before it is begun or gone on with."""

import math
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from fem_check.choice.expected import expected_seconds
from fem_check.choice.ways import way_of
from fem_check.sweeps.plan import Plan, Question
from fem_check.sweeps.records.opening import reading
from fem_check.sweeps.running import workers_of
from linear_theory.common.shown import Shown

OVERHEAD = 4e-3
"""Processor seconds of this process to a record that a worker finds: checks, messages, the file."""

BYTES = 1200
"""Of a record in the file; of a scene with a mesh or samples as many more as these have in JSON."""

SAMPLE = 12
"""Scenes whose cost is looked at."""


@dataclass(frozen=True)
class Expected(Shown):
    """scenes: of the plan; open: those to be answered. each: processor seconds of one, on an average.

    measured: on how many records of this sweep in its file; 0 where it is what the levels cost, to a
    factor of 5 and at the most. workers: at work; seconds: until the end, by a clock. size: of the file
    in bytes.
    """

    scenes: int
    open: int
    each: float
    measured: int
    workers: int
    seconds: float
    size: float


def expected(plan: Plan, file: str | Path, workers: int | None = None) -> Expected:
    """The cost of a plan, part of which the file may hold. Nothing is written.

    Raises ValueError, as running it does.

    >>> from fem_check.sweeps import Grid, expected
    >>> from fem_check.sweeps.plan import plan_of
    >>> from fem_check.files import RunSettings
    >>> from linear_theory import Scene, Sheet, SineWave
    >>> scene = Scene(Sheet(), SineWave(), alpha=0.1)
    >>> over = {"growth.alpha": [0.1, 0.2], "sheet.width": [0.2, 0.3, 0.4]}
    >>> print(expected(plan_of(scene, over, Grid(), RunSettings()), "none.sqlite").open)
    6
    """
    count = workers_of(workers)
    left, measured, spent = _kept(plan, Path(file))
    sample = _sample(plan)
    each = spent / measured if measured else sum(map(_price, sample)) / len(sample)
    seconds = left * max(each / count, OVERHEAD) if count > 1 else left * each
    size = plan.size * float(BYTES)
    return Expected(plan.size, left, each, measured, count, seconds, size)


def _kept(plan: Plan, path: Path) -> tuple[int, int, float]:
    """Open scenes, and those with a cost and their seconds."""
    if not path.exists():
        return plan.size, 0, 0.0
    with reading(path) as store:
        number = store.sweep(plan.key())
        if number is None:
            return plan.size, 0, 0.0
        return (store.counts(number).get("open", 0), *store.cost(number))


def _sample(plan: Plan) -> list[Question]:
    """A few scenes, evenly over the plan."""
    step = max(1, math.ceil(plan.size / SAMPLE))
    return [plan.question(point) for point in islice(plan.points(), step // 2, None, step)]


def _price(question: Question) -> float:
    scene, settings = question
    return expected_seconds(scene, way_of(scene, settings.level), settings)
