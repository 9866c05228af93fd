"""Weight."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.effect import Effect
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Entries
from linear_theory.common import validation
from linear_theory.common.shown import Value
from linear_theory.friction.load import Load
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]


def weighed(load: Load | str | None, area: Load | str | None) -> Load:
    """The load of an effect, GROWN by default; area: former name of the argument."""
    if load is not None and area is not None:
        raise ValueError(f"area = {validation.shown(area)}: must be None if load is given")
    return Load.named(next((said for said in (load, area) if said is not None), Load.GROWN))


def check_area(load: Load, step: Step | None) -> None:
    """Raise ValueError for a load per current area without a step that holds this area fixed."""
    if load is Load.CURRENT and (step is None or step.area is None):
        raise ValueError("load = 'current': must come with a step that holds the current area")


@dataclass(frozen=True, init=False)
class Gravity(Value, Effect):
    """The force -weight e_z per area, on level ground or on an incline.

    weight: the rho g of the paper (2.5e-4 E), a force per area > 0. load: the reference area, a `Load`
    or its name: "grown", "current" or "material"; area is its former name. incline: angle in radians by
    which the ground rises towards +y; the axes stay those of the ground, and the weight points along
    (0, -sin, -cos). In a planar scene on level ground it does no work and is only the normal load of
    friction. Raises ValueError for a weight <= 0 and for an incline outside (-pi/2, pi/2).
    """

    weight: float
    load: Load
    incline: float
    entries: ClassVar[Entries] = (0,)

    def __init__(
        self,
        weight: float,
        load: Load | str | None = None,
        incline: float = 0.0,
        area: Load | str | None = None,
    ) -> None:
        object.__setattr__(self, "weight", validation.positive("weight", weight))
        object.__setattr__(self, "load", weighed(load, area))
        if abs(validation.real("incline", incline)) >= np.pi / 2:
            raise ValueError(f"incline = {incline:g}: must be in (-pi/2, pi/2)")
        object.__setattr__(self, "incline", float(incline))

    @property
    def reads_rest(self) -> bool:  # type: ignore[override]
        """Whether the reference area is the grown area of a rest state."""
        return self.load is Load.GROWN

    def idle(self, components: int) -> bool:
        """True in the plane on level ground."""
        return components == 2 and self.incline == 0

    def pressed_by(self, components: int) -> Load | None:
        """The weight, in the plane; in space the ground presses."""
        return self.load if components == 2 else None

    def normal_load(self, state: PointState) -> Array:
        """Weight of each point normal to the ground, (points,): the normal load in a planar scene."""
        return np.asarray(np.cos(self.incline) * self._weight(state))

    def energy(self, state: PointState) -> Array:
        """See Effect."""
        up = self._up(state.components)
        return np.asarray(self._weight(state) * (up @ state.position))

    def gradient(self, state: PointState) -> Array:
        """See Effect."""
        return np.multiply.outer(self._up(state.components), self._weight(state))[None]

    def _weight(self, state: PointState) -> Array:
        return np.asarray(self.weight * state.area_of(self.load))

    def _up(self, components: int) -> Array:
        return np.array([0.0, np.sin(self.incline), np.cos(self.incline)])[:components]

    def hessian(self, state: PointState) -> None:
        """Vanishes."""

    def check_scene(self, scene: Scene) -> None:
        """Raise ValueError in space if there is no ground."""
        if scene.components == 3 and not any(e.pressed_by(3) for e in scene.effects):
            names = ", ".join(type(e).__name__ for e in scene.effects)
            raise ValueError(f"effects = {names}: Gravity must come with Ground, else the sheet falls")

    def check(self, components: int, step: Step | None) -> None:
        """See Effect."""
        check_area(self.load, step)

    def beyond_theory(self, scene: Scene) -> str:
        """Nothing in the plane on level ground, where it is the normal load of friction."""
        return "" if scene.planar and not self.incline else type(self).__name__

    def beyond_plate(self, scene: Scene) -> str:
        """An incline."""
        return f"Gravity(incline = {self.incline:g})" if self.incline else ""

    @property
    def plate_numbers(self) -> Mapping[str, float | Load]:
        """See Effect."""
        return {"weight": self.weight, "load": self.load}

    def beyond_cycle(self, scene: Scene) -> str:
        """An incline in space, or one without friction; current areas in space."""
        if self.incline and not scene.planar:
            return f"Gravity(incline = {self.incline:g}) of a sheet in space"
        if self.incline and not any(effect.law for effect in scene.effects):
            return f"Gravity(incline = {self.incline:g}) without Friction, which holds the sheet"
        if self.load is Load.CURRENT and not scene.planar:
            return "Gravity(load = 'current') of a sheet in space"
        return ""
