"""Derivatives of speed and power on a line by the growth strain at every phase of a wave.

See `gradient` for the speed. Of the power P = <w D(v)> over mu and the weight, D = v f(v) and v =
U (s_m - s),

    dP = <w' D de> + <w D'(v) (U ds_m - U s' de)>,       T dP/dT = -<w D'(v) (U dV/dU - U (s - <s>))>.

Under dry friction D' = f, and as <w f> = 0 the value at rest drops out: P has no kink where V has one,
but where part of the body is at rest.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.friction.law import FrictionLaw
from linear_theory.line.body import Body
from linear_theory.line.share import share_slower
from linear_theory.line.tanh_level import phased_quadrature

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Weights:
    """dJ = weights . de(phases), both (points,), per length of the body; rate: -T dJ/dT."""

    phases: Array
    weights: Array
    rate: float

    def against(self, strains: Array) -> Array:
        """Derivatives for changes of the strain (parameters, points)."""
        return strains @ self.weights


class MotionWeights(NamedTuple):
    """Those of the mean speed and of the power, at the same phases."""

    speed: Weights
    power: Weights


def weights_of(body: Body, speed: float, law: FrictionLaw, unit: float) -> tuple[float, MotionWeights]:
    """The value of g that is at rest, and the weights.

    Of a body whose mean speed that is, lengths per time; unit: 1/(nT).
    """
    level = body.at_rest(speed / (unit * body.size))
    return level, (_dry if law.width == 0 else _smooth)(body, level, law, unit)


class _Laws:
    """Stretch, weight and their slopes at values of g."""

    def __init__(self, body: Body, g: Array) -> None:
        law, power = body.growth.law, body.growth.power
        e = body.growth.start + body.size * g
        self.stretch, self.slope = law.stretch(e), law.slope(e)
        self.weight = self.stretch**power
        self.weight_slope = power * self.weight / self.stretch * self.slope


def _dry(body: Body, level: float, law: FrictionLaw, unit: float) -> MotionWeights:
    profile = body.profile.anchored(level)
    wide = np.diff(profile.nodes)
    phases, measure, g = profile.points()
    at = _Laws(body, g)
    middle = (profile.values[:-1] + profile.values[1:]) / 2
    below = np.broadcast_to(middle < level, (phases.size // wide.size, wide.size)).ravel()
    share = share_slower(law, -unit * body.size)
    crossing = np.flatnonzero(profile.values[:-1] == level)
    slopes = np.maximum(abs(profile.taylor[1, crossing]), np.finfo(float).tiny ** 0.5)
    density = 1 / slopes / np.sum(1 / slopes)  # of the crossings, and of e as of g
    rest = _Laws(body, np.array([level]))
    # sum_i w/|e'| = weight/size sum_i 1/|g'|
    total = rest.weight / body.size * np.sum(1 / slopes)
    inner = -2 * math.pi * measure * at.weight_slope * (below - share) / total
    weights = [rest.slope * density, rest.slope * inner - measure * at.slope]
    rate = unit * float((rest.stretch - measure @ at.stretch)[0])
    every = np.concatenate([profile.nodes[crossing], phases])
    slip = unit * (rest.stretch - at.stretch)
    lost, force = law.dissipation(slip[None]), law.force(slip[None])[0]
    spent = measure * (at.weight_slope * lost - unit * at.weight * force * at.slope)
    power = np.concatenate([np.zeros(crossing.size), spent])
    return MotionWeights(
        Weights(every, unit * np.concatenate(weights), rate),
        Weights(every, power, float(measure @ (at.weight * lost))),
    )


def _smooth(body: Body, level: float, law: FrictionLaw, unit: float) -> MotionWeights:
    at_rest = _Laws(body, np.array([level])).stretch

    def slip(g: Array) -> Array:
        return np.asarray(unit * (at_rest - _Laws(body, g.ravel()).stretch).reshape(g.shape))

    wide = min(law.width, 1e300)
    profile = body.profile if law.reversible else body.profile.anchored(level)
    measure, phases, g = phased_quadrature(profile, lambda g: slip(g)[None] / wide, 0.5)
    at, met = _Laws(body, g), law.at(slip(g)[None])
    force, tangent = met.force[0], met.tangent[0]
    stiff = float(measure @ (at.weight * tangent))
    moved = at.weight * tangent * at.slope * unit - at.weight_slope * force
    mean = float(measure @ at.stretch)
    rate = unit * float(measure @ (at.weight * tangent * (at.stretch - mean))) / stiff
    steep = force + slip(g) * tangent  # D'
    lost = at.weight_slope * slip(g) * force - unit * at.weight * steep * at.slope
    carried = float(measure @ (at.weight * steep)) / stiff
    spent = float(measure @ (at.weight * steep * (rate - unit * (at.stretch - mean))))
    return MotionWeights(
        Weights(phases, measure * (moved / stiff - unit * at.slope), rate),
        Weights(phases, measure * (carried * moved + lost), spent),
    )
