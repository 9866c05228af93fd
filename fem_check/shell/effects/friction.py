"""Friction with the ground as the potential of one time step."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.effect import Effect, identity, outer
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.kinematics.point_state import PointState, dot
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Entries
from linear_theory.common import validation
from linear_theory.common.shown import Value

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


def load_bearer(components: int, effects: Sequence[Effect]) -> Ground | Gravity:
    """The effect that presses the sheet on the ground: Ground in space, Gravity in the plane.

    Raises ValueError if the scene does not name it: friction without load.
    """
    kind = Ground if components == 3 else Gravity
    for effect in effects:
        if isinstance(effect, kind):
            return effect
    where = "in space" if components == 3 else "in the plane"
    raise ValueError(f"effects: Friction must come with {kind.__name__}, its load {where}")


@dataclass(frozen=True)
class Friction(Value):
    """The force -mu N tanh(|v|/v0) v/|v| of eq. 3, whose potential is mu N v0 log cosh(|v|/v0).

    coefficient: mu > 0. slip_speed: v0 > 0, length per time; small against the speeds it is dry
    friction (the potential tends to mu N |v|), large against them viscous. v is the velocity along
    the ground at the end of the step, an affine function of the position, and N the load that the
    step holds fixed. Raises ValueError for values out of range.
    """

    coefficient: float
    slip_speed: float
    entries: ClassVar[Entries] = (0,)
    reads_rest: ClassVar[bool] = False

    def __post_init__(self) -> None:
        validation.positive("coefficient", self.coefficient)
        validation.positive("slip_speed", self.slip_speed)

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

    def check(self, components: int, effects: Sequence[Effect], step: Step | None) -> None:
        """Raise ValueError for friction without load or without a time step."""
        load_bearer(components, effects)
        if step is None or step.velocity is None or step.load is None:
            raise ValueError(
                "step: Friction needs one with a velocity and a load; it has no static form"
            )
