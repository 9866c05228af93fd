"""Weight."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.effect import Effect
from fem_check.shell.kinematics.point_state import AREAS, PointState
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Entries
from linear_theory.common import validation
from linear_theory.common.shown import Value

Array = NDArray[np.float64]


def check_area(area: str, step: Step | None) -> None:
    """Raise ValueError where loads per current area are asked for and no area is held fixed."""
    if area == "current" and (step is None or step.area is None):
        raise ValueError("area = 'current': must come with a step that holds the current area")


@dataclass(frozen=True)
class Gravity(Value):
    """The force -weight e_z per area, on level ground or on an incline.

    weight: the rho g of the paper (2.5e-4 E), a force per area > 0. area: "grown", "current" or
    "material", see `AREAS`. incline: angle in radians by which the ground rises towards +y; the axes
    stay those of the ground, and the weight points along (0, -sin, -cos). In a planar scene on level
    ground it does no work and is only the load that friction is proportional to. Raises ValueError
    for a weight <= 0 and for an incline that is not within a right angle.
    """

    weight: float
    area: str = "grown"
    incline: float = 0.0
    entries: ClassVar[Entries] = (0,)

    def __post_init__(self) -> None:
        validation.positive("weight", self.weight)
        validation.choice("area", self.area, AREAS)
        if abs(validation.real("incline", self.incline)) >= np.pi / 2:
            raise ValueError(f"incline = {self.incline:g}: must be in (-pi/2, pi/2)")

    @property
    def reads_rest(self) -> bool:
        """Only the grown area belongs to a rest state."""
        return self.area == "grown"

    @property
    def works_in_plane(self) -> bool:
        """Whether a motion along the ground gains or costs energy."""
        return self.incline != 0

    def normal_load(self, state: PointState) -> Array:
        """Weight of each point across the ground, (points,): its load in a planar scene."""
        return np.asarray(np.cos(self.incline) * self._weight(state))

    def energy(self, state: PointState) -> Array:
        """See Effect."""
        up = self._up(state.components)
        return np.asarray(self._weight(state) * (up @ state.position))

    def gradient(self, state: PointState) -> Array:
        """See Effect."""
        return np.multiply.outer(self._up(state.components), self._weight(state))[None]

    def _weight(self, state: PointState) -> Array:
        return np.asarray(self.weight * state.area_of(self.area))

    def _up(self, components: int) -> Array:
        return np.array([0.0, np.sin(self.incline), np.cos(self.incline)])[:components]

    def hessian(self, state: PointState) -> None:
        """Vanishes."""

    def check(self, components: int, effects: Sequence[Effect], step: Step | None) -> None:
        """See Effect."""
        check_area(self.area, step)
