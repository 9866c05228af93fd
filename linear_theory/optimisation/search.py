"""Ascent from one start by the optimisers of scipy, and the best of several.

Where the objective has kinks (dry friction), it is replaced by a sequence of smooth ones, each closer
to it, and each begun where the last one ended. The ends of all of them are then compared by the
objective itself.
"""

import contextlib
import math
import time
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import Bounds, NonlinearConstraint, minimize

from linear_theory.common import validation
from linear_theory.common.shown import Shown, Value
from linear_theory.optimisation.problem import Evaluation, Objective, Region, Unusable

Array = NDArray[np.float64]

METHODS = ("SLSQP", "trust-constr")

ALLOWED = 1e-9
"""By how much a point may miss a constraint and still be kept; it is then brought inside."""


@dataclass(frozen=True)
class Ascent(Value):
    """How to climb. method: of scipy.optimize.minimize; iterations: at most, for each objective;
    change: of the objective, relative to its size, below which a climb ends. Raises ValueError for
    others."""

    method: str = "SLSQP"
    iterations: int = 200
    change: float = 1e-7

    def __post_init__(self) -> None:
        validation.choice("method", self.method, METHODS)
        validation.integer("iterations", self.iterations, 1)
        validation.positive("change", self.change)


@dataclass(frozen=True)
class Climbed(Shown):
    """Where the climb from a start ended.

    start, point (unknowns,); found: there, None if there is no value at any point; stage: number of the
    smooth objective that led there; first: of the objective itself at the start, NaN if it has none;
    evaluations: how many; words: how it ended; seconds.
    """

    start: Array
    point: Array
    found: Evaluation | None
    stage: int
    first: float
    evaluations: int
    words: str
    seconds: float

    @property
    def value(self) -> float:
        """Of the objective itself, at the end; minus infinity if there is none."""
        return -math.inf if self.found is None else self.found.value


class _Best:
    """Values by point, and the best one that is inside."""

    def __init__(self, objective: Objective, region: Region) -> None:
        self._objective, self._region = objective, region
        self.point: Array | None = None
        self.value, self.count, self.scale = -math.inf, 0, 1.0

    def __call__(self, point: Array) -> tuple[float, Array]:
        found = self._objective(np.array(point))
        self.count += 1
        if self.count == 1:
            self.scale = max(abs(found.value), float(np.linalg.norm(found.gradient)), 1e-300)
        if found.value > self.value and self._region.excess(point) <= ALLOWED:
            self.value, self.point = found.value, np.array(point)
        return -found.value / self.scale, -found.gradient / self.scale

    def offer(self, point: Array) -> None:
        """Take a point into account, if it has a value; the last of a climb, brought inside."""
        with contextlib.suppress(Unusable):
            self(point)


def climb(
    objectives: Sequence[Objective],
    truth: Objective,
    region: Region,
    start: Array,
    how: Ascent,
    tell: Callable[[int], None] = lambda done: None,
) -> Climbed:
    """From one start, through smooth objectives in turn, to where `truth` is largest of their ends.

    tell: called with the number of objectives that are done.
    """
    begin, count, words, point = time.perf_counter(), 0, "", start
    ends: list[Array] = []
    for stage, objective in enumerate(objectives):
        best = _Best(objective, region)
        try:
            last, words = _minimised(best, region, point, how)
            best.offer(region.towards_centre(last))
        except Unusable as outside:
            words = f"left the reach: {outside}"
        count += best.count
        point = start if best.point is None else region.towards_centre(best.point)
        ends.append(point)
        tell(stage + 1)
    first, values = _usable(truth, start), [_usable(truth, end) for end in ends]
    found = [(value.value, place) for place, value in enumerate(values) if value is not None]
    place = max(found)[1] if found else len(ends) - 1
    return Climbed(
        start=start,
        point=ends[place],
        found=values[place],
        stage=place,
        first=math.nan if first is None else first.value,
        evaluations=count + len(ends) + 1,
        words=words,
        seconds=time.perf_counter() - begin,
    )


def _usable(objective: Objective, point: Array) -> Evaluation | None:
    try:
        return objective(point)
    except Unusable:
        return None


def _minimised(best: _Best, region: Region, start: Array, how: Ascent) -> tuple[Array, str]:
    """Run the optimiser, which leaves its points in `best`; the last one, and how it ended, in
    words."""
    bounds = Bounds(region.low, region.high, keep_feasible=True)
    options: dict[str, Any] = {"maxiter": how.iterations}
    if how.method == "SLSQP":
        rules: Any = [
            {
                "type": "ineq",
                "fun": lambda p, one=one: -one.excess(p),
                "jac": lambda p, one=one: -one.slopes(p),
            }
            for one in region.constraints
        ]
        options["ftol"] = how.change
    else:
        rules = [
            NonlinearConstraint(one.excess, -np.inf, 0.0, jac=one.slopes) for one in region.constraints
        ]
        options |= {"gtol": how.change, "xtol": how.change}
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "delta_grad == 0.0", UserWarning)  # at bounds nothing changes
        ended = minimize(
            best, start, method=how.method, jac=True, bounds=bounds, constraints=rules, options=options
        )
    return np.asarray(ended.x), _words(how, ended)


def _words(how: Ascent, ended: Any) -> str:
    if ended.nit >= how.iterations:
        return f"stopped after {how.iterations} iterations"
    if ended.success or ended.status in (1, 2):
        return "converged"
    return f"stopped: {str(ended.message).rstrip('.').lower()}"
