"""The speed to a given tolerance, by the cheapest level whose numerical plus model error meets it."""

import math
import time
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from fem_check.answer.block import block
from fem_check.answer.record import row
from fem_check.choice.levels import LEVELS, TARGET, TARGET_EFFECTS, distance
from fem_check.shell.abilities import left_out
from linear_theory.common import validation
from linear_theory.common.drawable import Drawable
from linear_theory.common.errors import (
    BeyondReachWarning,
    NotConvergedError,
    ViscousRegimeWarning,
)
from linear_theory.common.progress import Report, part_of, watched
from linear_theory.common.shown import Shown, number
from linear_theory.common.threads import one_blas_thread
from linear_theory.common.tolerance import Tolerance
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.load import Load
from linear_theory.friction.regime import Regime, warn_if_viscous
from linear_theory.growth.growth import Reference
from linear_theory.growth.laws import GrowthLaw
from linear_theory.scene.level import THEORY
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.reach import warn_if_beyond
from linear_theory.speed.result import CrawlSpeed, speed_in_words
from linear_theory.wave.protocol import Wave

METHODS = ("auto", *LEVELS)

BY_FRICTION = "deformation by friction, taken as too weak"

SHARE = 0.5
"""Fraction of the tolerance allotted to the numerical error; the rest is for the model error."""


@dataclass(frozen=True)
class Prediction(Drawable, Shown):
    """A speed and the level that gave it.

    speed: `speed.error` is the numerical error and `speed.model_error` the distance to the target, NaN
    where unknown (never for method = "auto"). level: a key of `levels.LEVELS`; reason: why this level
    was chosen and no cheaper one, in words. converged: whether `error`, numerical plus model error,
    meets the tolerance (or none was asked for, tolerance = None) and there is no caution: what else is
    wrong with the speed, in words. not_in_error: parts that were not estimated, in words, of a level
    that is not compared with the target. seconds: total time, with the levels that were tried in vain.
    left_out: effects that the target itself neglects, in words: it is a flat sheet without thickness on
    which friction alone acts. scene, tolerance: the question. passed: the levels that were not chosen,
    and why. `str` prints the answer in a dozen lines (see `answer.block`), in units of the length L of
    the sheet and the period T of the wave.

    >>> from fem_check import predict
    >>> from linear_theory import Sheet, SineWave
    >>> found = predict(Sheet(), SineWave(), alpha=0.25, rtol=0.2)
    >>> print(f"V = {found.mean:.2f} +- {found.error:.2f} L/T: {found.reason}")
    V = 0.10 +- 0.01 L/T: strip meets the tolerance
    >>> print(str(found).splitlines()[2])
      speed     0.101 ± 0.015 L/T, along the wave; 10.1 % of L per period
    """

    speed: CrawlSpeed
    level: str
    reason: str
    converged: bool
    seconds: float
    left_out: tuple[str, ...]
    scene: Scene
    tolerance: Tolerance | None
    passed: tuple["Passed", ...] = ()
    not_in_error: tuple[str, ...] = ()
    caution: str = ""

    @property
    def mean(self) -> float:
        """Mean speed, length per time, positive towards +y."""
        return self.speed.mean

    @property
    def error(self) -> float:
        """Numerical plus model error, absolute; NaN where the latter is unknown.

        Of a level that is not compared with the target (see not_in_error) the numerical error.
        """
        alone = self.not_in_error and math.isnan(self.speed.model_error)
        return self.speed.error if alone else total_error(self.speed)

    @property
    def model_error(self) -> float:
        """Distance of the level to the target, absolute."""
        return self.speed.model_error

    @property
    def regime(self) -> Regime:
        """See `CrawlSpeed.regime`."""
        return self.speed.regime

    def to_row(self) -> dict[str, Any]:
        """A row of a table of many answers: numbers and texts by name, those of the scene with dots.

        What is unknown is None; the columns of the answer are named as in the records of sweeps.

        >>> from fem_check import predict
        >>> from linear_theory import Sheet, SineWave
        >>> row = predict(Sheet(), SineWave(), alpha=0.25, rtol=0.2).to_row()
        >>> print(f"{row['mean']:.2f} +- {row['error']:.2f}", row["level"], row["scene.sheet.width"])
        0.10 +- 0.01 strip 0.5
        """
        return row(self)

    def __str__(self) -> str:
        return block(self)

    def _title(self) -> str:
        return f"Prediction: {speed_in_words(self.mean, self.error, self.converged)}"

    def _rows(self) -> Mapping[str, Any]:
        numerical, wave = self.speed.error - self.speed.wave_error, self.speed.wave_error
        errors = f"{numerical:.2g} numerical, {number(self.speed.model_error)} model"
        if wave:
            errors += f", {wave:.2g} wave"
        answer = {"level": self.level, "reason": self.reason, "error": errors}
        left_out = {"left_out": "; ".join(self.left_out)} if self.left_out else {}
        friction = {"regime": self.speed.regime, "model": self.speed.model}
        return {**answer, **friction, **left_out, "seconds": self.seconds}

    def _contents(self) -> Mapping[str, Any]:
        return {"mean": self.mean, "error": self.error, **super()._contents()}


class _Passed(NamedTuple):
    level: str
    why: str
    seconds: float


class Passed(Shown, _Passed):
    """A level that was not chosen, why (in words), and the time spent on it in seconds."""


