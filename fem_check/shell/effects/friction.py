"""Friction with the ground as the potential of one time step."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.effect import Effect, identity, outer
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.kinematics.point_state import PointState, dot
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Entries
from linear_theory.common import validation
from linear_theory.common.shown import Value
from linear_theory.friction.laws import FrictionLaw, Tanh
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]


def log_cosh(s: Array) -> Array:
    """log cosh s for s >= 0, to full accuracy: about s^2/2 near 0, s - log 2 far away."""
    near = np.log1p(2 * np.sinh(np.minimum(s, 1) / 2) ** 2)
    return np.asarray(np.where(s < 1, near, s + np.log1p(np.exp(-2 * s)) - np.log(2)))


def tanh_ratio(s: Array) -> Array:
    """tanh(s)/s for s >= 0, 1 at 0."""
    safe = np.maximum(s, 1e-4)
    return np.asarray(np.where(s < 1e-4, 1 - np.minimum(s, 1) ** 2 / 3, np.tanh(safe) / safe))


def sech_squared(s: Array) -> Array:
    """1/cosh(s)^2 for s >= 0, without overflow."""
    decay = np.exp(-2 * s)
    return np.asarray(4 * decay / (1 + decay) ** 2)


WEAK = 0.1
"""Largest strain by friction over that by growth at which a shape counts as not affected by friction.
Dry speeds of the paper's sheet by `simulate` (a sine and a pulse, two loads, alpha = 0.05 and 0.25)
then are within 1.5 % of a cycle's, at a tenth of it within 0.2 %, at three times as much within 8 %."""


def friction_over_growth(scene: Scene) -> float:
    """Strain by friction, mu (weight per area) L/(E h), over that by growth, |alpha|.

    0 without friction, infinite where alpha = 0.
    """
    friction, gravity = scene.find(Friction), scene.find(Gravity)
    if friction is None or gravity is None:
        return 0.0
    material = scene.find(Membrane).material
    strain = friction.coefficient * gravity.weight * scene.sheet.length
    strain /= material.young * material.thickness
    return float(strain / abs(scene.alpha)) if scene.alpha else np.inf


@dataclass(frozen=True)
class Friction(Value, Effect):
    """The force -mu N tanh(|v|/v0) v/|v| of eq. 3, whose potential is mu N v0 log cosh(|v|/v0).

    coefficient: mu > 0. slip_speed: v0 > 0, length per time; small against the speeds it is dry
    friction (the potential tends to mu N |v|), large against them viscous. v is the velocity along
    the ground at the end of the step, an affine function of the position, and N the load that the
    step holds fixed. Raises ValueError for values out of range.
    """

    coefficient: float
    slip_speed: float
    entries: ClassVar[Entries] = (0,)
    is_static: ClassVar[bool] = False
    moves: ClassVar[bool] = True
    stored_as: ClassVar[None] = None

    def __post_init__(self) -> None:
        validation.positive("coefficient", self.coefficient)
        validation.positive("slip_speed", self.slip_speed)

    @property
    def law(self) -> FrictionLaw:  # type: ignore[override]
        """See Effect."""
        return Tanh(self.slip_speed)

    @property
    def mu(self) -> float:  # type: ignore[override]
        """See Effect."""
        return self.coefficient

    def velocity(self, state: PointState) -> Array:
        """Velocity along the ground, (components, points)."""
        assert state.step is not None
        assert state.step.velocity is not None
        velocity = state.step.velocity(state.position)
        normal = state.step.normal
        if normal is not None:
            return np.asarray(velocity - normal * dot(normal, velocity))
        if state.components == 3:
            velocity[2] = 0
        return velocity

    def force(self, state: PointState) -> Array:
        """Force of the ground on each point, (components, points)."""
        velocity = self.velocity(state)
        ratio = tanh_ratio(self._speed(velocity) / self.slip_speed)
        return np.asarray(-self._limit(state) * ratio / self.slip_speed * velocity)

    def energy(self, state: PointState) -> Array:
        """See Effect. Time step times dissipation potential."""
        assert state.step is not None
        assert state.step.velocity is not None
        speed = self._speed(self.velocity(state))
        scale = self._limit(state) * self.slip_speed / state.step.velocity.rate
        return np.asarray(scale * log_cosh(speed / self.slip_speed))

    def gradient(self, state: PointState) -> Array:
        """See Effect."""
        return -self.force(state)[None]

    def hessian(self, state: PointState) -> Array:
        """See Effect."""
        assert state.step is not None
        assert state.step.velocity is not None
        velocity = self.velocity(state)
        speed = self._speed(velocity)
        s = speed / self.slip_speed
        across, along = tanh_ratio(s), sech_squared(s)
        direction = velocity / np.where(speed > 0, speed, 1)
        scale = self._limit(state) * state.step.velocity.rate / self.slip_speed
        tangent = scale * across * self._projection(state)
        return np.asarray(tangent + scale * (along - across) * outer(direction, direction))[None, None]

    def _projection(self, state: PointState) -> Array:
        """Identity minus normal times normal, (pairs, points or 1)."""
        unit = identity(state.components)
        assert state.step is not None
        if state.step.normal is not None:
            return np.asarray(unit - outer(state.step.normal, state.step.normal))
        if state.components == 3:
            unit[-1] = 0
        return unit

    def _limit(self, state: PointState) -> Array:
        """mu N, (points,)."""
        assert state.step is not None
        assert state.step.load is not None
        return np.asarray(self.coefficient * state.step.load)

    def _speed(self, velocity: Array) -> Array:
        return np.sqrt(dot(velocity, velocity))

    def check_scene(self, scene: Scene) -> None:
        """Raise ValueError for friction without load."""
        if not any(effect.pressed_by(scene.components) for effect in scene.effects):
            kind, where = ("Gravity", "in the plane") if scene.planar else ("Ground", "in space")
            raise ValueError(f"effects: Friction must come with {kind}, its load {where}")

    def beyond_theory(self, scene: Scene) -> str:
        """Friction so strong that it deforms the sheet."""
        return self.beyond_cycle(scene)

    def beyond_cycle(self, scene: Scene) -> str:
        """Friction so strong that it deforms the sheet."""
        ratio = friction_over_growth(scene)
        if ratio <= WEAK or scene.alpha == 0:
            return ""
        return (
            f"Friction that deforms the sheet: mu weight L/(E h |alpha|) = {ratio:.3g}, must be <= "
            f"{WEAK:g}"
        )

    def check(self, components: int, step: Step | None) -> None:
        """Raise ValueError without a time step."""
        if step is None or step.velocity is None or step.load is None:
            raise ValueError(
                "step: Friction needs one with a velocity and a load; it has no static form"
            )
