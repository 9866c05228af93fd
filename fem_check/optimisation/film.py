"""A film of before and after: the given scene above the best one, on one ground, clock and scale."""

import warnings
from pathlib import Path
from typing import Any

from fem_check.answer.units import Units
from fem_check.choice.result import Prediction
from fem_check.choice.settings import RTOL, RunSettings
from fem_check.choice.solving import solved
from fem_check.choice.ways import way_of
from fem_check.optimisation.finding import LADDER
from fem_check.optimisation.result import Optimum
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.common.errors import BeyondReachWarning, SheetcrawlError, ViscousRegimeWarning
from linear_theory.optimisation.problem import Unusable
from linear_theory.scene.scene import Scene

NAMES = ("as given", "best")

Motion = Prediction | Trajectory


class NoFilm(SheetcrawlError):
    """No level has shapes of both scenes; says why."""


def film(
    best: Optimum,
    given: Scene,
    path: str | Path,
    *,
    units: Units | None = None,
    progress: Any = False,
    **look: Any,
) -> tuple[Path, str]:
    """Write the film, .gif or .mp4; its path, and the level whose motions it shows.

    best: of `optimise`; given: the scene that it was asked about. The level is that of the search, or
    the next one that has shapes of both. look: periods, frames, fps, width of `output.movies.race`,
    which raises ValueError. Raises `NoFilm` where no level has an answer for both scenes.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from fem_check import optimise
    >>> from fem_check.optimisation.film import film
    >>> from linear_theory import Scene, Sheet, SineWave
    >>> scene = Scene(Sheet(width=0.2), SineWave(), alpha=0.1)
    >>> best = optimise(scene, {"growth.alpha": (0.05, 0.2)}, level="strip", starts=1, check=False)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     look = {"periods": 1, "frames": 3, "width": 420}
    ...     path, level = film(best, scene, Path(folder) / "best.gif", **look)
    ...     print(level, path.stat().st_size > 1000)
    strip True
    """
    from fem_check.output.movies import race

    level, motions = shown(best, given)
    return race(motions, NAMES, path, units=units or best.units, progress=progress, **look), level


def shown(best: Optimum, given: Scene) -> tuple[str, tuple[Motion, Motion]]:
    """The level of the film, and motions of the given scene and of the best one.

    Raises `NoFilm` where no level has both.
    """
    problems = []
    for level in LADDER[LADDER.index(best.level) :]:
        try:
            way_of(best.scene, level)
            found = tuple(_motion(scene, level, best) for scene in (given, best.scene))
        except (SheetcrawlError, ValueError, ArithmeticError) as problem:
            problems.append(f"{level}: {' '.join(str(problem).split())}")
            continue
        if all(map(_has_shape, found)):
            return level, (found[0], found[1])
        problems.append(f"{level}: has no shapes")
    raise NoFilm(f"no film: no level shows both scenes ({'; '.join(problems)})")


def _motion(scene: Scene, level: str, best: Optimum) -> Motion:
    """Of a scene; what is known is not computed again. Raises `Unusable` beyond reach."""
    if level == best.level != "stepped" and scene == best.scene:
        return best.answer
    with warnings.catch_warnings():
        for kind in (ViscousRegimeWarning, BeyondReachWarning):
            warnings.simplefilter("ignore", kind)
        found = solved(scene, RunSettings(level, RTOL))
    if found.answer.speed.beyond_reach:
        raise Unusable(found.answer.speed.beyond_reach)
    return found.motion or found.answer


def _has_shape(found: Motion) -> bool:
    from fem_check.output.pictures import moving_of

    return moving_of(found).has_shape
