"""Any scene to its answer, by the cheapest level that represents all that it names."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

from fem_check.choice.answers import CROSSES, answer_of, by_cycle, noise
from fem_check.choice.prediction import predict
from fem_check.choice.result import Prediction
from fem_check.choice.settings import RTOL, RunSettings
from fem_check.choice.ways import PREDICTED, way_of
from fem_check.shell.cycle.wrinkling import WRINKLES
from fem_check.shell.statics.meter import Meter, metered
from fem_check.shell.stepping.further.progress import FIRST
from fem_check.shell.stepping.further.progress import Progress as Steps
from fem_check.shell.stepping.simulation import simulate
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.common import validation
from linear_theory.common.progress import Progress, Report, reporting, watched
from linear_theory.common.tolerance import Tolerance
from linear_theory.scene.scene import Scene

REPEATED = 0.1
"""Largest difference of the last two periods, relative to the speed, of a motion that repeats."""


def solve(
    scene: Scene,
    level: str = "auto",
    rtol: float | None = 1e-2,
    *,
    periods: int = 2,
    steps: int | None = None,
    progress: bool | Report | None = None,
) -> Prediction:
    """How fast any scene crawls, by the cheapest level that represents all that it names.

    level: "auto", or one by name: "predict" for a rectangle that stretches in its plane (or "strip",
    "first order", "second order", levels of it; "line", a one-dimensional body), "cycle" for a cycle of
    static shapes, "stepped" for steps in time. A sheet that bends is taken by "auto" to a cycle of its
    shapes; "predict" tries the plate on its ground first, "second order" asks for it. rtol: of the
    speed. periods: of steps in time, after the growth has risen; steps: to a period, instead of the
    tolerance. progress: True prints on stderr, a function is called with a `Progress`.

    Raises ValueError for a scene that no level, or not the one asked for, represents, and what
    `predict`, `cycle_speed` and `simulate` raise, which return more: shapes, and the motion in time.

    >>> from fem_check import Friction, Gravity, Material, Membrane, Scene, solve
    >>> from linear_theory import Sheet, SineWave
    >>> stretching, friction = Membrane(Material(0.03, 0.5)), Friction(1.0, slip_speed=5e-4)
    >>> effects = [stretching, Gravity(3e-6, load="current", incline=0.1), friction]
    >>> slope = Scene(Sheet(), SineWave(), alpha=0.25, effects=effects, cells=(2, 4))
    >>> for scene in (Scene(Sheet(), SineWave(), alpha=0.25), slope):
    ...     found = solve(scene, rtol=0.2)
    ...     print(f"V = {found.mean:.2f} L/T by {found.level}")
    V = 0.10 L/T by strip
    V = 0.05 L/T by cycle
    """
    scene = validation.instance("scene", scene, Scene)
    with watched(progress, "solve"):
        return solved(scene, RunSettings(level, rtol, periods, steps), reporting(progress)).answer


class Solved(NamedTuple):
    """An answer, the motion in time that gave it (None where it was not stepped), and its cost."""

    answer: Prediction
    motion: Trajectory | None
    cost: Meter


def solved(
    scene: Scene, settings: RunSettings, progress: Report | None = None, **stepping: Any
) -> Solved:
    """As `solve`, with the motion. stepping: further arguments of `simulate`, such as its snapshot."""
    way = way_of(scene, settings.level)
    rtol = settings.rtol
    tolerance = None if rtol is None else Tolerance(rtol).of_speed(scene.alpha, scene.unit)
    with metered() as cost:
        if way == "stepped":
            heard = False if progress is None else _steps_to(progress)
            motion = simulate(scene, settings.periods, rtol, settings.steps, progress=heard, **stepping)
            return Solved(_by_steps(motion, tolerance), motion, cost)
        tolerance = tolerance or Tolerance(RTOL).of_speed(scene.alpha, scene.unit)
        if way == "cycle":
            return Solved(by_cycle(scene, tolerance, progress), None, cost)
        found = predict(scene, rtol=tolerance.rtol, level=PREDICTED[way], progress=progress)
    return Solved(found, None, cost)


def _by_steps(motion: Trajectory, tolerance: Tolerance | None) -> Prediction:
    """The answer of a motion in time; tolerance: None where steps were asked for instead."""
    scene, errors, caution = motion.scene, motion.errors, _caution(motion)
    met = tolerance is None or motion.speed.error <= tolerance.allowed(motion.speed.mean)
    # The model error of a motion is the distance to dry friction, which is not asked for here.
    speed = replace(motion.speed, model_error=math.nan, converged=met and not caution)
    estimates = {"error of the mesh": errors.mesh, "change from period to period": errors.spread}
    lacking = [part for part, error in estimates.items() if math.isnan(error)]
    lacking += noise(speed, scene)
    named = {type(effect) for effect in scene.effects}
    return answer_of("stepped", speed, named, scene, tolerance, tuple(lacking), caution)


def _caution(motion: Trajectory) -> str:
    """What is wrong with the speed of a motion, whatever tolerance is asked for."""
    failed = motion.errors.failed
    unknown = f"{failed}, without which the error of the speed is not known" if failed else ""
    return "; ".join(filter(None, (_unsound(motion), unknown)))


def _unsound(motion: Trajectory) -> str:
    """What is wrong with the motion itself."""
    if motion.crossed is not None and motion.crossed.any():
        return CROSSES
    if motion.wrinkled.any():
        return f"the sheet is {WRINKLES}; a sheet that bends buckles instead: name Bending"
    if motion.snaps:
        lower = ": the error is a lower bound" if math.isnan(motion.errors.snaps) else ""
        return f"the sheet snaps over in the last period, where its path depends on the steps{lower}"
    scene, spread = motion.scene, motion.errors.spread
    mean = motion.speed.mean
    if spread > Tolerance(REPEATED).of_speed(scene.alpha, scene.unit).allowed(mean):
        share = f"{100 * spread / abs(mean):.2g} % of the speed" if mean else f"{spread:.2g}"
        return (
            f"the last two periods differ by {share}: the motion does not repeat yet, or never does; "
            "run more periods"
        )
    return ""


def _steps_to(report: Report) -> Callable[[Steps], None]:
    """Tells of steps in time as of any other work."""

    def heard(steps: Steps) -> None:
        task = "" if steps.task == FIRST else f" {steps.task}"
        report(Progress(f"steps in time{task}", steps.share, steps.seconds, steps.left))

    return heard
