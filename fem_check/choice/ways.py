"""The levels that answer any scene, and the cheapest one that represents all that a scene names.

predict   a rectangle that stretches in its plane: the cheapest level that meets the tolerance
cycle     any outline, bending, flat ground: a cycle of static shapes and the friction balance
stepped   all effects, step by step in time
"""

from fem_check.choice.levels import LEVELS
from fem_check.shell.abilities import CYCLE, STEPPED
from linear_theory.common import validation
from linear_theory.scene.level import PLATE, THEORY, Level
from linear_theory.scene.scene import Scene

WAYS: dict[str, Level] = {"predict": THEORY, "cycle": CYCLE, "stepped": STEPPED}
"""By name, cheapest first."""

THEORIES = tuple(level for level in LEVELS if level not in WAYS)
"""Levels of `predict` that may be asked for by name, too."""

ANSWERS = ("auto", *WAYS, *THEORIES)


def way_of(scene: Scene, asked: str = "auto") -> str:
    """The cheapest of WAYS that represents the scene, or the level that is asked for, of ANSWERS.

    Raises ValueError, with what it cannot represent, where there is none.

    >>> from fem_check.choice.ways import way_of
    >>> from linear_theory import Scene, Sheet, SineWave
    >>> print(way_of(Scene(Sheet(), SineWave(), alpha=0.25)))
    predict
    """
    validation.choice("level", asked, ANSWERS)
    if asked != "auto":
        on_plate = asked == "second order" and not scene.planar
        (PLATE if on_plate else WAYS.get(asked, THEORY)).require(scene)
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
