"""Friction balance of any wave c(S, t) on a line, from samples.

Eqs 5 and 6 with the stretch s(alpha c) give the velocity in the frame of the mean motion, alpha g,
g = int_0^S s'(alpha c) c_t dS' less its mean; eq. 7 is balanced at every time by

    V(t) = -alpha m,   m the median of g over the body, weighted with s^p (see `growth`)   (dry)

or by the root of a law with a width. Of friction with a direction m is the quantile at the share of the
weight that must slip one way, mu_f/(mu_f + mu_b) for alpha > 0 (`line.share`). Here s' c_t is linear
between equidistant points, as is g, and the weight constant there: every step after that is exact, so
the error falls with the square of the spacing, and samples and times are doubled until the last change
meets the tolerance.

For small alpha g = g_1 + alpha s_2 g_2 + ..., g_1 = int c_t, g_2 = int 2 c c_t, both less their means.
With m_0 the median of g_1, f its density there and E_0 the mean over the places where g_1 = m_0,

    V = -alpha m_0 + alpha^2 (p E[c (1(g_1 < m_0) - share)]/f - s_2 E_0[g_2]) + ...

all of them weighted with the map of friction, if there is one.
"""

import math
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.estimate import Estimate
from linear_theory.common.tolerance import Tolerance
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.laws import Viscous
from linear_theory.friction.maps import Mapped
from linear_theory.line.piece import Piece
from linear_theory.line.result import REST_PART, REST_SPEED, LineMotion
from linear_theory.line.roots import EPS, bracketed_newton
from linear_theory.line.share import share_slower
from linear_theory.line.tanh_level import NARROWEST, SATURATED, not_narrower
from linear_theory.line.work import sampled_power
from linear_theory.wave.protocol import Drive

Array = NDArray[np.float64]

FEWEST = 64
MOST_CELLS, MOST_TIMES, MOST_SAMPLES = 1 << 14, 1 << 12, 1 << 21
"""Bounds of the doubling; a tolerance that needs more is reported as missed."""

CHECKS, SEED = 32, 7
"""Random times of a check at first; at most twice as many as equidistant ones."""

CHANCE = 2.0
"""Of the last change, which is three times the error where that falls with the square of the spacing.
Medians do not fall so evenly: of 200 random waves, laws and bodies one was off by 1.3 changes."""

HIDDEN, PER_HARMONIC = 0.1, 64
"""Share of the tolerance up to which harmonics of the wave may go without a check: those with fewer
times to their period. Dry friction turns a harmonic k into 2k, 3k, ..., of which doublings of N see
nothing where N is a multiple of k."""

CLOSE = 0.02
"""Slip speeds between the ends of a cell below which two Gauss points are exact to rounding."""

COARSE_CELLS, COARSE_SHARE = 128, 0.1
"""Cells of `coarse_means` at least, and the share of c that they may miss."""

BLOCK = 1 << 16
"""Cells times times held at once: few enough to stay in the cache."""


class Snapshot(NamedTuple):
    """Speed, its coefficients of alpha and alpha^2 (nan unless asked for), largest speed, part at rest
    and power of friction over mu times the weight, each (times,)."""

    velocity: Array
    first: Array
    second: Array
    fastest: Array
    rest: Array
    power: Array


def sampled_balance(
    drive: Drive, alpha: float, law: FrictionLaw, growth: Piece, tolerance: Tolerance
) -> LineMotion:
    """Speed of a general wave, the length of the body being 1 in the law, the tolerance and the result.

    Raises ValueError if a sampled strain is out of the range of the law, and for a wave that does not
    repeat after its period or whose rate is not its derivative.
    """
    drive.check()
    sampled, period = partial(_snapshots, drive.fine, alpha, law, growth), drive.period
    cells, times = _first_cells(drive, tolerance.rtol), FEWEST
    doubled = _Doubled(sampled, period)
    space = time = math.inf
    while True:
        fine, coarse = doubled.at(times, 2 * cells, coefficients=True), doubled.at(times, cells)
        mean = float(fine.velocity.mean())
        # A difference may vanish by chance; a quarter of the one before, for second order, does not.
        last_space, space = space, CHANCE * abs(mean - float(coarse.velocity.mean()))
        last_time, time = time, CHANCE * abs(mean - float(fine.velocity[::2].mean()))
        in_space, in_time = max(space, last_space / 4), max(time, last_time / 4)
        goal = tolerance.allowed(mean)
        room = cells * times < MOST_SAMPLES
        more_cells = room and in_space > goal / 2 and cells < MOST_CELLS
        more_times = room and in_time > goal / 2 and times < MOST_TIMES
        if in_space + in_time <= goal or not (more_cells or more_times):
            if drive.hidden(period / times, PER_HARMONIC) * abs(alpha) / 2 <= HIDDEN * goal:
                break
            checks = _Checks(fine.velocity, period, partial(sampled, cells=2 * cells))
            in_time = max(in_time, checks.error(goal - in_space))
            more_times = room and times < MOST_TIMES
            if in_space + in_time <= goal or not more_times:
                break
        cells, times = cells << more_cells, times << more_times
    fastest = float(fine.fastest.max())
    return LineMotion(
        mean=mean,
        error=in_space + in_time + 16 * EPS * fastest,
        times=_instants(period, times),
        velocity=fine.velocity,
        fastest=fastest,
        first=float(fine.first.mean()),
        second=float(fine.second.mean()),
        sticks=law.width == 0 and bool(fine.rest.max() >= REST_PART),
        power=_mean_power(fine.power, coarse.power, drive.hidden(period / times) * abs(alpha)),
        friction=fine.power,
    )


