"""The speed at which a law with a width balances velocities that are linear on each cell."""

import math

import numpy as np
from numpy.typing import NDArray

from linear_theory.friction.law import FrictionLaw
from linear_theory.line.roots import EPS, bracketed_newton
from linear_theory.line.tanh_level import NARROWEST, SATURATED, not_narrower

Array = NDArray[np.float64]

CLOSE = 0.02
"""Slip speeds between the ends of a cell below which two Gauss points are exact to rounding."""


def regularised_speed(velocity: Array, weight: Array, law: FrictionLaw, guess: Array) -> Array:
    """V with int w f(V + v) = 0, f the force of the law, v = `velocity` linear on each cell."""
    fastest = abs(velocity).max(axis=1)
    law = not_narrower(law, NARROWEST * float(fastest.max()))

    def balance(speed: Array) -> tuple[Array, Array]:
        slip = speed[:, None] + velocity
        force, tangent = _means(law, slip)
        return np.sum(weight * force, axis=1), np.sum(weight * tangent, axis=1)

    return bracketed_newton(balance, -fastest, fastest, guess, atol=EPS * float(fastest.max()))


def _means(law: FrictionLaw, slip: Array) -> Array:
    """Means of force and tangent over cells on which the velocity is linear, (2, times, cells).

    slip: at their ends, (times, cells + 1). Differences of their integrals; means of two Gauss points
    where these would cancel.
    """
    a, b = slip[:, :-1], slip[:, 1:]
    one_way = np.sign(a) == np.sign(b)
    dry = one_way & (np.minimum(abs(a), abs(b)) > SATURATED * law.width)
    # across rest the tangent may jump; there nothing cancels, as potential and force are 0 there
    close = dry | (abs(b - a) < CLOSE * law.width) & (one_way | law.reversible)
    close |= a == b
    with np.errstate(divide="ignore", invalid="ignore"):
        means = np.diff([law.potential(slip[None]), law.force(slip[None])[0]]) / (b - a)
    middle, offset = (a[close] + b[close]) / 2, (b[close] - a[close]) / math.sqrt(12)
    inside = law.at(np.stack([middle - offset, middle + offset])[None])
    means[:, close] = inside.force[0].sum(0) / 2, inside.tangent[0].sum(0) / 2
    return np.asarray(means)
