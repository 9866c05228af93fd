"""Loads on the sheet, on an edge or at a point."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.effect import Effect
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Entries
from linear_theory.common import validation
from linear_theory.common.pairs import outer
from linear_theory.common.shown import Value
from linear_theory.common.validation import shown
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]


@dataclass(frozen=True)
class DeadLoad(Value, Effect):
    """A dead load: a constant force per undeformed area, per length of an edge, or at a point.

    force: as many components as the scene has. Raises ValueError if they are not finite.
    """

    force: tuple[float, ...]
    entries: ClassVar[Entries] = (0,)

    def __post_init__(self) -> None:
        force = validation.real_array("force", self.force)
        if force.ndim != 1 or force.size not in (2, 3):
            raise ValueError(f"force has shape {force.shape}: must be (2,), or (3,) in space")

    @property
    def needs_space(self) -> bool:  # type: ignore[override]
        """Whether the force has a third component."""
        return len(self.force) == 3

    def _density(self, state: PointState) -> Array:
        return np.asarray(np.multiply.outer(np.array(self.force), state.measure))

    def energy(self, state: PointState) -> Array:
        """See Effect."""
        return -np.asarray((self._density(state) * state.position).sum(0))

    def gradient(self, state: PointState) -> Array:
        """See Effect."""
        return -self._density(state)[None]

    def hessian(self, state: PointState) -> None:
        """Vanishes."""

    def check_scene(self, scene: Scene) -> None:
        """See Effect."""
        self.check(scene.components, None)

    def beyond_cycle(self, scene: Scene) -> str:
        """Any dead load, against which nothing holds the sheet."""
        return type(self).__name__

    def check(self, components: int, step: Step | None) -> None:
        """Raise ValueError if the number of components differs from that of the scene."""
        if len(self.force) != components:
            raise ValueError(f"force has {len(self.force)} components: must have {components}")


@dataclass(frozen=True)
class EdgeMoment(Value, Effect):
    """A moment about the y axis on an edge, per undeformed length, that rotates x towards z.

    Its work is moment times the angle theta of the tangent a_entry, (cos theta, 0, sin theta): a
    conservative load that does not follow the sheet, equal to the true moment as long as the edge stays
    parallel to y, as in the roll-up of a strip. theta is measured within pi of `angle`: for more than
    half a turn choose a value near the expected angle. entry: 1 or 2, the derivative across the edge.
    """

    moment: float
    angle: float = 0.0
    entry: int = 1
    needs_space: ClassVar[bool] = True

    def __post_init__(self) -> None:
        validation.real("moment", self.moment)
        validation.real("angle", self.angle)
        if self.entry not in (1, 2):
            raise ValueError(f"entry = {shown(self.entry)}: must be 1 or 2")

    @property
    def entries(self) -> Entries:  # type: ignore[override]
        """The tangent across the edge."""
        return (self.entry,)

    def _tangent(self, state: PointState) -> tuple[Array, Array, Array]:
        x, _, z = state.tangent(self.entry)
        return x, z, x**2 + z**2

    def energy(self, state: PointState) -> Array:
        """See Effect."""
        x, z, _ = self._tangent(state)
        c, s = np.cos(self.angle), np.sin(self.angle)
        theta = self.angle + np.arctan2(c * z - s * x, c * x + s * z)
        return np.asarray(-self.moment * state.measure * theta)

    def gradient(self, state: PointState) -> Array:
        """See Effect."""
        x, z, square = self._tangent(state)
        scale = -self.moment * state.measure / square
        return np.stack([-scale * z, np.zeros_like(x), scale * x])[None]

    def hessian(self, state: PointState) -> Array:
        """See Effect."""
        x, z, square = self._tangent(state)
        scale = -self.moment * state.measure / square**2
        along, across = np.stack([x, 0 * x, z]), np.stack([-z, 0 * x, x])
        mixed = outer(along, across) + outer(across, along)
        return np.asarray(-scale * mixed)[None, None]

    def check(self, components: int, step: Step | None) -> None:
        """Raise ValueError in the plane, where the axis of rotation does not exist."""
        if components == 2:
            raise ValueError("loads: EdgeMoment must not be named in a planar scene (components = 2)")
