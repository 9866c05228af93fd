"""Any scene to its answer, by the cheapest way that represents all that it names.

predict   a rectangle that stretches in its plane: the cheapest level that meets the tolerance
cycle     any outline, bending, flat ground: a cycle of static shapes and the friction balance
stepped   all effects, step by step in time
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any, NamedTuple

from fem_check.choice.prediction import Prediction, predict
from fem_check.shell.abilities import CYCLE, STEPPED, left_out
from fem_check.shell.cycle.speed import cycle_speed
from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import Friction
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.meter import Meter, metered
from fem_check.shell.stepping.run import Progress as Steps
from fem_check.shell.stepping.simulation import simulate
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.common import validation
from linear_theory.common.progress import Progress, Report
from linear_theory.common.tolerance import Tolerance
from linear_theory.scene.level import THEORY, Level
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed
from linear_theory.wave.uncertain import uncertainty_of

WAYS: dict[str, Level] = {"predict": THEORY, "cycle": CYCLE, "stepped": STEPPED}
"""By name, cheapest first."""

RAMP = 0.5
"""Periods in which growth rises before those that are counted, of `simulate`."""

RECTANGLES, TRIANGLES, IN_SPACE, STEP = 1.2e-3, 4e-3, 3e-3, 75e-6
"""Seconds of a cycle of shapes to a quadrature point, of planar rectangles, of planar triangles and of
sheets that bend; and of a step in time. Measured on the scenes of the gallery, to a factor of 3."""

TIGHTER = 0.35
"""Power of 1 % over the tolerance with which a cycle grows: 0.6, 2, 12 s of the paper's sheet at 1e-2,
1e-4 and 1e-6."""

REPEATED = 0.1
"""Largest difference of the last two periods, relative to the speed, of a motion that repeats."""

NOISY = "the error is without that of the measured wave, which may be larger than the tolerance"
UNSTABLE = "growth is so strong that the shapes may not exist on a finer mesh"
SIDEWAYS = "the tolerance is met along the sheet, but not by the sideways motion or the turning"

STEPS = 20
"""In time, to a period, at a tolerance of 10 %; they grow with its square root."""


def way_of(scene: Scene, asked: str = "auto") -> str:
    """The cheapest of WAYS that represents the scene, or the one that is asked for.

    Raises ValueError, with what it cannot represent, where there is none.

    >>> from fem_check.choice.ways import way_of
    >>> from linear_theory import Scene, Sheet, SineWave
    >>> print(way_of(Scene(Sheet(), SineWave(), alpha=0.25)))
    predict
    """
    validation.choice("level", asked, ("auto", *WAYS))
    if asked != "auto":
        WAYS[asked].require(scene)
        return asked
    steps = not STEPPED.objections(scene)
    for name, level in WAYS.items():
        if not level.objections(scene) and (not steps or level is STEPPED or _repeats(scene)):
            return name
    objections = (f"{name}: {'; '.join(level.objections(scene))}" for name, level in WAYS.items())
    raise ValueError(f"effects: no level represents this scene ({', '.join(objections)})")


def _repeats(scene: Scene) -> bool:
    """Whether a mean over one period of the wave has a meaning."""
    try:
        scene.drive.check_period()
    except ValueError:
        return False
    return True


def answer(
    scene: Scene,
    way: str = "auto",
    rtol: float | None = 1e-2,
    periods: int = 2,
    steps: int | None = None,
    progress: Report | None = None,
) -> Prediction:
    """How fast the scene crawls, by a way of `way_of`.

    rtol: of the speed; periods, steps: of a scene that is stepped through time, see `simulate`. Raises
    ValueError as `way_of` does, and what `predict`, `cycle_speed` and `simulate` raise.
    """
    return solved(scene, way, rtol, periods, steps, progress).answer


class Solved(NamedTuple):
    """An answer, the motion in time that gave it (None where it was not stepped), and its cost."""

    answer: Prediction
    motion: Trajectory | None
    cost: Meter


def solved(
    scene: Scene,
    way: str = "auto",
    rtol: float | None = 1e-2,
    periods: int = 2,
    steps: int | None = None,
    progress: Report | None = None,
    **stepping: Any,
) -> Solved:
    """As `answer`, with the motion. stepping: further arguments of `simulate`, such as its snapshot."""
    way = way_of(scene, way)
    tolerance = Tolerance(1e-2 if rtol is None else rtol).of_speed(scene.alpha, scene.unit)
    with metered() as cost:
        if way == "predict":
            return Solved(predict(scene, rtol=tolerance.rtol, progress=progress), None, cost)
        if way == "cycle":
            return Solved(_by_cycle(scene, tolerance, progress), None, cost)
        heard = False if progress is None else _steps_to(progress)
        asked = None if steps else tolerance
        rtol = None if asked is None else asked.rtol
        motion = simulate(scene, periods, rtol, steps, progress=heard, **stepping)
    return Solved(_by_steps(motion, asked), motion, cost)


def _by_cycle(scene: Scene, tolerance: Tolerance, progress: Report | None) -> Prediction:
    """The answer of a cycle of shapes."""
    speed = cycle_speed(scene, rtol=tolerance.rtol, progress=progress)
    lacking, caution, noise = [], "", _noise(speed, scene)
    if math.isnan(speed.model_error):
        lacking.append("deformation by friction, taken as too weak")
    met = speed.error <= tolerance.allowed(speed.mean)
    if met and not speed.converged and not speed.beyond_reach:
        caution = NOISY if noise else SIDEWAYS if _turns_too_vaguely(speed, tolerance) else UNSTABLE
    named = {type(effect) for effect in scene.effects} - {Friction}
    return _found("cycle", speed, named, scene, tolerance, (*lacking, *noise), caution)


def _turns_too_vaguely(speed: CrawlSpeed, tolerance: Tolerance) -> bool:
    """Whether the error of the sideways motion or of the turning is above the tolerance."""
    if speed.turning is None:
        return False
    pairs = zip(speed.turning.mean, speed.turning.error, strict=True)
    return any(error > tolerance.allowed(float(mean)) for mean, error in pairs)


def _by_steps(motion: Trajectory, tolerance: Tolerance | None) -> Prediction:
    """The answer of a motion in time; tolerance: None where steps were asked for instead."""
    scene, errors, caution = motion.scene, motion.errors, _caution(motion)
    met = tolerance is None or motion.speed.error <= tolerance.allowed(motion.speed.mean)
    # The model error of a motion is the distance to dry friction, which is not asked for here.
    speed = replace(motion.speed, model_error=math.nan, converged=met and not caution)
    estimates = {"error of the mesh": errors.mesh, "change from period to period": errors.spread}
    lacking = [part for part, error in estimates.items() if math.isnan(error)]
    lacking += _noise(speed, scene)
    named = {type(effect) for effect in scene.effects}
    return _found("stepped", speed, named, scene, tolerance, tuple(lacking), caution)


def _noise(speed: CrawlSpeed, scene: Scene) -> list[str]:
    """The noise of a measured wave, where the error of the speed is without it."""
    counted = speed.wave_error or uncertainty_of(scene.wave) is None
    return [] if counted else ["noise of the measured wave"]


def _found(
    way: str,
    speed: CrawlSpeed,
    named: set[type[Effect]],
    scene: Scene,
    tolerance: Tolerance | None,
    lacking: tuple[str, ...],
    caution: str,
) -> Prediction:
    return Prediction(
        *(speed, way, f"{way}, the cheapest that represents the scene", speed.converged, speed.seconds),
        *(left_out(named), scene, tolerance),
        not_in_error=lacking,
        caution=caution,
    )


def _caution(motion: Trajectory) -> str:
    """What is wrong with the speed of a motion, whatever tolerance is asked for."""
    if motion.crossed is not None and motion.crossed.any():
        return "the sheet passes through itself, which no real one does"
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
        share = steps.time / steps.end if steps.end else 1.0
        report(Progress("steps in time", share, steps.seconds, steps.left))

    return heard


def expected_seconds(
    scene: Scene, way: str, rtol: float | None = 1e-2, periods: int = 2, steps: int | None = None
) -> float:
    """What the answer will cost on one core, to a factor of about 5; of `predict` at the most."""
    points = ShellModel(scene).discretisation.interior.measure.size
    if way != "stepped":
        triangles = scene.mesh is not None and scene.mesh.t.shape[0] == 3
        price = IN_SPACE if not scene.planar else TRIANGLES if triangles else RECTANGLES
        return float(price * points * max(1.0, 1e-2 / (rtol or 1e-2)) ** TIGHTER)
    count = steps or STEPS * math.sqrt(0.1 / (rtol or 1e-2)) * _highest(scene)
    return float(STEP * points * count * (periods + RAMP))


def _highest(scene: Scene) -> float:
    """Harmonics in time to which steps in time are fine, 1 for a sine."""
    highest = scene.drive.rates.highest(0.1)
    return min(max(float(highest), 1.0), 32.0)