def predict(
    sheet: Sheet | Scene,
    wave: Wave | None = None,
    alpha: float | None = None,
    growth_law: GrowthLaw | str | None = None,
    area: Reference | str | None = None,
    load: Load | str | None = None,
    friction: FrictionLaw | str | None = None,
    slip_speed: float | None = None,
    rtol: float = 1e-2,
    atol: float | None = None,
    method: str = "auto",
    *,
    progress: bool | Report | None = None,
) -> Prediction:
    """Speed of the nonlinear sheet, by the cheapest level known to meet the tolerance.

    The target is a planar sheet that grows by growth_law, with its elastic energy counted per `area`
    and the normal load `load`, too stiff for friction to change its shape; arguments as in
    `crawl_speed`, or a planar `Scene`. method = "auto" tries "strip", "first order", "second order" and
    "cycle" in this order and returns the first whose numerical plus model error is below
    max(rtol |mean|, atol), atol = 1e-3 rtol alpha^2 L/T unless given; a level whose model error is
    unknown (see `model_error`) is skipped. The name of a level as method selects that level.
    `converged` is False if even the last level misses the tolerance. `left_out` lists what the target
    neglects (bending, and with it the thickness; the ground; deformation by friction): for scenes with
    these effects use `cycle_speed` and `simulate`. progress: True prints on stderr, a function is
    called with a `linear_theory.common.progress.Progress`.

    Raises ValueError for bad input and what the chosen level raises. Warns as `crawl_speed` does, for
    the level that gives the answer.

    >>> from fem_check import predict
    >>> from linear_theory import Sheet, SineWave
    >>> found = predict(Sheet(), SineWave(), alpha=0.05, rtol=0.1)
    >>> print(f"V = {found.mean:.4f} L/T by {found.level}, converged {found.converged}")
    V = 0.0038 L/T by second order, converged True
    """
    start = time.perf_counter()
    scene = Scene.stated(
        sheet, wave, alpha, load, friction, slip_speed, growth_law=growth_law, area=area
    )
    THEORY.require(scene)
    tolerance = Tolerance(rtol, atol).of_speed(scene.alpha, scene.unit)
    validation.choice("method", method, METHODS)
    with watched(progress, "predict"):
        if method == "auto":
            found = _cheapest(scene, tolerance)
        else:
            found = _answer(scene, method, tolerance, "requested")
            found = replace(found, reason=f"{found.reason}; {found.speed.reach}")
    warn_if_viscous(scene.contact.friction, found.speed.slip_ratio)
    warn_if_beyond(scene.alpha, found.speed.beyond_reach)
    return replace(found, seconds=time.perf_counter() - start)


def not_estimated(level: str, speed: CrawlSpeed) -> tuple[str, ...]:
    """Parts of the model error of a level that it does not estimate, in words.

    A cycle of shapes is exact but for the deformation by friction, where a scene has its coefficient.
    """
    return (BY_FRICTION,) if level == TARGET and math.isnan(speed.model_error) else ()


def total_error(speed: CrawlSpeed) -> float:
    """Numerical plus model error, absolute; NaN where the model error is unknown."""
    return speed.error + speed.model_error


def _cheapest(scene: Scene, tolerance: Tolerance) -> Prediction:
    """Try the levels that may meet the tolerance in turn, the target last."""
    passed: list[Passed] = []
    largest = math.inf
    for level in LEVELS:
        begin = time.perf_counter()
        obstacle = _obstacle(scene, level, tolerance.allowed(largest))
        if not obstacle:
            try:
                found = _answer(scene, level, tolerance, "")
            except NotConvergedError as failure:
                obstacle = str(failure)
            else:
                if found.converged:
                    return _explained(found, f"{level} meets the tolerance", passed)
                largest = abs(found.mean) + found.error
                obstacle = f"error {found.error:.1g} is above {tolerance.allowed(found.mean):.1g}"
        passed.append(Passed(level, obstacle, time.perf_counter() - begin))
    return _explained(found, f"{level} is the last level", passed)


def _explained(found: Prediction, reason: str, passed: list[Passed]) -> Prediction:
    """The prediction with the reasons for this level and against those before it."""
    others = "".join(f"; not {one.level}: {one.why}" for one in passed)
    return replace(found, reason=reason + others, passed=tuple(passed))


def _obstacle(scene: Scene, level: str, allowed: float) -> str:
    """Why a level cannot meet the tolerance, known without solving; empty if it may. allowed: error."""
    model = distance(level, scene)
    if math.isnan(model):
        return "its model error is unknown here"
    if model > allowed:
        return f"its model error {model:.1g} is above {allowed:.1g}"
    return ""


@one_blas_thread
def _answer(scene: Scene, level: str, tolerance: Tolerance, reason: str) -> Prediction:
    with warnings.catch_warnings():
        for kind in (ViscousRegimeWarning, BeyondReachWarning):  # `predict` warns, for the answer
            warnings.simplefilter("ignore", kind)
        with part_of(level):
            speed = LEVELS[level](scene, tolerance.share(SHARE))
    lacking, omitted = not_estimated(level, speed), left_out(TARGET_EFFECTS)
    error = speed.error if lacking else total_error(speed)
    converged = not speed.beyond_reach and error <= tolerance.allowed(speed.mean)
    found = Prediction(speed, level, reason, converged, speed.seconds, omitted, scene, tolerance)
    return replace(found, not_in_error=lacking)
