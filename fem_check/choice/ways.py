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
    for name, level in WAYS.items():
        if not level.objections(scene):
            return name
    objections = (f"{name}: {'; '.join(level.objections(scene))}" for name, level in WAYS.items())
    raise ValueError(f"effects: no level represents this scene ({', '.join(objections)})")


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
        found, motion = _by_elements(scene, way, tolerance, periods, steps, progress, stepping)
    return Solved(found, motion, cost)


def _by_elements(
    scene: Scene,
    way: str,
    tolerance: Tolerance,
    periods: int,
    steps: int | None,
    progress: Report | None,
    stepping: dict[str, Any],
) -> tuple[Prediction, Trajectory | None]:
    motion = None
    if way == "cycle":
        speed = cycle_speed(scene, rtol=tolerance.rtol, progress=progress)
    else:
        heard = False if progress is None else _steps_to(progress)
        rtol = None if steps else tolerance.rtol
        motion = simulate(scene, periods, rtol=rtol, steps=steps, progress=heard, **stepping)
        speed = replace(motion.speed, model_error=math.nan)  # there: how far from dry friction
    named = {type(effect) for effect in scene.effects} - ({Friction} if way == "cycle" else set())
    reason = f"{way}, the cheapest that represents the scene"
    missing = left_out(named)
    found = Prediction(speed, way, reason, speed.converged, speed.seconds, missing, scene, tolerance)
    return found, motion


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
