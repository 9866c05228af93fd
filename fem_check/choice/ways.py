"""The levels that answer any scene, and the cheapest one that represents all that a scene names.

predict   a rectangle that stretches in its plane: the cheapest level that meets the tolerance
cycle     any outline, bending, flat ground: a cycle of static shapes and the friction balance
stepped   all effects, step by step in time

Asked for by name "predict" answers a sheet that bends, too, by the plate or a cycle of its shapes.
"""

from fem_check.choice.levels import ASIDE, LEVELS
from fem_check.choice.reach import check_width
from fem_check.shell.abilities import CYCLE, STEPPED
from linear_theory.common import validation
from linear_theory.scene.level import PLATE, THEORY, Level
from linear_theory.scene.scene import Scene

WAYS: dict[str, Level] = {"predict": THEORY, "cycle": CYCLE, "stepped": STEPPED}
"""By name, cheapest first."""

THEORIES = (*(level for level in LEVELS if level not in WAYS), *ASIDE)
"""Levels of `predict` that may be asked for by name, too."""

ANSWERS = ("auto", *WAYS, *THEORIES)

PREDICTED = {"predict": "auto", **{level: level for level in THEORIES}}
"""Levels that `predict` answers, and its argument `level` for them."""

ON_GROUND: dict[str, Level] = {"predict": CYCLE, "second order": PLATE}
"""What they represent of a sheet that bends, where that is more than of a flat one."""


def level_of(scene: Scene, way: str) -> Level:
    """What a level by name, of ANSWERS, can represent of scenes like this one.

    A sheet that bends is answered by "second order" as a plate on its ground, and by "predict" as by a
    cycle of its shapes, from which the plate is at a known distance at best.

    >>> from fem_check import Bending, Gravity, Ground, Material, Membrane
    >>> from fem_check.choice.ways import level_of
    >>> from linear_theory import Scene, Sheet, SineWave
    >>> material = Material(0.03, 0.5)
    >>> effects = [Membrane(material), Bending(material), Gravity(2.5e-4), Ground(0.5)]
    >>> scene = Scene(Sheet(), SineWave(), 0.01, -0.1, effects)
    >>> print(*(level_of(scene, way).call for way in ("predict", "second order")))
    cycle_speed(scene) crawl_speed(scene, order=2)
    """
    if not scene.planar and way in ON_GROUND:
        return ON_GROUND[way]
    return WAYS.get(way, THEORY)


def way_of(scene: Scene, asked: str = "auto") -> str:
    """The cheapest of WAYS that represents the scene, or the level that is asked for, of ANSWERS.

    Raises ValueError, with what it cannot represent, where there is none.

    >>> from fem_check.choice.ways import way_of
    >>> from linear_theory import Scene, Sheet, SineWave
    >>> print(way_of(Scene(Sheet(), SineWave(), alpha=0.25)))
    predict
    """
    validation.choice("level", asked, ANSWERS)
    way = _cheapest(scene) if asked == "auto" else asked
    if asked != "auto":
        _require(scene, asked)
    if way in PREDICTED:
        check_width(scene, PREDICTED[way])
    return way


def check_shape(level: str) -> None:
    """Raise ValueError for a level by name whose answers have no shape, which nothing can draw.

    >>> from fem_check.choice.ways import check_shape
    >>> check_shape("strip")
    """
    if level in ASIDE:
        raise ValueError(
            f"level = {level!r}: has no shape to be filmed or kept in a folder, only a speed; level = "
            "'strip' has that of the sheet"
        )


def _cheapest(scene: Scene) -> str:
    """Of WAYS."""
    steps = not STEPPED.objections(scene)
    for name, level in WAYS.items():
        if not level.objections(scene) and (not steps or level is STEPPED or _repeats(scene)):
            return name
    objections = (f"{name}: {'; '.join(level.objections(scene))}" for name, level in WAYS.items())
    raise ValueError(
        f"effects: no level represents this scene{_remedy(scene)} ({', '.join(objections)})"
    )


def _remedy(scene: Scene) -> str:
    """What is missing on a slope, which every level needs."""
    rubs = any(effect.law is not None for effect in scene.effects)
    inclines = [effect.incline for effect in scene.effects if effect.incline]
    if rubs or not inclines:
        return ""
    return f": nothing holds the sheet on its slope, incline = {inclines[0]:g}; name Friction"


def _require(scene: Scene, asked: str) -> None:
    """Raise ValueError if the level cannot represent the scene, naming others that can."""
    objections = level_of(scene, asked).objections(scene)
    if not objections:
        return
    able = [repr(way) for way in ANSWERS[1:] if not level_of(scene, way).objections(scene)]
    others = f"must be {_listed(able)}" if able else "no other level can"
    raise ValueError(f"level = {asked!r}: cannot represent {'; '.join(objections)}; {others}")


def _listed(words: list[str]) -> str:
    return " or ".join(filter(None, (", ".join(words[:-1]), words[-1])))


def _repeats(scene: Scene) -> bool:
    """Whether a mean over one period of the wave has a meaning."""
    try:
        scene.drive.check_period()
    except ValueError:
        return False
    return True