def _instants(period: float, times: int) -> Array:
    return np.asarray(period / times * np.arange(float(times)))


class _Doubled:
    """Snapshots of a period at equidistant times, of which every second is known from half as many."""

    def __init__(self, sampled: Callable[..., Snapshot], period: float) -> None:
        self._sampled, self._period = sampled, period
        self._kept: dict[int, Snapshot] = {}

    def at(self, times: int, cells: int, coefficients: bool = False) -> Snapshot:
        """With coefficients always asked for, or never, of the same number of cells or of more."""
        instants, found = _instants(self._period, times), self._kept.get(cells)
        if found is None or found.velocity.size not in (times, times // 2):
            found = self._sampled(instants, cells, coefficients)
        elif found.velocity.size < times:
            between = self._sampled(instants[1::2], cells, coefficients)
            pairs = zip(found, between, strict=True)
            found = Snapshot(*(np.stack(pair, axis=1).ravel() for pair in pairs))
        self._kept[cells] = found
        return found


def _mean_power(fine: Array, coarse: Array, hidden: float) -> Estimate:
    """Mean of powers (times,), from its change on half as many cells and times."""
    mean = float(fine.mean())
    changes = abs(mean - float(coarse.mean())) + abs(mean - float(fine[::2].mean()))
    return Estimate(mean, CHANCE * changes + hidden + 16 * EPS * mean)


def coarse_means(drive: Drive, alpha: float, law: FrictionLaw, growth: Piece, times: Array) -> Array:
    """Mean speed and power (2,) from these times and cells that the wave asks for, without errors.

    Differences of it between waves that are alike are much better than itself.
    """
    cells = min(max(COARSE_CELLS, _first_cells(drive, COARSE_SHARE)), MOST_CELLS)
    found = _snapshots(drive, alpha, law, growth, times, cells)
    return np.array([found.velocity.mean(), found.power.mean()])


def speeds_at(
    drive: Drive, alpha: float, law: FrictionLaw, growth: Piece, times: Array, cells: int
) -> Array:
    """Speeds at given times, also of a wave that does not repeat, the length of the body being 1."""
    return _snapshots(drive, alpha, law, growth, times, cells).velocity


def _first_cells(drive: Drive, rtol: float) -> int:
    """A power of two, enough for all but rtol of the wave where that is known: pi to a short wave."""
    degree = drive.degree_along(rtol)
    return FEWEST if math.isinf(degree) else max(FEWEST, 1 << math.ceil(math.log2(degree)))


class _Checks(NamedTuple):
    """Equidistant velocities (times,) of a period, and `sampled` to find more at any times.

    Harmonics too high for these times are not in the differences of doublings. But what V at random
    times is off a cubic interpolation has the error of the mean as its expectation.
    """

    velocity: Array
    period: float
    sampled: Callable[[Array], Snapshot]

    def error(self, goal: float) -> float:
        """Error of the mean: the mean of what random times are off, and twice its standard deviation.

        From more of them while that could meet the goal.
        """
        random, most = np.random.default_rng(SEED), 2 * self.velocity.size
        off = self._off(random.uniform(size=CHECKS))
        while True:
            bias, deviation = abs(float(off.mean())), 2 * float(off.std())
            error = bias + deviation / math.sqrt(off.size)
            if error <= goal or off.size >= most or bias + deviation / math.sqrt(most) > goal:
                return error
            off = np.concatenate([off, self._off(random.uniform(size=off.size))])

    def _off(self, phases: Array) -> Array:
        """Velocities at phases in [0, 1) less the cubic interpolation."""
        first, s = np.divmod(self.velocity.size * phases, 1.0)
        around = self.velocity[(first.astype(int) + np.arange(-1, 3)[:, None]) % self.velocity.size]
        weights = (
            -s * (s - 1) * (s - 2) / 6,
            (s + 1) * (s - 1) * (s - 2) / 2,
            -(s + 1) * s * (s - 2) / 2,
            (s + 1) * s * (s - 1) / 6,
        )
        found = self.sampled(self.period * phases).velocity
        return np.asarray(found - sum(w * v for w, v in zip(weights, around, strict=True)))


def _snapshots(
    drive: Drive,
    alpha: float,
    law: FrictionLaw,
    growth: Piece,
    times: Array,
    cells: int,
    coefficients: bool = False,
) -> Snapshot:
    step = max(1, BLOCK // cells)
    parts = [
        _snapshot(drive, alpha, law, growth, times[i : i + step, None], cells, coefficients)
        for i in range(0, times.size, step)
    ]
    return Snapshot(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def _snapshot(
    drive: Drive,
    alpha: float,
    law: FrictionLaw,
    growth: Piece,
    times: Array,
    cells: int,
    coefficients: bool,
) -> Snapshot:
    y = np.linspace(-0.5, 0.5, cells + 1)
    place = drive.sheet.length * y
    c, rate = (_on_grid(f(0.0, place, times), times, y) for f in (drive.value, drive.rate))
    _check_strain(alpha, c, times, y, growth)
    g = _less_mean(growth.slope(alpha * c) * rate)
    weight, mu = (1 + _middle(growth.gain(alpha * c))) / cells, np.ones_like(g)[:, 1:]
    if law.map is not None:
        mu = _middle(np.broadcast_to(law.map.values(0.0, place, times), g.shape))
        weight = weight * mu
    if law.width == 0:
        share = share_slower(law, alpha)
        level, _ = _weighted_quantile(g, weight, share)
        velocity = -alpha * level
    else:
        velocity = -alpha * np.sum(weight * _middle(g), axis=1) / weight.sum(axis=1)
        if not is_viscous(law):
            velocity = _regularised_speed(alpha * g, weight, law, velocity)
    first = second = np.full(times.size, math.nan)
    if coefficients and law.width == 0:
        first, second = _dry_coefficients(c, rate, growth, share, mu)
    elif coefficients and _point_law(law).reversible:
        first, second = _viscous_coefficients(c, rate, growth, mu)
    slip = velocity[:, None] + alpha * g
    tolerance = REST_SPEED * np.ptp(slip, axis=1, keepdims=True)
    ends = _Ends.of(slip)
    rest = np.mean(ends.part_below(tolerance) - ends.part_below(-tolerance), axis=1)
    power = sampled_power(slip, weight, law)
    return Snapshot(velocity, first, second, abs(slip).max(axis=1), rest, power)


def is_viscous(law: FrictionLaw) -> bool:
    """Whether it is linear, so that no equation is to be solved."""
    return type(_point_law(law)) is Viscous


def _point_law(law: FrictionLaw) -> FrictionLaw:
    """That at a point, without its map."""
    return law.law if isinstance(law, Mapped) else law


def _on_grid(values: Array, times: Array, y: Array) -> Array:
    return np.broadcast_to(validation.real_array("wave", values), (times.size, y.size))


def _check_strain(alpha: float, c: Array, times: Array, y: Array, growth: Piece) -> None:
    worst = growth.law.misplaced(alpha * c, extreme=growth.extreme)
    if worst is not None:
        row, column = np.unravel_index(worst, c.shape)
        place = f"S = {y[column] + 0.5:.4g} length, t = {times[row, 0]:.4g}"
        raise growth.law.refusal(alpha, float(alpha * c[row, column]), place, growth.extreme)


def _less_mean(rate: Array) -> Array:
    """int rate dS from one end of the body to every point, less its mean."""
    g = np.zeros_like(rate)
    np.cumsum(_middle(rate) / (rate.shape[1] - 1), axis=1, out=g[:, 1:])
    return np.asarray(g - _middle(g).mean(axis=1, keepdims=True))


def _middle(values: Array) -> Array:
    return np.asarray((values[:, 1:] + values[:, :-1]) / 2)


class _Ends(NamedTuple):
    """A function that is linear on each cell: its smaller value there, and by how much it rises,
    (times, cells). flat: cells on which it does not; None if there are none."""

    low: Array
    rise: Array
    flat: NDArray[np.bool_] | None

    @classmethod
    def of(cls, g: Array) -> "_Ends":
        """Of values g (times, cells + 1) at the ends of the cells."""
        low = np.minimum(g[:, 1:], g[:, :-1])
        rise = np.maximum(g[:, 1:], g[:, :-1]) - low
        flat = rise == 0
        return cls(low, rise, flat if flat.any() else None)

    def part_below(self, level: Array) -> Array:
        """Part of each cell where the function is <= level, (times, cells); level (times, 1)."""
        part = level - self.low
        with np.errstate(divide="ignore", invalid="ignore"):
            part /= self.rise
        np.maximum(part, 0, out=part)
        np.minimum(part, 1, out=part)
        return part if self.flat is None else np.where(self.flat, level >= self.low, part)

    def weight_below(self, level: Array, weight: Array) -> Array:
        """Sum of the weights (times, cells) of what is below a level (times,)."""
        return np.einsum("tc,tc->t", weight, self.part_below(level[:, None]))


def _weighted_quantile(g: Array, weight: Array, share: float = 0.5) -> tuple[Array, Array]:
    """Level with that share of the weight below, and part of each cell below it, for every time.

    The weight below a level is linear between neighbours of the sorted samples: bisect for the
    neighbours, then interpolate. It jumps where a cell is flat.
    """
    rows, ends = np.arange(g.shape[0]), _Ends.of(g)
    ordered, wanted = np.sort(g, axis=1), share * weight.sum(axis=1)
    below, above = np.zeros(rows.size, int), np.full(rows.size, g.shape[1] - 1)
    while np.any(above - below > 1):
        middle = (below + above) // 2
        enough = ends.weight_below(ordered[rows, middle], weight) >= wanted
        below, above = np.where(enough, below, middle), np.where(enough, middle, above)
    low, high = ordered[rows, below], ordered[rows, above]
    at_low = ends.weight_below(low, weight)
    sloping = (
        weight if ends.flat is None else np.where(ends.flat & (ends.low == high[:, None]), 0, weight)
    )
    at_high = ends.weight_below(high, sloping)
    gain = np.where(at_high > at_low, at_high - at_low, np.inf)
    level = low + (high - low) * np.clip((wanted - at_low) / gain, 0, 1)
    level = np.where((at_low < wanted) & (wanted < at_high), level, high)
    return level, ends.part_below(level[:, None])


def _at_level(g: Array, level: Array) -> Array:
    """Part of the body per unit of g at a level, by cell, (times, cells); infinite on a flat cell."""
    low, high = np.minimum(g[:, 1:], g[:, :-1]), np.maximum(g[:, 1:], g[:, :-1])
    at = level[:, None]
    with np.errstate(divide="ignore"):
        there = (low < at) & (at <= high) | (low == high) & (low == at)
        return np.where(there, 1 / (high - low), 0) / low.shape[1]


def _dry_coefficients(
    c: Array, rate: Array, growth: Piece, share: float, mu: Array
) -> tuple[Array, Array]:
    """Of V = V1 alpha + V2 alpha^2, as in the module's head, each (times,); mu: (times, cells)."""
    g, mean_growth = _less_mean(rate), _middle(c)
    level, below = _weighted_quantile(g, mu / mu.shape[1], share)
    density = mu * _at_level(g, level)
    weighed = np.mean(mu * mean_growth * (below - share), axis=1) / density.sum(axis=1)
    second = growth.power * weighed
    if growth.curvature:
        second = second - growth.curvature * _mean_at(_less_mean(2 * c * rate), g, level, density)
    return -level, second


def _mean_at(values: Array, g: Array, level: Array, density: Array) -> Array:
    """Mean of linear values over the places where g meets a level, (times,): where flat, over flats."""
    flat = np.isinf(density)
    share = np.where(flat.any(axis=1, keepdims=True), flat, density)
    with np.errstate(divide="ignore", invalid="ignore"):
        place = np.where(flat, 0.5, (level[:, None] - g[:, :-1]) / np.diff(g, axis=1))
    here = values[:, :-1] + np.where(share > 0, place, 0.0) * np.diff(values, axis=1)
    return np.asarray(np.sum(share * here, axis=1) / share.sum(axis=1))


def _viscous_coefficients(c: Array, rate: Array, growth: Piece, mu: Array) -> tuple[Array, Array]:
    """Of alpha and alpha^2: minus the mean of v weighted with mu (1 + p alpha c), each (times,)."""
    share = mu / mu.sum(axis=1, keepdims=True)

    def mean(values: Array) -> Array:
        return np.asarray(np.sum(share * values, axis=1))

    g, middle = _middle(_less_mean(rate)), _middle(c)
    level = mean(g)
    second = -growth.power * mean(middle * (g - level[:, None]))
    if growth.curvature and np.ptp(mu) > 0:  # else v_2 has no mean
        second = second - growth.curvature * mean(_middle(_less_mean(2 * c * rate)))
    return -level, second


def _regularised_speed(velocity: Array, weight: Array, law: FrictionLaw, guess: Array) -> Array:
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
