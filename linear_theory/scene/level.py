"""Which scenes a level of theory can represent, and the refusal of all others.

A scene names the effects on the sheet, and a level that would neglect any of them must not answer.
Effects are an open set: each states itself which part of it is beyond a level.
"""

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from linear_theory.common.shown import Shown
from linear_theory.friction.maps import FixedTo
from linear_theory.scene.scene import Scene

PLATE_NUMBERS = {"rigidity": "Bending", "weight": "Gravity", "stiffness": "Ground"}
"""Numbers of a plate on its ground, and the effects that give them (`plate_numbers`)."""

LEVELS = "fem_check.shell.abilities"
"""The module that lists all levels, imported by name if one of them refuses a scene."""


@dataclass(frozen=True)
class Level(Shown):
    """A level of theory, which computes an answer for a scene.

    call: the call in Python. judge: the part of an effect in a scene that the level cannot represent,
    in words; empty if none. conditions: further parts of a scene beyond the level, each in words or
    empty.
    """

    call: str
    judge: Callable[[Any, Scene], str]
    conditions: tuple[Callable[[Scene], str], ...] = ()

    def objections(self, scene: Scene) -> list[str]:
        """All parts of the scene that the level cannot represent, in words."""
        found = [self.judge(effect, scene) for effect in scene.effects]
        found += [condition(scene) for condition in self.conditions]
        return [words for words in found if words]

    def require(self, scene: Scene) -> None:
        """Raise ValueError if the level cannot represent the scene, naming other levels that can."""
        objections = self.objections(scene)
        if not objections:
            return
        levels = import_module(LEVELS).LEVELS
        able = [level.call for level in levels if level is not self and not level.objections(scene)]
        hint = f"{' and '.join(able)} can" if able else "no level can"
        raise ValueError(f"effects: {self.call} cannot represent {'; '.join(objections)}; {hint}")


def _sloping(scene: Scene) -> str:
    return f"a slope of {scene.contact.slope:g} times its friction" if scene.contact.slope else ""


def _cut(scene: Scene) -> str:
    return "" if scene.mesh is None else "a mesh of its own outline"


def acted_on(scene: Scene) -> str:
    """The part beyond levels that take the wave as given."""
    return "a wave that the strain acts back on (StrainFeedback)" if scene.drive.has_state else ""


def turns_on_ground(scene: Scene) -> str:
    """A direction of friction fixed to the ground, where the sheet may turn on it."""
    law = scene.contact.friction
    if not law.follows_ground or (scene.drive.mirrored and law.mirrored):
        return ""
    return f"a direction of friction fixed to the ground below a sheet that may turn ({law.words})"


def map_on_ground(scene: Scene) -> str:
    """A map of friction on the ground, under which a motion does not repeat."""
    found = scene.contact.friction.map
    if found is None or found.fixed_to is FixedTo.BODY:
        return ""
    return "a map of friction fixed to the ground, over which the sheet moves on"


THEORY = Level(
    "linear_theory",
    lambda effect, scene: effect.beyond_theory(scene),
    (_sloping, _cut, acted_on, turns_on_ground, map_on_ground),
)
"""The theories of a flat rectangle that is not deformed by friction."""


def _on_plate(effect: Any, scene: Scene) -> str:
    judge = getattr(effect, "beyond_plate", effect.beyond_theory)
    return str(judge(scene))


def _groundless(scene: Scene) -> str:
    known: set[str] = set()
    for effect in scene.effects:
        known |= set(getattr(effect, "plate_numbers", {}))
    missing = [effect for name, effect in PLATE_NUMBERS.items() if name not in known]
    return f"a sheet without {' and '.join(missing)}" if missing and not scene.planar else ""


PLATE = Level(
    "crawl_speed(scene, order=2)",
    _on_plate,
    (_sloping, _cut, acted_on, turns_on_ground, map_on_ground, _groundless),
)
"""The theory of a plate in full contact with its ground, to second order in alpha and beta."""
