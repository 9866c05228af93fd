"""What parts of a scene require of each other."""

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from linear_theory.scene.scene import Scene


def check_parts(scene: "Scene") -> None:
    """Raise ValueError for parts that contradict each other, or lack what they require."""
    if scene.effects:
        _check_stretching(scene)
    # Those that put the sheet into space first: what the others need there depends on them.
    for effect in sorted(scene.effects, key=lambda effect: not effect.needs_space):
        effect.check_scene(scene)
    _check_bending(scene)
    if scene.contact.friction.map is not None:
        x, y = np.linspace(-0.5, 0.5, 9)[:, None], np.linspace(-0.5, 0.5, 33)
        x, y = scene.sheet.width * x, scene.sheet.length * y
        scene.contact.friction.map.values(x, y)
        scene.contact.friction.map.check_period(scene.period, x, y)


def _check_stretching(scene: "Scene") -> None:
    """Growth has a rest state, and an effect resists it."""
    scene.growth.law.check(scene.alpha, scene.extremes)
    if not any(effect.stretches for effect in scene.effects):
        names = ", ".join(type(effect).__name__ for effect in scene.effects)
        raise ValueError(
            f"effects = {names}: must name Membrane, else the sheet has no in-plane stiffness"
        )


def _check_bending(scene: "Scene") -> None:
    """Nothing depends on bending in a sheet that stays flat."""
    if any(effect.bends for effect in scene.effects):
        return
    if scene.contact.friction.on_lower_face:
        raise ValueError(
            f"friction = {scene.contact.friction!r}: must be on the mid-surface without the effect "
            "Bending, since both faces of a sheet that stays flat slip alike"
        )
    if scene.curvature_coupling:
        raise ValueError(
            f"curvature_coupling = {scene.curvature_coupling:g}: must be 0 without the effect "
            "Bending, the only one that depends on a rest curvature"
        )
