"""Ascent from one start by the optimisers of scipy.

Where the objective has kinks (dry friction), it is replaced by a sequence of smooth ones, each closer
to it, and each begun where the last one ended. The ends of all of them are then compared by the
objective itself.
"""

import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.shown import Shown
from linear_theory.optimisation.climbing import MARGIN, Best, climbed
from linear_theory.optimisation.climbing import Ascent as Ascent
from linear_theory.optimisation.limits import Limit
from linear_theory.optimisation.problem import Evaluation, Objective, Region, Unusable

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Climbed(Shown):
    """Where the climb from a start ended.

    start, point (unknowns,); found: there, None if there is no value at any point; stage: number of the
    smooth objective that led there; first: of the objective itself at the start, NaN if it has none;
    evaluations: how many; words: how it ended; seconds. tighter (limits,): by how much the limits were
    tightened there, over their scales, for the true numbers to keep to them.
    """

    start: Array
    point: Array
    found: Evaluation | None
    stage: int
    first: float
    evaluations: int
    words: str
    seconds: float
    tighter: Array = field(default_factory=lambda: np.zeros(0))

    @property
    def value(self) -> float:
        """Of the objective itself, at the end; minus infinity if there is none."""
        return -math.inf if self.found is None else self.found.value


SMOOTHED = 2e-3
"""By how much the true number may be beyond a limit that was met by a smoothed one, where no end keeps
to it; the result is then not called converged."""

TIGHTENED, FARTHEST = 3, 0.1
"""How often the last climb is made again, each time with limits tightened by what the true numbers are
beyond them, and the most that this may be."""


def climb(
    objectives: Sequence[Objective],
    truth: Objective,
    region: Region,
    start: Array,
    how: Ascent,
    tell: Callable[[int], None] = lambda done: None,
    limits: Sequence[Sequence[Limit]] = (),
) -> Climbed:
    """From one start, through smooth objectives in turn, to where `truth` is largest of their ends.

    tell: called with the number of objectives that are done. limits: for each of them, and at last for
    the truth; an end that misses those is none. Where the last end misses them by what smoothing does,
    it is climbed again with tighter ones.
    """
    begin, last = time.perf_counter(), limits[-1] if limits else ()
    ends = list(_ends(objectives, region, start, how, tell, limits))
    first, (end, found) = _usable(truth, start), _highest(truth, ends, last)
    return Climbed(
        start=start,
        point=end.point,
        found=found,
        stage=end.stage,
        first=math.nan if first is None else first.value,
        evaluations=sum(one.evaluations for one in ends) + len(ends) + 1,
        words=ends[-1].words,
        seconds=time.perf_counter() - begin,
        tighter=end.tighter,
    )


class _End(NamedTuple):
    """Where a stage ended, after how many evaluations, and how; tighter (limits,): by how much its
    limits were tightened."""

    point: Array
    stage: int
    tighter: Array
    evaluations: int
    words: str


def _ends(
    objectives: Sequence[Objective],
    region: Region,
    start: Array,
    how: Ascent,
    tell: Callable[[int], None],
    limits: Sequence[Sequence[Limit]],
) -> Iterator[_End]:
    """Of all stages, and of the last one again while the true numbers are beyond their limits."""
    last = limits[-1] if limits else ()
    point, tighter = start, np.zeros(len(last))
    for turn in range(len(objectives) + TIGHTENED):
        stage = min(turn, len(objectives) - 1)
        if turn > stage:
            more = _beyond(last, point)
            if not more.any():
                return
            tighter = tighter + more
        own = limits[stage] if limits else ()
        own = [one.tighter(by) for one, by in zip(own, tighter, strict=True)]
        best = Best(objectives[stage], region, own)
        words = climbed(best, region, point, how)
        point = start if best.point is None else region.towards_centre(best.point)
        yield _End(point, stage, tighter, best.count, words)
        tell(stage + 1)


def _beyond(limits: Sequence[Limit], point: Array) -> Array:
    """By how much to tighten the limits at a point whose true numbers are beyond them (limits,).

    Zeros where they are not, or farther than smoothing accounts for.
    """
    try:
        found = np.array([float(limit.excess(point)[0]) for limit in limits])
    except Unusable:
        return np.zeros(len(limits))
    far = found.max(initial=0.0) > FARTHEST
    return np.where(found > 0, found + MARGIN, 0.0) * (not far)


def _highest(
    truth: Objective, ends: Sequence[_End], limits: Sequence[Limit]
) -> tuple[_End, Evaluation | None]:
    """The end at which the truth is largest, of those that keep to all limits if there are any."""
    for leeway in (0.0, SMOOTHED):
        values = [
            _usable(truth, end.point) if _allowed(limits, end.point, leeway) else None for end in ends
        ]
        found = [(value.value, place) for place, value in enumerate(values) if value is not None]
        if found:
            place = max(found)[1]
            return ends[place], values[place]
    return ends[-1], None


def _usable(objective: Objective, point: Array) -> Evaluation | None:
    try:
        return objective(point)
    except Unusable:
        return None


def _allowed(limits: Sequence[Limit], point: Array, leeway: float) -> bool:
    """Whether the true numbers are within their limits, but for a leeway."""
    try:
        return all(float(limit.excess(point)[0]) <= leeway for limit in limits)
    except Unusable:
        return False
