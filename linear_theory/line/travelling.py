"""Friction balance of any travelling wave on a line, to rounding, at finite strain.

Velocities are -(alpha/nT) (z - mean z) at all times (see `body`), z increases with g = c - mean c, and
dry friction balances with

    V = (alpha/nT) (z(m) - mean z),   m the median of g weighted with w,                 (dry, eq. 7)

a constant. For friction with a direction m is the quantile at mu_b/(mu_f + mu_b) instead (for alpha/n
> 0; see `share`). To leading order m is the plain median m0, and w = 1 + p alpha c adds a rise d of the
level: twice the weight between m0 and m0 + d equals p alpha E|g - m0|. With s = 1 + alpha c +
s_2 alpha^2 c^2,

    nTV = alpha m0 + alpha^2 [p E|g - m0|/(2 f(m0)) + s_2 (M0^2 - E c^2)] + ...,

f the density of the values of g and M0 = m0 + mean c. Viscous friction gives p alpha^2 E g^2 for every
stretch. At the quantile of another share q, p (E|g - m0|/2 + m0 (1/2 - q))/f takes the place of the
first term.

g is continuous and takes all values between its extremes, so its median is unique. Where it is flat
at the median (a pulse with gaps) part of the body is at rest and bears any friction up to its limit:
V stays where it is for a range of forces, and the median stays m0. It is also the limit v0 -> 0 of
the law tanh(v/v0).
"""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from linear_theory.friction.law import FrictionLaw
from linear_theory.line.body import Body
from linear_theory.line.directional_level import directional_level
from linear_theory.line.piece import Piece
from linear_theory.line.result import REST_PART, REST_SPEED, Level, LineMotion
from linear_theory.line.roots import EPS, bracketed_newton
from linear_theory.line.share import share_slower
from linear_theory.line.tanh_level import tanh_level
from linear_theory.line.work import travelling_power
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]


def travelling_balance(
    wave: TravellingWave, alpha: float, law: FrictionLaw, growth: Piece
) -> LineMotion:
    """Speed of a travelling wave.

    Raises ValueError if a strain alpha c is beyond the range of the growth law at some phase.
    """
    body, scale = Body.of(wave, alpha, growth), wave.count * wave.period
    unit, sign = body.size / scale, -1.0 if alpha < 0 else 1.0
    level, rests, still = _level(body, law, unit)
    power = travelling_power(body, level.value, still, unit, law)
    small = replace(body, growth=growth, size=0.0)
    first, second = _coefficients(small, sign * wave.mean, law, share_slower(law, -unit))
    return LineMotion(
        mean=unit * level.value,
        error=abs(unit) * (level.error + 4 * EPS * abs(level.value)),
        times=np.array([0.0, wave.period]),
        velocity=np.array([unit * level.value, unit * level.value]),
        fastest=abs(unit) * body.fastest(level.value),
        first=sign * first / scale,
        second=second / scale,
        sticks=rests,
        power=power,
        friction=np.full(2, power.value),
    )


def _width(law: FrictionLaw, unit: float) -> float:
    """Slip speed over |alpha/nT|; infinite where that is 0 or beyond doubles."""
    if law.width == 0 or unit == 0:
        return law.width if law.width == 0 else math.inf
    with np.errstate(over="ignore"):
        return float(np.float64(law.width) / unit)


def _level(body: Body, law: FrictionLaw, unit: float) -> tuple[Level, bool, float | None]:
    """nTV/|alpha|, whether the body sticks, and the value of g that is at rest if friction is dry."""
    if law.width == 0:
        quantile = _weighted_quantile(body, share_slower(law, -unit))  # slip unit (level - g)
        return _at_rest(body, quantile), _sticks(body, quantile.value), quantile.value
    if not law.reversible and unit != 0:
        return directional_level(body, law, unit), False, None
    width, viscous = _width(law, abs(unit)), _viscous_level(body)
    if math.isinf(width):
        return viscous, False, None
    symmetric = body.profile.symmetric
    guess = viscous if symmetric else _at_rest(body, Level(body.profile.quantile(), 0.0))
    return tanh_level(body, width, guess.value), False, None


def _at_rest(body: Body, median: Level) -> Level:
    """The speed at which what has the value `median` of g is at rest."""
    height = float(body.height(np.array(median.value)))
    rounding = 8 * EPS * abs(height) + body.noise
    return Level(height - body.mean_height, body.slope(median.value) * median.error + rounding)


def _viscous_level(body: Body) -> Level:
    """Minus the mean of v weighted with w: the part of w that is even about its mean does nothing."""
    if body.growth.power == 0:
        return Level(0.0, 0.0)

    def moment(g: Array) -> Array:
        return body.gain(g) * (body.height(g) - body.mean_height)

    weight = 1 + body.profile.mean(body.gain)
    size = body.profile.mean(lambda g: abs(moment(g)))
    return Level(body.profile.mean(moment) / weight, 16 * EPS * size / weight + body.noise)


def _weighted_quantile(body: Body, share: float = 0.5) -> Level:
    """The value of g that this share of the weight lies below."""
    profile, base = body.profile, float(body.profile.values.min())
    reach = float(body.profile.values.max()) - base
    halves = profile.symmetric and share == 0.5
    if halves:  # half of the body is below 0: what is missing is a weight of order alpha
        profile, base = profile.anchored(0.0), 0.0
    weight = profile.integrals(body.gain)
    if halves:
        target = float(abs(weight.cells).sum()) / 2
        guess = target / profile.density(0.0)
    else:
        target, guess = share * (1 + float(weight.cells.sum())), -base
    if target == 0:
        return Level(base, 0.0)

    def excess(height: Array) -> tuple[Array, Array]:
        rise = profile.rise(base, float(height), weight)
        slope = rise.part_rate * (1 + body.gain(base + height))
        return np.array(rise.part + rise.gain - target), np.array(slope)

    coarse = 0.0 if halves else 4 * EPS * profile.scale
    # as tight as the error below says, also where the slope is infinite: at an extremum of g
    height = bracketed_newton(excess, 0.0, reach, guess, rtol=4 * EPS, atol=coarse)
    slope = float(excess(height)[1]) or math.inf
    return Level(base + float(height), 8 * EPS * (target / slope + float(height)) + coarse)


def _coefficients(body: Body, mean: float, law: FrictionLaw, share: float) -> tuple[float, float]:
    """nT times the coefficients of |alpha| and alpha^2 for the profile as it is signed, of that mean.

    For tanh at a fixed slip speed the limit of small alpha is the viscous one. NaN for the second
    where the median is a turning value, if weight grows and the body does not stick: V is not smooth in
    alpha there.
    """
    profile, power, variance = body.profile, body.growth.power, body.profile.mean(np.square)
    if law.width > 0:
        return (0.0, power * variance) if law.reversible else (math.nan, math.nan)
    median = profile.quantile(share)
    bend = body.growth.curvature * (median * (median + 2 * mean) - variance)
    if power == 0:
        return median, bend
    anchored = profile.anchored(median)
    if anchored.turns(median) and not _sticks(body, median):
        return median, math.nan
    above = anchored.mean_deviation(median) / 2 + median * (0.5 - share)  # E[g; g > median]
    return median, bend + power * above / anchored.density(median)


def _sticks(body: Body, median: float) -> bool:
    """Whether much of the body moves with the ground when what has that value of g is at rest."""
    low, high = body.range
    tolerance = REST_SPEED * (high - low) / body.slope(median)
    return body.profile.around(median, tolerance) >= REST_PART
