"""How the sheet slides at one time, and by how much its speed would change with step and slip speed.

A rigid velocity w that is added to the velocities v of the points must leave the forces of friction
in balance: sum f(v + w) = const. Linearised, that turns a change dv of the velocities of a sheet whose
shape friction does not change into a change of its speed.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.friction import Friction, sech_squared, tanh_ratio
from fem_check.shell.kinematics.point_state import PointState, dot

Array = NDArray[np.float64]

COMPARED = 0.5
"""Slip speed, relative to that of the scene, whose speed is computed for comparison."""

MOST_CORRECTIONS = 30


class Sliding(NamedTuple):
    """At one time. fastest: largest speed along the ground. linear: share of the load that moves slower
    than the slip speed. step, slip (2,): change of the velocity of the sheet along the ground if the
    velocities were exact in time, and if the slip speed were `COMPARED` times its value."""

    fastest: float
    linear: float
    step: Array
    slip: Array


def sliding(friction: Friction, state: PointState, error: Array, measure: Array) -> Sliding:
    """error: estimated (exact - computed) velocity of the points, (components, points)."""
    assert state.step is not None
    assert state.step.load is not None
    assert state.step.velocity is not None
    velocity, load = friction.velocity(state)[:2], state.step.load
    speed = np.sqrt(dot(velocity, velocity))
    total = load.sum()
    share = load[speed < friction.slip_speed].sum() / total if total > 0 else 0.0
    tangent = friction.hessian(state)[0, 0] / state.step.velocity.rate
    pairs = tangent[[0, 1, 3]] if state.components == 3 else tangent
    # Of a velocity error the mean over the sheet is seen directly, and the rest through friction.
    step = rigid(pairs, error[:2]) + error[:2] @ measure / measure.sum()
    return Sliding(float(speed.max()), float(share), step, _slip_change(friction, velocity, load))


def rigid(tangent: Array, change: Array) -> Array:
    """w (2,) with sum K (change + w) = 0 for K = (xx, xy, yy) at the points (change: (2, points))."""
    xx, xy, yy = tangent
    force = np.array([xx @ change[0] + xy @ change[1], xy @ change[0] + yy @ change[1]])
    return -_solve(tangent, force)


def _solve(tangent: Array, force: Array) -> Array:
    xx, xy, yy = tangent.sum(1)
    determinant = xx * yy - xy**2
    if not determinant > 0:
        return np.zeros(2)
    return np.array([yy * force[0] - xy * force[1], xx * force[1] - xy * force[0]]) / determinant


def _slip_change(friction: Friction, velocity: Array, load: Array) -> Array:
    """w (2,) that keeps the sum of forces when the slip speed is multiplied by `COMPARED`.

    Newton's steps where they reduce what the forces lack. Else steps with the secants f(v)/v, by which
    the convex potential always falls: it lies below the parabola of that curvature that touches it.
    """
    target = (load * _secants(velocity, friction.slip_speed) * velocity).sum(1)
    w, slip = np.zeros(2), COMPARED * friction.slip_speed
    lacking = target - _forces(velocity, load, slip)
    for _ in range(MOST_CORRECTIONS):
        moved = velocity + w[:, None]
        change = _solve(_tangent(moved, load, slip), lacking)
        after = target - _forces(moved + change[:, None], load, slip)
        if not np.abs(after).max() < np.abs(lacking).max():
            stiffness = (load * _secants(moved, slip)).sum()
            change = lacking / stiffness if stiffness > 0 else np.zeros(2)
            after = target - _forces(moved + change[:, None], load, slip)
        w, lacking = w + change, after
        if np.abs(change).max() < 1e-6 * slip:
            break
    return w


def _forces(velocity: Array, load: Array, slip: float) -> Array:
    return np.asarray((load * _secants(velocity, slip) * velocity).sum(1))


def _secants(velocity: Array, slip: float) -> Array:
    """tanh(|v|/slip)/|v|, (points,)."""
    return tanh_ratio(np.sqrt(dot(velocity, velocity)) / slip) / slip


def _tangent(velocity: Array, load: Array, slip: float) -> Array:
    """Derivative of load tanh(|v|/slip) v/|v| by v, (xx, xy, yy) at the points."""
    speed = np.sqrt(dot(velocity, velocity))
    along, across = sech_squared(speed / slip) / slip, _secants(velocity, slip)
    x, y = velocity / np.where(speed > 0, speed, 1)
    change = along - across
    return np.asarray(load * np.stack([across + change * x**2, change * x * y, across + change * y**2]))
