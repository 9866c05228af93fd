"""Balance of friction with a direction and a width on a body that carries a travelling wave.

With m the value of g that is at rest, slip is unit (z(m) - z(g)), and m is the root of

    int w f(unit (z(m) - z(g))) dphi = 0,

f the force of the law. The profile is cut where g = m, so that f is smooth on every panel.
"""

import math

import numpy as np
from numpy.typing import NDArray

from linear_theory.friction.law import FrictionLaw
from linear_theory.line.body import Body
from linear_theory.line.result import Level
from linear_theory.line.roots import EPS, bracketed_newton
from linear_theory.line.tanh_level import NARROWEST, not_narrower, quadrature

Array = NDArray[np.float64]


def directional_level(body: Body, law: FrictionLaw, unit: float) -> Level:
    """q = z(m) - mean z, in units of which velocities are `unit`."""
    low, high = float(body.profile.values.min()), float(body.profile.values.max())
    law = not_narrower(law, NARROWEST * abs(unit) * (body.range[1] - body.range[0]))
    sign = math.copysign(1.0, unit)

    def balance(rest: Array, finer: float = 1.0) -> tuple[Array, Array]:
        force, slope = _force(body, law, unit, float(rest), finer)
        return np.array(sign * force), np.array(sign * slope)

    rest = bracketed_newton(balance, low, high, 0.0, atol=4 * EPS * body.profile.scale)
    miss, slope = balance(rest, finer=0.5)
    rounding = 4 * EPS * (body.profile.scale + abs(float(rest)))
    error = float(abs(miss) / slope) if slope > 0 else high - low
    steep = body.slope(float(rest))
    level = float(body.height(np.array(float(rest)))) - body.mean_height
    return Level(level, steep * (error + rounding) + 16 * EPS * abs(level) + body.noise)


def _force(body: Body, law: FrictionLaw, unit: float, rest: float, finer: float) -> tuple[float, float]:
    """Integral of w f over the period, relative to the mean weight, and its derivative by m."""
    level = body.height(np.array(rest))

    def slip(g: Array) -> Array:
        return np.asarray(level - body.height(g))

    wide = min(law.width, 1e300)

    def arguments(g: Array) -> Array:
        return slip(g)[None] * abs(unit) / wide

    measure, g = quadrature(body.profile.anchored(rest), arguments, finer)
    met = law.at(unit * slip(g)[None])
    weight = measure * (1 + body.gain(g))
    force, tangent = float(weight @ met.force[0]), float(weight @ met.tangent[0])
    return force, tangent * unit * body.slope(rest)
