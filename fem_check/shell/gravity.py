"""Weight."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effect import Effect
from fem_check.shell.point_state import AREAS, PointState
from fem_check.shell.rates import Step
from fem_check.shell.region import Entries
from linear_theory import validation

Array = NDArray[np.float64]


def check_area(area: str, step: Step | None) -> None:
    """Raise ValueError where loads per current area are asked for and no area is held fixed."""
    if area == "current" and (step is None or step.area is None):
        raise ValueError("area = 'current': must come with a step that holds the current area")


@dataclass(frozen=True)
class Gravity:
    """The force -weight e_z per area.

    weight: the rho g of the paper (2.5e-4 E), a force per area > 0. area: "grown", "current" or
    "material", see `AREAS`. In a planar scene it does no work and is only the load that friction is
    proportional to.
    """

    weight: float
    area: str = "grown"
    entries: Entries = (0,)

    def __post_init__(self) -> None:
        validation.positive("weight", self.weight)
        validation.choice("area", self.area, AREAS)

    @property
    def reads_rest(self) -> bool:
        """Only the grown area belongs to a rest state."""
        return self.area == "grown"

    def normal_load(self, state: PointState) -> Array:
        """Weight of each point, (points,): what lies on the ground in a planar scene."""
        return np.asarray(self.weight * state.area_of(self.area))

    def energy(self, state: PointState) -> Array:
        """See Effect."""
        return np.asarray(self.normal_load(state) * state.position[2])

    def gradient(self, state: PointState) -> Array:
        """See Effect."""
        out = np.zeros((1, 3, state.measure.size))
        out[0, 2] = self.normal_load(state)
        return out

    def hessian(self, state: PointState) -> None:
        """Vanishes."""

    def check(self, components: int, effects: Sequence[Effect], step: Step | None) -> None:
        """See Effect."""
        check_area(self.area, step)
