"""Schemes of time integration: the past of a run, and what they make of it.

A scheme gives velocity and acceleration at the end of a step as affine functions of the positions
there, a prediction of these, and the error of the velocity. Both schemes are of second order. Newmark's
keeps the energy of linear vibrations, also of those that the steps do not resolve: after a snap-through
the sheet rings on, and unresolved ringing can grow. Backward differences damp what is not resolved.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, field, replace
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.kinematics.extrapolation import extrapolated
from fem_check.shell.kinematics.rates import (
    NEWMARK_BETA,
    NEWMARK_GAMMA,
    Affine,
    backward_euler,
    newmark,
    two_step,
)
from linear_theory.common import validation
from linear_theory.common.shown import Value

Array = NDArray[np.float64]

SMALLEST_ERROR = 1 / 12
"""Of Newmark's rule: the error in x is |beta - 1/6| dt^2 (a_new - a), which is this for beta = 1/4."""


class Scheme(ABC):
    """A scheme; step: length of its steps in units of time, None if it follows from rtol or steps.

    known_error: whether `velocity_error` is the error itself, to first order, and not only its size.
    """

    step: float | None
    known_error: ClassVar[bool] = False

    @abstractmethod
    def rules(self, history: "History", dt: float) -> tuple[Affine, Affine | None]:
        """Velocity and (with inertia) acceleration of the unknowns at the end of a step."""

    @abstractmethod
    def slope(self, values: Array, times: Array, dt: float) -> Affine:
        """Velocity of other points at the end of a step, from their positions at the last times.

        values: (n, ...), the latest first. Raises ValueError for a scheme that needs more of them.
        """

    @abstractmethod
    def prediction(self, history: "History", dt: float) -> Array:
        """Unknowns (size,) after dt, extrapolated."""

    @abstractmethod
    def velocity_error(self, history: "History", state: Array, dt: float) -> Array:
        """Estimated error of the velocity (size,) at the end of a step that led to `state`."""


@dataclass(frozen=True)
class BackwardDifferences(Value, Scheme):
    """The slope of the parabola through the last three positions (BDF2), twice for accelerations.

    It damps vibrations with fewer than about 20 steps per period. step: length of equal steps, units of
    time; None: from rtol or steps of `simulate`. Raises ValueError for a step <= 0.

    >>> from fem_check import BackwardDifferences
    >>> print(BackwardDifferences() == BackwardDifferences(step=None))
    True
    """

    step: float | None = None
    known_error: ClassVar[bool] = True

    def __post_init__(self) -> None:
        object.__setattr__(self, "step", _step(self.step))

    def rules(self, history: "History", dt: float) -> tuple[Affine, Affine | None]:
        """See Scheme."""
        velocity = self.slope(history.states, history.times, dt)
        if history.velocities is None:
            return velocity, None
        # a = r (v - w) with v = q (x - b) is r q (x - (b + w/q)).
        second = self.slope(history.velocities, history.times, dt)
        base = velocity.base + second.base / velocity.rate
        return velocity, Affine(second.rate * velocity.rate, base)

    def slope(self, values: Array, times: Array, dt: float) -> Affine:
        """See Scheme."""
        if times.size == 1:
            return backward_euler(values[0], dt)
        return two_step(values[0], values[1], dt, times[0] - times[1])

    def prediction(self, history: "History", dt: float) -> Array:
        """See Scheme: on the parabola through the last positions."""
        return extrapolated(history.times, history.states, history.time + dt)

    def velocity_error(self, history: "History", state: Array, dt: float) -> Array:
        """See Scheme: v = x' + x''' dt (dt + d)/6, d the previous step.

        The third derivative follows from the deviation from the prediction; it is unknown, and 0 is
        returned, in the two short steps after a jump.
        """
        if history.times.size < 3:
            return np.zeros_like(state)
        # x - prediction = x'''/6 dt (dt + d) (dt + d + d'), d' the step before d
        return (state - self.prediction(history, dt)) / (history.time + dt - history.times[2])


