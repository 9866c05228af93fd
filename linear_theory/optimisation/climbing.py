"""One climb by an optimiser of scipy, within bounds, constraints and limits on computed numbers.

Limits are met with a MARGIN, so that no end is beyond them. SLSQP is the default:
for three searches with limits (the power of a strip; power and stretch; the worst of two laws of
friction) it took 32, 133 and 52 answers, trust-constr 836 and 68 for the last two, and ended the first
one in a corner that is no maximum.
"""

import contextlib
import math
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import Bounds, NonlinearConstraint, minimize

from linear_theory.common import validation
from linear_theory.common.shown import Value
from linear_theory.optimisation.limits import Beside, Limit, Worst
from linear_theory.optimisation.problem import Objective, Region, Unusable

Array = NDArray[np.float64]

METHODS = ("SLSQP", "trust-constr")

ALLOWED = 1e-9
"""By how much a point may miss a constraint and still be kept; it is then brought inside."""

MARGIN = 1e-6
"""Of limits, whose numbers are scaled by their bounds."""

STEEPEST = 1e3
"""Gradient at which the way back to the limits begins at most: SLSQP gives up at 10^7, as the square of
what is beyond them has over itself where that is 10^-6."""


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


class Best:
    """Values by point, and the best one that is inside and meets the limits."""

    def __init__(self, objective: Objective, region: Region, limits: Sequence[Limit] = ()) -> None:
        self.objective, self._region, self.limits = objective, region, limits
        self.point: Array | None = None
        self.value, self.count, self.scale = -math.inf, 0, 1.0

    def __call__(self, point: Array) -> tuple[float, Array]:
        """Minus the objective and its gradient, over the scale of the first point."""
        found = self.objective(np.array(point))
        self.count += 1
        if self.count == 1:
            self.scale = max(abs(found.value), float(np.linalg.norm(found.gradient)), 1e-300)
        if found.value > self.value and self._region.excess(point) <= ALLOWED and self.meets(point):
            self.value, self.point = found.value, np.array(point)
        return -found.value / self.scale, -found.gradient / self.scale

    def meets(self, point: Array) -> bool:
        """Whether all limits are kept to."""
        return all(float(limit.excess(point)[0]) <= 0 for limit in self.limits)

    def offer(self, point: Array) -> None:
        """Take a point into account, if it has a value; the last of a climb, brought inside."""
        with contextlib.suppress(Unusable):
            self(point)


def climbed(best: Best, region: Region, start: Array, how: Ascent) -> str:
    """Climb, leaving all points in `best`; how it ended, in words."""
    try:
        if best.limits and not best.meets(start):
            start = restored(best, region, start, how)
            if not best.meets(start):
                return "no scene near it keeps to the constraints"
        last, words = _minimised(best, region, start, how)
        best.offer(region.towards_centre(last))
    except Unusable as outside:
        return f"left the reach: {outside}"
    return words


def restored(best: Best, region: Region, start: Array, how: Ascent) -> Array:
    """A point at which the squares of what is beyond the limits are least, from a start."""

    def missed(point: Array) -> tuple[float, Array]:
        found = [
            (float(one.excess(point)[0]) + 2 * MARGIN, one.slopes(point)[0]) for one in best.limits
        ]
        return (
            sum(max(over, 0.0) ** 2 for over, _ in found) / size,
            sum((2 * max(over, 0.0) * slopes for over, slopes in found), np.zeros(point.size)) / size,
        )

    bounds = Bounds(region.low, region.high, keep_feasible=True)
    rules = [rule for one in region.constraints for rule in _rules(one, "SLSQP", 0.0)]
    size = 1.0
    try:
        value, slopes = missed(start)
        size = max(value, float(np.linalg.norm(slopes)) / STEEPEST) or 1.0
        options = {"maxiter": how.iterations, "ftol": min(MARGIN**2 / size, MARGIN)}
        ended = minimize(
            *(missed, start),
            method="SLSQP",
            jac=True,
            bounds=bounds,
            constraints=rules,
            options=options,
        )
    except Unusable:
        return start
    best.count += ended.nfev
    return region.towards_centre(np.asarray(ended.x))


def _minimised(best: Best, region: Region, start: Array, how: Ascent) -> tuple[Array, str]:
    """Run the optimiser, which leaves its points in `best`; the last one, and how it ended, in
    words."""
    low, high, more = region.low, region.high, 0
    function: Callable[[Array], tuple[float, Array]] = best
    parts: list[tuple[Any, float]] = [(one, 0.0) for one in region.constraints]
    parts += [(limit, MARGIN) for limit in best.limits]
    if isinstance(best.objective, Worst):
        first, more = best(start)[0], 1
        start = np.append(start, -first)
        low, high = np.append(low, -np.inf), np.append(high, np.inf)
        parts = [(Beside(one), margin) for one, margin in parts]
        parts += [(one, 0.0) for one in best.objective.lifted(best.scale)]
        function = _Raised(best)
    options: dict[str, Any] = {"maxiter": how.iterations}
    if how.method == "SLSQP":
        options["ftol"] = how.change
    else:
        options |= {"gtol": how.change, "xtol": how.change}
    rules = [rule for one, margin in parts for rule in _rules(one, how.method, margin)]
    bounds = Bounds(low, high, keep_feasible=True)
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "delta_grad == 0.0", UserWarning)  # at bounds nothing changes
        ended = minimize(
            *(function, start),
            method=how.method,
            jac=True,
            bounds=bounds,
            constraints=rules,
            options=options,
        )
    return np.asarray(ended.x)[: start.size - more], _words(how, ended)


class _Raised:
    """Minus the last unknown, after `best` has seen the others."""

    def __init__(self, best: Best) -> None:
        self._best = best

    def __call__(self, point: Array) -> tuple[float, Array]:
        self._best(point[:-1])
        return -float(point[-1]), -np.eye(point.size)[-1]


def _rules(one: Any, method: str, margin: float) -> list[Any]:
    """A constraint as the optimisers of scipy take it, met with a margin."""
    equal = getattr(one, "equal", False)
    if method != "SLSQP":
        return [NonlinearConstraint(one.excess, -np.inf, -margin, jac=one.slopes)]
    if not equal:
        return [
            {
                "type": "ineq",
                "fun": lambda p: -one.excess(p) - margin,
                "jac": lambda p: -one.slopes(p),
            }
        ]
    return [  # rows twice, with both signs
        {
            "type": "eq",
            "fun": lambda p: np.array_split(one.excess(p), 2)[0],
            "jac": lambda p: np.array_split(one.slopes(p), 2)[0],
        }
    ]


def _words(how: Ascent, ended: Any) -> str:
    if ended.nit >= how.iterations:
        return f"stopped after {how.iterations} iterations"
    if ended.success or ended.status in (1, 2):
        return "converged"
    return f"stopped: {str(ended.message).rstrip('.').lower()}"
