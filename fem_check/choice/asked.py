"""Whether the question of a scene and its [run] has an answer, before any work on it."""

import contextlib

from fem_check.choice.expected import RAMP
from fem_check.choice.settings import RunSettings
from fem_check.choice.ways import way_of
from linear_theory.common.errors import NotConvergedError
from linear_theory.scene.scene import Scene
from linear_theory.speed.plate.contact import require_contact


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


def check_contact_for(scene: Scene, way: str) -> None:
    """Raise ValueError where a level was chosen that needs contact everywhere, and the sheet lifts off.

    way: as `way_of` names it. Not part of `way_for`, since it takes the deflection of the sheet: tens
    of milliseconds.
    """
    if way == "second order" and not scene.planar:
        with contextlib.suppress(NotConvergedError):  # which the level tells
            require_contact(scene)