@dataclass(frozen=True)
class Newmark(Value, Scheme):
    """Newmark's rule (appendix A.2: beta = 1/4, gamma = 1/2, step 5e-3), with Inertia only.

    beta > 0, gamma >= 1/2 (above, it damps, at first order). step: length of equal steps, units of
    time; None: from rtol or steps of `simulate`. Raises ValueError for values out of range.

    >>> from fem_check import Newmark
    >>> print(Newmark(step=5e-3))
    Newmark(beta=0.25, gamma=0.5, step=0.005)
    """

    beta: float = NEWMARK_BETA
    gamma: float = NEWMARK_GAMMA
    step: float | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "beta", validation.positive("beta", self.beta))
        object.__setattr__(self, "gamma", validation.real("gamma", self.gamma))
        if self.gamma < NEWMARK_GAMMA:
            raise ValueError(
                f"gamma = {self.gamma:g}: must be >= {NEWMARK_GAMMA:g}, else it is unstable"
            )
        object.__setattr__(self, "step", _step(self.step))

    def rules(self, history: "History", dt: float) -> tuple[Affine, Affine | None]:
        """See Scheme."""
        velocity, acceleration = history.moving
        return newmark(history.state, velocity, acceleration, dt, self.beta, self.gamma)

    def slope(self, values: Array, times: Array, dt: float) -> Affine:
        """See Scheme."""
        raise ValueError(f"scheme = {self!r}: must be BackwardDifferences for other points")

    def prediction(self, history: "History", dt: float) -> Array:
        """See Scheme: with constant acceleration."""
        velocity, acceleration = history.moving
        return np.asarray(history.state + dt * velocity + dt**2 / 2 * acceleration)

    def velocity_error(self, history: "History", state: Array, dt: float) -> Array:
        """See Scheme: the error of the position over the step."""
        _, rule = self.rules(history, dt)
        assert rule is not None
        share = max(abs(self.beta - 1 / 6), SMALLEST_ERROR)
        return share * dt * (rule(state) - history.moving[1])


@dataclass(frozen=True, eq=False)
class History:
    """States at the last times, the latest first; before the start the sheet is at rest.

    times (n,); states (n, size): unknowns, of the last n <= 3 steps since a jump. velocities (n, size),
    acceleration (size,) at the latest time: of the unknowns, None without inertia.
    """

    times: Array
    states: Array
    velocities: Array | None = None
    acceleration: Array | None = None
    scheme: Scheme = field(default_factory=BackwardDifferences)

    @classmethod
    def at_rest(cls, state: Array, dt: float, scheme: Scheme | None = None) -> "History":
        """The history of a sheet at rest during the steps of length dt before time 0."""
        scheme = BackwardDifferences() if scheme is None else scheme
        return cls(0.0 - dt * np.arange(3.0), np.tile(state, (3, 1)), scheme=scheme)

    def thrown(self, velocity: Array, acceleration: Array) -> "History":
        """The same with that velocity and acceleration (size,) at the start, constant before it."""
        past = self.times[:, None] - self.time
        states = self.state + past * velocity + past**2 / 2 * acceleration
        return replace(
            self, states=states, velocities=velocity + past * acceleration, acceleration=acceleration
        )

    @property
    def time(self) -> float:
        """The latest time."""
        return float(self.times[0])

    @property
    def state(self) -> Array:
        """The latest state, (size,)."""
        return np.asarray(self.states[0])

    @property
    def velocity(self) -> Array | None:
        """The latest velocity, (size,); None without inertia."""
        return None if self.velocities is None else np.asarray(self.velocities[0])

    @property
    def moving(self) -> tuple[Array, Array]:
        """Velocity and acceleration, of a sheet with inertia."""
        assert self.velocities is not None
        assert self.acceleration is not None
        return np.asarray(self.velocities[0]), self.acceleration

    def prediction(self, dt: float) -> Array:
        """Predicted state after dt."""
        return self.scheme.prediction(self, dt)

    def rules(self, dt: float) -> tuple[Affine, Affine | None]:
        """Velocity and (with inertia) acceleration of the unknowns at the end of a step, as rules."""
        return self.scheme.rules(self, dt)

    def slope(self, values: Array, dt: float) -> Affine:
        """Velocity of other points at the end of a step, see Scheme."""
        return self.scheme.slope(values, self.times[: len(values)], dt)

    def velocity_error(self, state: Array, dt: float) -> Array:
        """Estimated error of the velocity (size,) at the end of a step that led to `state`."""
        return self.scheme.velocity_error(self, state, dt)

    def advanced(self, state: Array, dt: float, jumped: bool = False) -> "History":
        """The history one step later; a sheet without inertia that has jumped starts anew, at rest."""
        velocity, acceleration = self.rules(dt)
        kept = 0 if jumped and acceleration is None else 2
        after = replace(
            self,
            times=np.array([self.time + dt, *self.times[:kept]]),
            states=np.stack([state, *self.states[:kept]]),
        )
        if acceleration is None or self.velocities is None:
            return after
        velocities = np.stack([velocity(state), *self.velocities[:kept]])
        return replace(after, velocities=velocities, acceleration=acceleration(state))


def _step(step: float | None) -> float | None:
    return None if step is None else validation.positive("step", step)
