"""How a sheet meets the ground in a cycle of shapes: load, law of friction and slope, from the scene.

The scene says it once. Arguments fill in what it leaves open: the load of a planar scene without
Gravity, the law of one without Friction. Where both speak they must agree.
"""

import math
from dataclasses import dataclass

from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.scene.scene import Scene
from linear_theory.common import validation
from linear_theory.friction.law import LOADS, FrictionLaw

ON_GROUND = "ground"
"""Load by the reaction of the ground."""


@dataclass(frozen=True)
class Contact:
    """load: "current", "grown", "material" or "ground", see `cycle_speed`. law: of friction. slope:
    force of the weight down the slope (towards -y) over mu times its load, tan(incline)/mu."""

    load: str
    law: FrictionLaw
    slope: float = 0.0

    @classmethod
    def of(
        cls,
        scene: Scene,
        load: str | None = None,
        friction: str | None = None,
        slip_speed: float | None = None,
    ) -> "Contact":
        """Of a scene, with None for what it says itself.

        Raises ValueError for names that do not exist, for a load or law that is not the scene's, and
        for a slope on which friction cannot hold the sheet.
        """
        return cls(_load(scene, load), _law(scene, friction, slip_speed), _slope(scene))

    @property
    def creep(self) -> float:
        """Speed at which a sheet that does not grow slides, length/time, towards +y."""
        if self.slope == 0:
            return 0.0
        return -self.law.width * math.atanh(self.slope)


def _load(scene: Scene, load: str | None) -> str:
    named = _named_load(scene)
    if load is None:
        return named or "current"
    if validation.choice("load", load, (*LOADS, ON_GROUND)) == ON_GROUND and named != ON_GROUND:
        raise ValueError("load = 'ground': the scene must name the effect Ground")
    if named is not None and load != named:
        by = "Ground" if named == ON_GROUND else f"Gravity(area = {named!r})"
        raise ValueError(f"load = {load!r}: must be None or {named!r}, as the scene names {by}")
    return load


def _named_load(scene: Scene) -> str | None:
    """What the scene says of the load; None if nothing."""
    if scene.find(Ground) is not None:
        return ON_GROUND
    gravity: Gravity | None = scene.find(Gravity)
    return None if gravity is None else gravity.area


def _law(scene: Scene, friction: str | None, slip_speed: float | None) -> FrictionLaw:
    named: Friction | None = scene.find(Friction)
    if named is None:
        return FrictionLaw("coulomb" if friction is None else friction, slip_speed)
    own = FrictionLaw("tanh", named.slip_speed)
    if friction is None and slip_speed is None:
        return own
    asked = FrictionLaw("tanh" if friction is None else friction, slip_speed)
    if asked != own:
        raise ValueError(
            f"friction = {asked.name!r}, slip_speed = {asked.slip_speed}: must be None or those of the "
            f"scene, which names Friction with slip_speed = {named.slip_speed:g}"
        )
    return own


def _slope(scene: Scene) -> float:
    gravity, friction = scene.find(Gravity), scene.find(Friction)
    if gravity is None or friction is None or gravity.incline == 0:
        return 0.0
    slope = math.tan(gravity.incline) / friction.coefficient
    if abs(slope) >= 1:
        raise ValueError(
            f"incline = {gravity.incline:g}: the sheet slides down without end, must be within "
            f"+-{math.atan(friction.coefficient):.4g} (its tangent below mu = {friction.coefficient:g})"
        )
    return slope
