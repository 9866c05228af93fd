"""The answer to a tolerance: the cheapest level whose numerical and model error meet it together."""

import math
import time
import warnings
from dataclasses import dataclass, replace

from fem_check.levels import LEVELS, TARGET_EFFECTS, Question, distance
from fem_check.shell.abilities import left_out
from linear_theory import validation
from linear_theory.errors import BeyondReachWarning, NotConvergedError, ViscousRegimeWarning
from linear_theory.field import Wave
from linear_theory.friction import warn_if_viscous
from linear_theory.reach import warn_if_beyond
from linear_theory.sheet import Sheet
from linear_theory.speed import CrawlSpeed
from linear_theory.threads import one_blas_thread

METHODS = ("auto", *LEVELS)

SHARE = 0.5
"""Of the tolerance, for the error of the model; the rest is for the numbers."""


@dataclass(frozen=True)
class Prediction:
    """A speed with the level that gave it.

    speed: its `error` is that of the numbers and `model_error` the distance to the target, NaN where it
    is unknown (never so for method = "auto"). level: a key of `levels.LEVELS`; reason: why this one and
    none of those before it, in words. converged: whether `error` meets the tolerance that was asked
    for. seconds: of all that was tried. left_out: what the target itself leaves out, in words: a flat
    sheet of no thickness on which friction acts and nothing else.

    >>> from fem_check import predict
    >>> from linear_theory import Sheet, SineWave
    >>> found = predict(Sheet(), SineWave(), alpha=0.25, rtol=0.2)
    >>> print(f"V = {found.mean:.2f} +- {found.error:.2f} L/T: {found.reason}")
    V = 0.10 +- 0.01 L/T: strip is near enough
    """

    speed: CrawlSpeed
    level: str
    reason: str
    converged: bool
    seconds: float
    left_out: tuple[str, ...] = ()

    @property
    def mean(self) -> float:
        """Mean speed, length per time, positive towards +y."""
        return self.speed.mean

    @property
    def error(self) -> float:
        """Of numbers and model together, absolute."""
        return total_error(self.speed)


@dataclass(frozen=True)
class Goal:
    """Tolerances, relative and absolute, for the error of numbers and model together."""

    rtol: float
    atol: float

    def tolerance(self, mean: float) -> float:
        """Allowed error of that speed."""
        return max(self.rtol * abs(mean), self.atol)


def predict(
    sheet: Sheet,
    wave: Wave,
    alpha: float,
    growth_law: str = "exp",
    area: str = "grown",
    load: str = "current",
    friction: str = "coulomb",
    slip_speed: float | None = None,
    rtol: float = 1e-2,
    atol: float | None = None,
    method: str = "auto",
) -> Prediction:
    """How fast the nonlinear sheet crawls, by the cheapest level that is known to be near enough.

    The target is a planar sheet that grows by growth_law, counts its energy per area, carries load and
    is too stiff for friction to change its shape; arguments as in `crawl_speed`. method = "auto" takes
    of "strip", "first order", "second order" and "cycle" the first one whose error and model error
    together are below max(rtol |mean|, atol), atol = 1e-3 rtol alpha^2 L/T unless given; a level whose
    model error is unknown (see `model_error`) is never taken. Any of the names takes that level.
    A tolerance that the last level misses shows in `converged`; what the target leaves out (bending,
    and with it the thickness; the ground; friction that deforms the sheet), in `left_out`: scenes with
    these effects are for `cycle_speed` and `simulate`.

    Raises ValueError for bad input and what the level that is asked for raises. Warns as `crawl_speed`
    does of the level that answers.

    >>> from fem_check import predict
    >>> from linear_theory import Sheet, SineWave
    >>> found = predict(Sheet(), SineWave(), alpha=0.05, rtol=0.1)
    >>> print(f"V = {found.mean:.4f} L/T by {found.level}, converged {found.converged}")
    V = 0.0038 L/T by second order, converged True
    """
    start = time.perf_counter()
    question = Question(sheet, wave, alpha, growth_law, area, load, friction, slip_speed)
    rtol = validation.tolerance(rtol)
    goal = Goal(rtol, validation.absolute_tolerance(atol, rtol, question.alpha, question.unit))
    if validation.choice("method", method, METHODS) == "auto":
        found = _cheapest(question, goal)
    else:
        found = _answer(question, method, goal, "asked for")
        found = replace(found, reason=f"{found.reason}; {found.speed.reach}")
    warn_if_viscous(found.speed, slip_speed)
    warn_if_beyond(question.alpha, found.speed.beyond_reach)
    return replace(found, seconds=time.perf_counter() - start)


def total_error(speed: CrawlSpeed) -> float:
    """Of numbers and model together, absolute; NaN where that of the model is unknown."""
    return speed.error + speed.model_error


def _cheapest(question: Question, goal: Goal) -> Prediction:
    """Try those levels in turn that could do, the target last."""
    passed, largest = "", math.inf
    for level in LEVELS:
        obstacle = _obstacle(question, level, goal.tolerance(largest))
        if not obstacle:
            try:
                found = _answer(question, level, goal, f"{level} is near enough{passed}")
            except NotConvergedError as failure:
                obstacle = str(failure)
            else:
                if found.converged:
                    return found
                largest = abs(found.mean) + found.error
                obstacle = f"error {found.error:.1g} is above {goal.tolerance(found.mean):.1g}"
        passed += f"; not {level}: {obstacle}"
    return replace(found, reason=f"the last level{passed}")


def _obstacle(question: Question, level: str, tolerance: float) -> str:
    """Why a level cannot do, seen without solving it; empty if it may. tolerance: at the most."""
    model = distance(level, question)
    if math.isnan(model):
        return "its model error is unknown here"
    if model > tolerance:
        return f"its model error {model:.1g} is above {tolerance:.1g}"
    return ""


@one_blas_thread
def _answer(question: Question, level: str, goal: Goal, reason: str) -> Prediction:
    with warnings.catch_warnings():
        for kind in (ViscousRegimeWarning, BeyondReachWarning):  # `predict` says it, of the answer
            warnings.simplefilter("ignore", kind)
        rtol = max(SHARE * goal.rtol, validation.SMALLEST_RTOL)
        speed = LEVELS[level](question, rtol, SHARE * goal.atol)
    converged = not speed.beyond_reach and total_error(speed) <= goal.tolerance(speed.mean)
    return Prediction(speed, level, reason, converged, speed.seconds, left_out(TARGET_EFFECTS))
