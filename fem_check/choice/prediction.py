"""The speed to a given tolerance, by the cheapest level whose numerical plus model error meets it."""

import math
import time
import warnings
from dataclasses import replace

from fem_check.choice.bending import BENDING, bending_answer
from fem_check.choice.levels import ASIDE, LEVELS, TARGET_EFFECTS, distance
from fem_check.choice.reach import check_width
from fem_check.choice.result import Passed, Prediction, not_estimated, total_error
from fem_check.choice.settings import SHARE
from fem_check.shell.abilities import CYCLE, left_out
from linear_theory.common import validation
from linear_theory.common.errors import (
    BeyondReachWarning,
    NotConvergedError,
    ViscousRegimeWarning,
)
from linear_theory.common.progress import Report, part_of, watched
from linear_theory.common.threads import one_blas_thread
from linear_theory.common.tolerance import Tolerance
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.load import Load
from linear_theory.friction.regime import warn_if_viscous
from linear_theory.growth.growth import Reference
from linear_theory.growth.laws import GrowthLaw
from linear_theory.scene.level import PLATE, THEORY, Level
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.reach import warn_if_beyond
from linear_theory.wave.protocol import Wave

LEVEL_NAMES = ("auto", *LEVELS, *ASIDE)
"""What `level` may be for a flat sheet."""


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
    level: str = "auto",
    *,
    progress: bool | Report | None = None,
) -> Prediction:
    """Speed of the nonlinear sheet, by the cheapest level known to meet the tolerance.

    The target is a planar sheet that grows by growth_law, with its elastic energy counted per `area`
    and the normal load `load`, too stiff for friction to change its shape; arguments as in
    `crawl_speed`, or a `Scene`. level = "auto" tries "strip", "first order", "second order" and
    "cycle" in this order and returns the first whose numerical plus model error is below
    max(rtol |mean|, atol), atol = 1e-3 rtol alpha^2 L/T unless given; a level whose model error is
    unknown (see `model_error`) is skipped. The name of a level selects that level,
    and "line" the one-dimensional body of eqs 5 to 7, with its weight per length, which is no sheet.
    `converged` is False if even the last level misses the tolerance. `left_out` lists what the target
    neglects (bending, and with it the thickness; the ground; deformation by friction). A scene with
    Bending has a cycle of its own shapes as target, and "second order", on level ground, and "cycle" as
    levels; `solve` answers those that neither represents. progress: True prints on stderr, a function
    is called with a `linear_theory.common.progress.Progress`.

    Raises ValueError for bad input, for sheets wider than 20 lengths unless `level` is "strip", "line"
    or "first order", and what the chosen level raises. Warns as `crawl_speed` does, for
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
    validation.choice("level", level, LEVEL_NAMES if scene.planar else ("auto", *BENDING))
    _target(scene, level).require(scene)
    tolerance = Tolerance(rtol, atol).of_speed(scene.alpha, scene.unit)
    check_width(scene, level)
    with watched(progress, "predict"):
        if not scene.planar:
            found = bending_answer(scene, tolerance, level)
        elif level == "auto":
            found = _cheapest(scene, tolerance)
        else:
            found = _answer(scene, level, tolerance, "requested")
            found = replace(found, reason=f"{found.reason}; {found.speed.reach}")
    warn_if_viscous(scene.contact.friction, found.speed.slip_ratio)
    warn_if_beyond(scene.alpha, found.speed.beyond_reach)
    return replace(found, seconds=time.perf_counter() - start)


def _target(scene: Scene, level: str) -> Level:
    """What must represent the scene: the target, or the plate where that is asked for by name."""
    if scene.planar:
        return THEORY
    return PLATE if level == "second order" else CYCLE


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
            speed = (LEVELS | ASIDE)[level](scene, tolerance.share(SHARE))
    lacking, omitted = not_estimated(level, speed), left_out(TARGET_EFFECTS)
    error = speed.error if lacking else total_error(speed)
    converged = not speed.beyond_reach and error <= tolerance.allowed(speed.mean)
    found = Prediction(speed, level, reason, converged, speed.seconds, omitted, scene, tolerance)
    return replace(found, not_in_error=lacking)
