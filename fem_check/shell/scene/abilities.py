"""What each level can represent, in one place, and the refusal of all else.

A scene names what acts on the sheet, and a level that would drop any of it must not answer. Every level
lists the effects that it honours, each with a judge that says what of such an effect is beyond it. What
no level lists, such as an effect that was added without thought of the levels, is refused by all.
"""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass

import numpy as np

from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.effects.loads import DeadLoad
from fem_check.shell.scene.scene import Scene
from linear_theory.common.shown import Shown

Judge = Callable[[Effect, Scene], str]
"""What of an effect, in a scene, a level cannot represent, in words; empty if it can all of it."""

WEAK = 0.1
"""Largest strain by friction over that by growth at which a shape counts as not affected by friction.
Dry speeds of the paper's sheet by `simulate` (a sine and a pulse, two loads, alpha = 0.05 and 0.25)
then are within 1.5 % of a cycle's, at a tenth of it within 0.2 %, at three times as much within 8 %."""


@dataclass(frozen=True)
class Level(Shown):
    """A way to an answer from a scene.

    call: how it is asked for. effects: judges of the effects that it honours, by class. conditions:
    what else of a scene is beyond it, each in words or empty.
    """

    call: str
    effects: Mapping[type, Judge]
    conditions: tuple[Callable[[Scene], str], ...] = ()

    def objections(self, scene: Scene) -> list[str]:
        """Everything of the scene that the level cannot represent, in words."""
        found = [self._judged(effect, scene) for effect in scene.effects]
        found += [condition(scene) for condition in self.conditions]
        return [words for words in found if words]

    def require(self, scene: Scene) -> None:
        """Raise ValueError where the level would drop something, and name the levels that would not."""
        objections = self.objections(scene)
        if not objections:
            return
        others = [level.call for level in LEVELS if level is not self and not level.objections(scene)]
        able = f"{' and '.join(others)} can" if others else "no level can"
        raise ValueError(f"effects: {self.call} cannot represent {'; '.join(objections)}; {able}")

    def _judged(self, effect: Effect, scene: Scene) -> str:
        judge = self.effects.get(type(effect))
        return type(effect).__name__ if judge is None else judge(effect, scene)


def wholly(effect: Effect, scene: Scene) -> str:
    """The judge of what a level honours in all of its forms."""
    return ""


def friction_over_growth(scene: Scene) -> float:
    """Strain by friction, mu (weight per area) L/(E h), over that by growth, |alpha|.

    0 without friction, infinite where alpha = 0.
    """
    friction, gravity = scene.find(Friction), scene.find(Gravity)
    if friction is None or gravity is None:
        return 0.0
    material = scene.find(Membrane).material
    strain = friction.coefficient * gravity.weight * scene.sheet.length
    strain /= material.young * material.thickness
    return float(strain / abs(scene.alpha)) if scene.alpha else np.inf


def _level_or_planar(effect: Effect, scene: Scene) -> str:
    """Of Gravity, in a cycle of static shapes."""
    assert isinstance(effect, Gravity)
    if effect.incline and not scene.planar:
        return f"Gravity(incline = {effect.incline:g}) of a sheet in space"
    if effect.incline and scene.find(Friction) is None:
        return (
            f"Gravity(incline = {effect.incline:g}) without Friction, whose coefficient holds the sheet"
        )
    if effect.area == "current" and not scene.planar:
        return "Gravity(area = 'current') of a sheet in space"
    return ""


def _flat_and_undamped(effect: Effect, scene: Scene) -> str:
    """Of the Ground, in a cycle of static shapes."""
    assert isinstance(effect, Ground)
    beyond = {
        "height": effect.height is not None,
        f"damping = {effect.damping:g}": effect.damping != 0,
        "area = 'current'": effect.area == "current",
    }
    named = [words for words, there in beyond.items() if there]
    return f"Ground({', '.join(named)})" if named else ""


def _weak(effect: Effect, scene: Scene) -> str:
    """Of Friction, where it must not change the shape."""
    ratio = friction_over_growth(scene)
    if ratio <= WEAK or scene.alpha == 0:
        return ""
    return (
        f"Friction that deforms the sheet: mu weight L/(E h |alpha|) = {ratio:.3g}, must be <= {WEAK:g}"
    )


def _moves_in_time(scene: Scene) -> str:
    if scene.find(Friction) is None and scene.find(Inertia) is None:
        return "a scene without Friction and Inertia, which has no motion in time"
    return ""


CYCLE = Level(
    "cycle_speed(scene)",
    {
        Membrane: wholly,
        Bending: wholly,
        Gravity: _level_or_planar,
        Ground: _flat_and_undamped,
        Friction: _weak,
    },
)

STEPPED = Level(
    "simulate(scene)",
    dict.fromkeys((Membrane, Bending, Gravity, Ground, Friction, Inertia, DeadLoad), wholly),
    (_moves_in_time,),
)

LEVELS = (CYCLE, STEPPED)

WORDS: Mapping[type, str] = {
    Bending: "bending, buckling and so the thickness",
    Ground: "the ground",
    Gravity: "weight, but as the load of friction",
    Friction: "friction that deforms the sheet",
    Inertia: "inertia",
}
"""What the levels know besides stretching, for people."""


def left_out(named: Collection[type]) -> tuple[str, ...]:
    """What an answer leaves out whose effects are of the classes `named`, in words."""
    return tuple(words for kind, words in WORDS.items() if kind not in named)
