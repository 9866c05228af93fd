"""What the finite-element levels can represent, see `linear_theory.scene.level`."""

from collections.abc import Collection, Mapping

from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Bending
from linear_theory.scene.level import PLATE, THEORY, Level, acted_on, map_on_ground, turns_on_ground
from linear_theory.scene.scene import Scene


def _of_a_cycle(effect: object, scene: Scene) -> str:
    return effect.beyond_cycle(scene) if isinstance(effect, Effect) else type(effect).__name__


def _of_a_step(effect: object, scene: Scene) -> str:
    """No objection: time stepping represents every effect in every form."""
    return "" if isinstance(effect, Effect) else type(effect).__name__


def _moves_in_time(scene: Scene) -> str:
    if not any(effect.moves for effect in scene.effects):
        return "a scene without Friction and Inertia, which has no motion in time"
    return ""


def _map_on_slope(scene: Scene) -> str:
    sloping = scene.contact.friction.map is not None and scene.contact.slope
    return "a map of friction on a slope" if sloping else ""


def _rests_otherwise(scene: Scene) -> str:
    if scene.states_contact and not any(effect.law for effect in scene.effects):
        return "a contact that is not given by the effects Friction and Gravity or Ground"
    return ""


CYCLE = Level(
    "cycle_speed(scene)", _of_a_cycle, (acted_on, turns_on_ground, map_on_ground, _map_on_slope)
)

STEPPED = Level("simulate(scene)", _of_a_step, (_moves_in_time, _rests_otherwise))

LEVELS = (THEORY, PLATE, CYCLE, STEPPED)

WORDS: Mapping[type, str] = {
    Bending: "bending and buckling (hence the thickness)",
    Ground: "the ground",
    Gravity: "weight, except as the normal load of friction",
    Friction: "deformation by friction",
    Inertia: "inertia",
}
"""Effects besides stretching, in words for people. SelfContact is not among them: a sheet that needs it
passes through itself, which the answer says."""


def left_out(named: Collection[type]) -> tuple[str, ...]:
    """Effects, in words, that are neglected by an answer with effects of the classes `named` alone."""
    return tuple(words for kind, words in WORDS.items() if kind not in named)
