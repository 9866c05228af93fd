"""A spring from every point to its place at the start of a step: damping without which a snap jumps."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.effect import Effect
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Entries
from linear_theory.common import validation
from linear_theory.common.pairs import identity
from linear_theory.common.shown import Value

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Restraint(Value, Effect):
    """stiffness/2 |x - x0|^2 per undeformed area, x0 (`Step.anchor`) the place before the step.

    Over a step of length dt it is the drag of a fluid of viscosity stiffness times dt per area. With it
    every step has a solution near its start, if it is stiff enough. The stepper adds it, no scene does.
    stiffness: > 0, force per length^3.
    """

    stiffness: float
    entries: ClassVar[Entries] = (0,)
    is_static: ClassVar[bool] = False
    stored_as: ClassVar[None] = None

    def __post_init__(self) -> None:
        validation.positive("stiffness", self.stiffness)

    def _force(self, state: PointState) -> Array:
        away = state.position - state.step.anchored
        return np.asarray(self.stiffness * state.measure * away)

    def energy(self, state: PointState) -> Array:
        """See Effect."""
        away = state.position - state.step.anchored
        return np.asarray((self._force(state) * away).sum(0) / 2)

    def gradient(self, state: PointState) -> Array:
        """See Effect."""
        return self._force(state)[None]

    def hessian(self, state: PointState) -> Array:
        """See Effect."""
        return np.asarray(self.stiffness * state.measure * identity(state.components))[None, None]

    def check(self, components: int, step: Step | None) -> None:
        """Raise ValueError for a step without an anchor."""
        if step is None or step.anchor is None:
            raise ValueError("step: must have an anchor for Restraint")
