"""Answers of a cycle of shapes, and what answers of all levels for any scene have in common."""

from fem_check.choice.levels import TARGET
from fem_check.choice.result import Prediction, not_estimated
from fem_check.shell.abilities import left_out
from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import Friction
from linear_theory.common.progress import Report
from linear_theory.common.tolerance import Tolerance
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed
from linear_theory.wave.uncertain import error_words, uncertainty_of

CROSSES = "the sheet passes through itself, which no real one does"
NOISY = "the error is without that of the wave, which may be larger than the tolerance"
UNSTABLE = "growth is so strong that the shapes may not exist on a finer mesh"
SIDEWAYS = "the tolerance is met along the sheet, but not by the sideways motion or the turning"


def by_cycle(scene: Scene, tolerance: Tolerance, progress: Report | None = None) -> Prediction:
    """The answer of a cycle of shapes."""
    from fem_check.shell.cycle.speed import cycle_speed  # here: it loads finite elements

    speed = cycle_speed(scene, rtol=tolerance.rtol, progress=progress)
    lacking, caution, lost = not_estimated(TARGET, speed), _crossing(speed), noise(speed, scene)
    met = speed.error <= tolerance.allowed(speed.mean)
    if met and not (speed.converged or speed.beyond_reach or caution):
        caution = NOISY if lost else SIDEWAYS if _turns_too_vaguely(speed, tolerance) else UNSTABLE
    named = {type(effect) for effect in scene.effects} - {Friction}
    return answer_of(TARGET, speed, named, scene, tolerance, (*lacking, *lost), caution)


def _crossing(speed: CrawlSpeed) -> str:
    """A caution, if the shapes of a cycle pass through themselves."""
    from fem_check.shell.cycle.deformation import CycleDeformation

    shown = speed.deformation
    return CROSSES if isinstance(shown, CycleDeformation) and shown.crosses else ""


def _turns_too_vaguely(speed: CrawlSpeed, tolerance: Tolerance) -> bool:
    """Whether the error of the sideways motion or of the turning is above the tolerance."""
    if speed.turning is None:
        return False
    pairs = zip(speed.turning.mean, speed.turning.error, strict=True)
    return any(error > tolerance.allowed(float(mean)) for mean, error in pairs)


def noise(speed: CrawlSpeed, scene: Scene) -> list[str]:
    """The error of the wave in words, where that of the speed is without it."""
    counted = speed.wave_error or uncertainty_of(scene.wave) is None
    return [] if counted else [error_words(scene.wave)]


def answer_of(
    way: str,
    speed: CrawlSpeed,
    named: set[type[Effect]],
    scene: Scene,
    tolerance: Tolerance | None,
    lacking: tuple[str, ...],
    caution: str,
) -> Prediction:
    """The answer of a level, `way`; lacking: what is not in its error."""
    return Prediction(
        *(speed, way, f"{way}, the cheapest that represents the scene", speed.converged, speed.seconds),
        *(left_out(named), scene, tolerance),
        not_in_error=lacking,
        caution=caution,
    )
