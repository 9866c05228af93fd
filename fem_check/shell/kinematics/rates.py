"""Velocity and acceleration as affine functions of the position at the end of a time step.

A time step formulated as a minimisation requires only this of an integrator: v = rate (x - base).
"""

from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.shown import Shown

Array = NDArray[np.float64]
T = TypeVar("T")

NEWMARK_BETA = 0.25
NEWMARK_GAMMA = 0.5


@dataclass(frozen=True, eq=False)
class Affine(Shown):
    """rate (x - base): rate in 1/time (1/time^2 for an acceleration), base (components, points)."""

    rate: float
    base: Array

    def __call__(self, x: Array) -> Array:
        """Velocity or acceleration at positions x, (components, points)."""
        return np.asarray(self.rate * (x - self.base))

    def part(self, points: slice) -> "Affine":
        """The same for a slice of the points."""
        return Affine(self.rate, self.base[..., points])


@dataclass(frozen=True, eq=False)
class Face(Shown):
    """The face of the sheet on which friction acts, the points x - depth n with the unit normal n.

    depth: below the mid-surface, units of length; velocity: of these points as a function of their
    position, as for `Step.velocity`.
    """

    depth: float
    velocity: Affine

    def part(self, points: slice) -> "Face":
        """The same for a slice of the points."""
        return Face(self.depth, self.velocity.part(points))


@dataclass(frozen=True, eq=False)
class Step(Shown):
    """Quantities held fixed during a minimisation: the time step, and lagged load, area and normals.

    velocity: of the points as a function of position; None in statics. acceleration: likewise, None
    without inertia. load (points,): normal force at each point (pressure times area), to which friction
    is proportional. area (points,): quadrature weight times current area, for "current" loads.
    normal (3, points): unit normal of the ground under each point, None if it is e_z. anchor
    (components, points): places before the step, None unless a `Restraint` holds the sheet to them.
    heading: of the sheet as a whole, anticlockwise, radians, for friction whose axes turn with it.
    face: on which friction acts, None for the mid-surface.

    load, area, normal and heading are those of the last state, since as functions of the position they
    would not have a potential. The minimisation is repeated until they no longer change.
    """

    velocity: Affine | None = None
    acceleration: Affine | None = None
    load: Array | None = None
    area: Array | None = None
    normal: Array | None = None
    anchor: Array | None = None
    heading: float = 0.0
    face: Face | None = None

    @property
    def moving(self) -> Affine:
        """The rule of the velocity. Raises ValueError in statics."""
        return _held(self.velocity, "velocity")

    @property
    def accelerated(self) -> Affine:
        """The rule of the acceleration. Raises ValueError without inertia."""
        return _held(self.acceleration, "acceleration")

    @property
    def pressed(self) -> Array:
        """The load. Raises ValueError where none is held fixed."""
        return _held(self.load, "load")

    @property
    def counted(self) -> Array:
        """The current area. Raises ValueError where none is held fixed."""
        return _held(self.area, "area")

    @property
    def touching(self) -> Face:
        """The face of friction. Raises ValueError where that is the mid-surface."""
        return _held(self.face, "face")

    @property
    def anchored(self) -> Array:
        """The places before the step. Raises ValueError where none are held fixed."""
        return _held(self.anchor, "anchor")

    def part(self, points: slice) -> "Step":
        """The same for a slice of the points."""
        held = (self.load, self.area, self.normal, self.anchor)
        load, area, normal, anchor = (None if a is None else a[..., points] for a in held)
        velocity, acceleration = (
            None if r is None else r.part(points) for r in (self.velocity, self.acceleration)
        )
        face = None if self.face is None else self.face.part(points)
        return Step(velocity, acceleration, load, area, normal, anchor, self.heading, face)


def _held(value: T | None, name: str) -> T:
    if value is None:
        raise ValueError(f"step.{name} = None: must be given for an effect that reads it")
    return value


def backward_euler(x: Array, dt: float) -> Affine:
    """v = (x_new - x)/dt, first order in dt; x (components, points) at the start of the step."""
    return Affine(1 / validation.positive("dt", dt), x)


def two_step(x: Array, before: Array, dt: float, dt_before: float | None = None) -> Affine:
    """v at the end of a step from three positions, second order in dt (BDF2).

    x, before: positions at the start of the step and dt_before (by default dt) earlier. v is the slope
    of the parabola through the positions; for equal steps (3 x_new - 4 x + x_before)/(2 dt).
    """
    dt = validation.positive("dt", dt)
    ratio = 1.0 if dt_before is None else dt / validation.positive("dt_before", dt_before)
    rate = (1 + 2 * ratio) / ((1 + ratio) * dt)
    return Affine(rate, ((1 + ratio) ** 2 * x - ratio**2 * before) / (1 + 2 * ratio))


def newmark(
    x: Array, v: Array, a: Array, dt: float, beta: float = NEWMARK_BETA, gamma: float = NEWMARK_GAMMA
) -> tuple[Affine, Affine]:
    """Velocity and acceleration of Newmark's rule, by default those of appendix A.2.

    x, v, a: (components, points) at the start of the step.
    """
    dt = validation.positive("dt", dt)
    guess = x + dt * v + dt**2 * (0.5 - beta) * a
    acceleration = Affine(1 / (beta * dt**2), guess)
    # v_new = v + dt ((1 - gamma) a + gamma a_new), written as rate (x_new - base).
    rate = gamma / (beta * dt)
    return Affine(rate, guess - (v + dt * (1 - gamma) * a) / rate), acceleration
