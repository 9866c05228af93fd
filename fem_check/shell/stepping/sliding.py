"""How the sheet slides at one time, and by how much its speed would change with step and slip speed.

A rigid velocity w that is added to the velocities v of the points must leave the forces of friction
in balance: sum f(v + w) = const. Linearised, that turns a change dv of the velocities of a sheet whose
shape friction does not change into a change of its speed.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.friction import Friction
from fem_check.shell.kinematics.point_state import PointState
from linear_theory.friction.isotropic import norm
from linear_theory.friction.law import FrictionLaw

Array = NDArray[np.float64]

COMPARED = 0.5
"""Slip speed, relative to that of the scene, whose speed is computed for comparison."""

MOST_CORRECTIONS = 30


class Sliding(NamedTuple):
    """At one time. fastest: largest speed along the ground. linear: share of the load that moves slower
    than the slip speed. step, slip (2,): change of the velocity of the sheet along the ground if the
    velocities were exact in time, and if the slip speed were `COMPARED` times its value (NaN for a law
    that does not stand for dry friction)."""

    fastest: float
    linear: float
    step: Array
    slip: Array


def sliding(friction: Friction, state: PointState, error: Array, measure: Array) -> Sliding:
    """error: estimated (exact - computed) velocity of the entries, (entries, components, points)."""
    velocity, load = friction.slip(state), state.step.pressed
    speed, law = norm(velocity), friction.law
    total = load.sum()
    share = load[speed < law.width].sum() / total if total > 0 else 0.0
    tangent = friction.stiffness(state) / state.step.moving.rate
    pairs = tangent[[0, 1, 3]] if state.components == 3 else tangent
    # Of a velocity error the mean over the sheet is seen directly, and the rest through friction.
    step = rigid(pairs, friction.moved(state, error)[:2]) + error[0, :2] @ measure / measure.sum()
    slip = turned(_slip_change(law, velocity, load), state.step.heading)
    return Sliding(float(speed.max()), float(share), step, slip)


def rigid(tangent: Array, change: Array) -> Array:
    """w (2,) with sum K (change + w) = 0 for K = (xx, xy, yy) at the points (change: (2, points))."""
    xx, xy, yy = tangent
    force = np.array([xx @ change[0] + xy @ change[1], xy @ change[0] + yy @ change[1]])
    return -_solve(tangent, force)


def turned(vector: Array, angle: float) -> Array:
    """A vector (2, ...) turned anticlockwise."""
    cosine, sine, (x, y) = np.cos(angle), np.sin(angle), vector
    return np.stack([cosine * x - sine * y, sine * x + cosine * y])


def _solve(tangent: Array, force: Array) -> Array:
    xx, xy, yy = tangent.sum(1)
    determinant = xx * yy - xy**2
    if not determinant > 0:
        return np.zeros(2)
    return np.array([yy * force[0] - xy * force[1], xx * force[1] - xy * force[0]]) / determinant


def _slip_change(law: FrictionLaw, velocity: Array, load: Array) -> Array:
    """w (2,) that keeps the sum of forces when the width of the law is multiplied by `COMPARED`.

    Newton's steps where they reduce what the forces lack. Else steps with the largest stiffness in any
    direction, by which the convex potential always falls under an isotropic law: f(v)/v, across the
    motion, is the curvature of a parabola that touches the potential and lies above it. NaN for a law
    that does not stand for dry friction.
    """
    if not law.regularised:
        return np.full(2, np.nan)
    narrower, target = law.scaled(1 / COMPARED), law.force(velocity) @ load
    w, here = np.zeros(2), narrower.at(velocity)
    lacking = target - here.force @ load
    for _ in range(MOST_CORRECTIONS):
        tangent = load * here.tangent
        change = _solve(tangent, lacking)
        there = narrower.at(velocity + (w + change)[:, None])
        if not np.abs(target - there.force @ load).max() < np.abs(lacking).max():
            stiffness = _largest(tangent).sum()
            change = lacking / stiffness if stiffness > 0 else np.zeros(2)
            there = narrower.at(velocity + (w + change)[:, None])
        w, here, lacking = w + change, there, target - there.force @ load
        if np.abs(change).max() < 1e-6 * narrower.width:
            break
    return w


def _largest(tangent: Array) -> Array:
    """Larger eigenvalue of (xx, xy, yy), (points,)."""
    xx, xy, yy = tangent
    return np.asarray((xx + yy) / 2 + np.sqrt((xx - yy) ** 2 / 4 + xy**2))
