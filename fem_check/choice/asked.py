"""Whether the question of a scene and its [run] has an answer, before any work on it."""

from fem_check.choice.expected import RAMP
from fem_check.choice.settings import RunSettings
from fem_check.choice.ways import way_of
from linear_theory.scene.scene import Scene


def way_for(scene: Scene, settings: RunSettings) -> str:
    """As `way_of`, for these settings: of the wave, too, as much is known as the level needs.

    Raises ValueError as `way_of`; for a wave that does not repeat beside a level that takes the mean of
    a period; and for one that is not solved until the end of the periods that are asked for.

    >>> from fem_check.choice.asked import way_for
    >>> from fem_check.choice.settings import RunSettings
    >>> from linear_theory import Scene, Sheet, SineWave
    >>> print(way_for(Scene(Sheet(), SineWave(), alpha=0.25), RunSettings("cycle")))
    cycle
    """
    way = way_of(scene, settings.level)
    if way == "stepped":
        scene.drive.check_until(scene.period * (RAMP + settings.periods))
        return way
    try:
        scene.drive.check_period()
    except ValueError as problem:
        if settings.level == "auto":
            raise
        raise ValueError(
            f"level = {settings.level!r}: must be 'stepped' or 'auto' beside this wave ({problem})"
        ) from None
    return way
