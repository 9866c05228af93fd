"""Power of friction on a body on a line, over mu times the weight of the undeformed body.

With load w and velocity against the ground v, it is the mean of w f(v) v over the body. For a sine
wave under dry friction, load per current length and stretch 1 + alpha c (see `closed_form`), the means
of |sin(theta) - sin(phi)| and sin(phi) |sin(theta) - sin(phi)| give

    P = (alpha/(pi nT)) cos(theta) (2 + alpha sin(theta) - alpha^2),        theta = alpha cos(theta),

and under viscous friction f = v/v_1, with V = alpha^2/(2nT), P = (alpha/nT)^2 (1/2 - alpha^2/4)/v_1.
"""

import math

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.estimate import Estimate
from linear_theory.common.quadrature import gauss_legendre
from linear_theory.friction.law import FrictionLaw
from linear_theory.line.body import Body
from linear_theory.line.roots import EPS
from linear_theory.line.tanh_level import NARROWEST, quadrature

Array = NDArray[np.float64]

ROUNDING = 64 * EPS
"""Relative error of the sums."""

POINTS = 4
"""Gauss points on a cell on which the velocity is linear; with dry friction integrals are exact."""


def travelling_power(
    body: Body, level: float, still: float | None, unit: float, law: FrictionLaw
) -> Estimate:
    """Power of a travelling wave, whose elements move with unit (level - z + mean z).

    still: g where a dry element is at rest, None for other laws; unit: alpha/(nT).
    """

    def velocity(g: Array) -> Array:
        return unit * (level + body.mean_height - body.height(g))

    def density(g: Array) -> Array:
        return (1 + body.gain(g)) * law.dissipation(velocity(g)[None])

    at_rest = float(body.growth.law.stretch(np.asarray(body.growth.start))) ** body.growth.power
    profile = body.profile
    if still is None and not law.reversible:  # its force has a corner at rest
        profile = profile.anchored(body.at_rest(level))
    if still is not None:
        power = profile.mean_with_kink(density, still)
    elif math.isinf(law.width):
        power = profile.mean(density)
    else:  # panels of the width resolve a law that is smooth on them to rounding
        width = max(law.width, NARROWEST * abs(unit) * (body.range[1] - body.range[0]))
        measure, g = quadrature(profile, lambda g: velocity(g)[None] / width, 1.0)
        power = float(measure @ density(g))
    return Estimate(at_rest * power, at_rest * ROUNDING * power)


def sampled_power(slip: Array, weight: Array, law: FrictionLaw) -> Array:
    """Power (times,) of velocities (times, cells + 1) linear on each cell, weights (times, cells)."""
    a, b = slip[:, :-1], slip[:, 1:]
    if law.width == 0:
        (back, forth), size, mean = law.limits, _mean_size(a, b), (a + b) / 2
        return np.sum(weight * (forth * (size + mean) + back * (size - mean)) / 2, axis=1)
    nodes, weights = gauss_legendre(POINTS)
    inside = (law.dissipation(((a + b) / 2 + (b - a) / 2 * node)[None]) for node in nodes)
    return np.asarray(
        sum(w / 2 * np.sum(weight * d, axis=1) for w, d in zip(weights, inside, strict=True))
    )


def _mean_size(a: Array, b: Array) -> Array:
    """Mean of |v| between two ends of a linear v."""
    size = (abs(a) + abs(b)) / 2
    turns = a * b < 0
    size[turns] = (a[turns] ** 2 + b[turns] ** 2) / (2 * abs(b[turns] - a[turns]))
    return size
