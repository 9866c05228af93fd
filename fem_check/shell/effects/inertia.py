"""Inertia as the potential of one time step."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.effect import Effect
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rates import Affine, Step
from fem_check.shell.kinematics.region import Entries
from fem_check.shell.material import Material, check_materials
from linear_theory.common import validation
from linear_theory.common.pairs import identity
from linear_theory.common.shown import Value
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Inertia(Value, Effect):
    """Mass h rho per undeformed area times the acceleration by Newmark's rule (eq. 16).

    With the acceleration rate (x - base) at the end of the step, the potential is
    h rho rate |x - base|^2/2. density: rho > 0, mass per volume; no default, as the paper gives none.
    """

    density: float
    material: Material
    entries: ClassVar[Entries] = (0,)
    is_static: ClassVar[bool] = False
    moves: ClassVar[bool] = True
    stored_as: ClassVar[None] = None

    def __post_init__(self) -> None:
        validation.positive("density", self.density)
        validation.instance("material", self.material, Material)

    @property
    def areal_mass(self) -> float:  # type: ignore[override]
        """h rho."""
        return self.density * self.material.thickness

    def _mass(self, state: PointState) -> Array:
        return np.asarray(self.areal_mass * state.measure)

    def _acceleration(self, state: PointState) -> Affine:
        return state.step.accelerated

    def energy(self, state: PointState) -> Array:
        """See Effect."""
        rule = self._acceleration(state)
        away = state.position - rule.base
        return np.asarray(rule.rate / 2 * self._mass(state) * (away**2).sum(0))

    def gradient(self, state: PointState) -> Array:
        """See Effect."""
        return np.asarray(self._mass(state) * self._acceleration(state)(state.position))[None]

    def hessian(self, state: PointState) -> Array:
        """See Effect."""
        scale = self._mass(state) * self._acceleration(state).rate
        return np.asarray(scale * identity(state.components))[None, None]

    def check_scene(self, scene: Scene) -> None:
        """See Effect."""
        check_materials(scene)

    def check(self, components: int, step: Step | None) -> None:
        """Raise ValueError for a step without an acceleration."""
        if step is None or step.acceleration is None:
            raise ValueError("step: must have an acceleration for Inertia, which has no static form")
