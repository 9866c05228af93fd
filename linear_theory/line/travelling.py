"""Friction balance of any travelling wave on a line, to rounding.

With n whole waves on the body, v_cm = -(alpha/nT) g, g = c - mean c, at all times, so that

    V = (alpha/nT) m,   m the weighted median of g, weight w = 1 + alpha c        (dry, eq. 7)

(weight 1 if the load is conserved), a constant. To leading order m is the plain median m0, and
w adds a rise d of the level: twice the weight between m0 and m0 + d equals alpha E|g - m0|. Hence

    V = (alpha/nT) m0 + (alpha^2/nT) E|g - m0|/(2 p(m0)) + ...,   p the density of the values of g.

g is continuous and takes all values between its extremes, so its median is unique. Where it is flat
at the median (a pulse with gaps) part of the body is at rest and bears any friction up to its limit:
V stays where it is for a range of forces, and all the coefficients beyond the first vanish. It is
also the limit v0 -> 0 of the law tanh(v/v0).
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.friction import FrictionLaw
from linear_theory.line.profile import Profile, polynomial
from linear_theory.line.result import REST_PART, REST_SPEED, Balance
from linear_theory.line.roots import EPS, bracketed_newton
from linear_theory.waves import TravellingWave

Array = NDArray[np.float64]

SATURATED = 20.0
"""|tanh(x)| = 1 to rounding beyond this."""

GAUSS_POINTS = 10
"""For tanh over an interval of length 1: poles at distance pi/2 or more, error < 1e-16."""

MOST_HALVINGS = 60
"""A cell halved so often is narrower than the rounding of its ends."""


class Level(NamedTuple):
    """Level m of g that belongs to the speed, and its error."""

    value: float
    error: float


def travelling_balance(wave: TravellingWave, alpha: float, law: FrictionLaw, grows: bool) -> Balance:
    """Speed of a travelling wave; grows: whether the load on a piece grows with its length.

    Raises ValueError if 1 + alpha c <= 0 at some phase.
    """
    sign = -1.0 if alpha < 0 else 1.0  # (alpha, c) and (-alpha, -c) are the same growth
    profile, mean = Profile.of(wave, sign), sign * wave.mean
    _check_stretch(profile, alpha, mean)
    unit = abs(alpha) / wave.count / wave.period
    level = _level(profile, wave, abs(alpha) if grows else 0.0, mean, _width(law, abs(unit)))
    first, second = _coefficients(profile, wave, law, grows)
    return Balance(
        mean=unit * level.value,
        error=abs(unit) * (level.error + 4 * EPS * abs(level.value)),
        times=np.array([0.0, wave.period]),
        velocity=np.array([unit * level.value, unit * level.value]),
        fastest=abs(unit) * float(abs(profile.values - level.value).max()),
        first=sign * first / wave.count / wave.period,
        second=second / wave.count / wave.period,
        sticks=law.width == 0 and _rests(profile, level.value),
    )


def _width(law: FrictionLaw, unit: float) -> float:
    """Slip speed over |alpha/nT|; infinite where that is 0 or beyond doubles."""
    if law.width == 0 or unit == 0:
        return law.width if law.width == 0 else math.inf
    with np.errstate(over="ignore"):
        return float(np.float64(law.width) / unit)


def _level(profile: Profile, wave: TravellingWave, weight: float, mean: float, width: float) -> Level:
    if width == 0:
        return _dry_level(profile, weight, mean)
    if math.isfinite(width):
        return _tanh_level(profile, weight, mean, width)
    level = weight * _variance(wave) / (1 + weight * mean)
    return Level(level, 16 * EPS * level)


def _check_stretch(profile: Profile, alpha: float, mean: float) -> None:
    worst = int(profile.values.argmin())
    growth = float(profile.values[worst]) + mean
    stretch = 1 + abs(alpha) * growth
    if stretch <= 0:
        raise ValueError(
            f"alpha = {alpha:g}: 1 + alpha c = {stretch:g} at the phase {profile.nodes[worst]:.4g} of "
            f"the wave; must be {'<' if alpha > 0 else '>'} {math.copysign(1 / growth, alpha):.6g}"
        )


def _coefficients(
    profile: Profile, wave: TravellingWave, law: FrictionLaw, grows: bool
) -> tuple[float, float]:
    """nT times the coefficients of |alpha| and alpha^2 for the profile as it is signed.

    For tanh at a fixed slip speed the limit of small alpha is the viscous one. NaN for the second
    where the median is a turning value and the body does not stick: V is not smooth in alpha there.
    """
    if law.width > 0:
        return 0.0, _variance(wave) if grows else 0.0
    median = profile.median()
    anchored = profile.anchored(median)
    if not grows:
        return median, 0.0
    if anchored.turns(median) and not _rests(profile, median):
        return median, math.nan
    return median, anchored.mean_deviation(median) / (2 * anchored.density(median))


def _rests(profile: Profile, level: float) -> bool:
    """Whether much of the body moves with the ground when V belongs to that level."""
    tolerance = REST_SPEED * float(np.ptp(profile.values))
    return profile.around(level, tolerance) >= REST_PART


def _variance(wave: TravellingWave) -> float:
    return float(np.sum(wave.cosine**2 + wave.sine**2)) / 2


def _dry_level(profile: Profile, weight: float, mean: float) -> Level:
    """Weighted median of g: the weight below it is half of all, w = factor + weight g."""
    factor, lower, upper = 1 + weight * mean, float(profile.values.min()), float(profile.values.max())
    base, target, guess = lower, factor / 2, -lower
    if profile.symmetric:  # half of the body is below 0: what is missing is a weight of order alpha
        profile, base = profile.anchored(0.0), 0.0
        target = weight * profile.mean_deviation(0.0) / 2
        guess = target / (factor * profile.density(0.0))
    if target == 0:
        return Level(base, 0.0)

    def excess(height: Array) -> tuple[Array, Array]:
        rise = profile.rise(base, float(height))
        value = factor * rise.part + weight * rise.growth - target
        return np.array(value), np.array(factor * rise.part_rate + weight * rise.growth_rate)

    coarse = 0.0 if profile.symmetric else 4 * EPS * profile.scale
    height = bracketed_newton(excess, 0.0, upper - base, guess, atol=coarse)
    slope = float(excess(height)[1]) or math.inf
    return Level(base + float(height), 8 * EPS * (target / slope + float(height)) + coarse)


def _tanh_level(profile: Profile, weight: float, mean: float, width: float) -> Level:
    """Root m of int w tanh((m - g)/width) = 0, w = factor + weight g."""
    factor, coarse = 1 + weight * mean, 4 * EPS * profile.scale
    if profile.symmetric:
        return _symmetric_tanh_level(profile.anchored(0.0), weight, factor, width)

    def balance(level: Array, finer: float = 1.0) -> tuple[Array, Array]:
        measure, g = _quadrature(profile, (float(level),), width * finer)
        t, measure = np.tanh((level - g) / width), measure * (factor + weight * g)
        return np.array(measure @ t), np.array(measure @ ((1 - t) * (1 + t)) / width)

    ends = float(profile.values.min()), float(profile.values.max())
    level = bracketed_newton(balance, *ends, profile.median(), atol=coarse)
    miss, slope = balance(level, finer=0.5)
    return Level(float(level), float((abs(miss) + 4 * EPS) / slope) + coarse)


def _symmetric_tanh_level(profile: Profile, weight: float, factor: float, width: float) -> Level:
    """The same where int tanh(-g/width) = 0: what is left is of order alpha, and so is m.

    Written without cancellation by tanh x - tanh y = tanh(x - y) (1 - tanh x tanh y).
    """
    if not weight:
        return Level(0.0, 0.0)

    def balance(level: Array, finer: float = 1.0) -> tuple[Array, Array]:
        measure, g = _quadrature(profile, (0.0, float(level)), width * finer)
        before, t = np.tanh(-g / width), np.tanh((level - g) / width)
        moved = np.tanh(level / width) * (measure @ (1 - before * t))
        slope = (measure * (factor + weight * g)) @ ((1 - t) * (1 + t)) / width
        return np.array(factor * moved + weight * (measure @ (g * t))), np.array(slope)

    upper = float(profile.values.max())
    level = bracketed_newton(balance, 0.0, upper, weight * upper**2 / 2)
    miss, slope = balance(level, finer=0.5)
    return Level(float(level), float(abs(miss) / slope) + 16 * EPS * float(level))


def _quadrature(profile: Profile, levels: tuple[float, ...], width: float) -> tuple[Array, Array]:
    """Weights (of the period) and values of g at Gauss points that resolve tanh((level - g)/width).

    Cells are halved until g varies by less than `width` over each, or stays SATURATED widths away
    from all levels.
    """
    node, left, right = _panels(profile, levels, width)
    points, weights = np.polynomial.legendre.leggauss(GAUSS_POINTS)
    half = (right - left) / 2
    distance = left + half + half * points[:, None]
    values = polynomial(profile.taylor[:, node], distance)
    return (weights[:, None] * abs(half) / (2 * math.pi)).ravel(), values.ravel()


def _panels(
    profile: Profile, levels: tuple[float, ...], width: float
) -> tuple[NDArray[np.intp], Array, Array]:
    """Node and signed distances from it of both ends of every panel of the quadrature."""
    # From the end nearer to 0, as g is exact at nodes of value 0: `width` may be below rounding.
    node = np.arange(profile.nodes.size - 1)
    ahead = abs(profile.values[:-1]) <= abs(profile.values[1:])
    right = np.where(ahead, 1.0, -1.0) * np.diff(profile.nodes)
    node, left = np.where(ahead, node, node + 1), np.zeros(node.size)
    finished = []
    for left_over in range(MOST_HALVINGS, -1, -1):
        ends = polynomial(profile.taylor[:, node], np.stack([left, right]))
        low, high = ends.min(axis=0), ends.max(axis=0)
        reach = SATURATED * width
        near = np.any([(low - reach < m) & (m < high + reach) for m in levels], axis=0)
        split = near & (high - low > width) & (left_over > 0)
        finished.append((node[~split], left[~split], right[~split]))
        if not split.any():
            break
        node, left, right = node[split], left[split], right[split]
        middle = (left + right) / 2
        node = np.concatenate([node, node])
        left, right = np.concatenate([left, middle]), np.concatenate([middle, right])
    node, left, right = (np.concatenate(a) for a in zip(*finished, strict=True))
    return node, left, right
