"""Friction balance of any wave c(S, t) on a line, from samples.

Eqs 5 and 6 with the stretch s(alpha c) give the velocity in the frame of the mean motion, alpha g,
g = int_0^S s'(alpha c) c_t dS' less its mean; eq. 7 is balanced at every time by

    V(t) = -alpha m,   m the median of g over the body, weighted with s^p (see `growth`)   (dry)

or by the root of a law with a width. Of friction with a direction m is the quantile at the share of the
weight that must slip one way, mu_f/(mu_f + mu_b) for alpha > 0 (`line.share`). Here s' c_t is linear
between equidistant points, as is g, and the weight constant there: every step after that is exact, so
the error falls with the square of the spacing, and samples and times are doubled until the last change
meets the tolerance.
"""

import math
from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.estimate import Estimate
from linear_theory.common.tolerance import Tolerance
from linear_theory.friction.law import FrictionLaw
from linear_theory.line.piece import Piece
from linear_theory.line.result import REST_PART, LineMotion
from linear_theory.line.roots import EPS
from linear_theory.line.samples.snapshot import Snapshot, snapshots
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

COARSE_CELLS, COARSE_SHARE = 128, 0.1
"""Cells of `coarse_means` at least, and the share of c that they may miss."""


def sampled_balance(
    drive: Drive, alpha: float, law: FrictionLaw, growth: Piece, tolerance: Tolerance
) -> LineMotion:
    """Speed of a general wave, the length of the body being 1 in the law, the tolerance and the result.

    Raises ValueError if a sampled strain is out of the range of the law, and for a wave that does not
    repeat after its period or whose rate is not its derivative.
    """
    drive.check()
    sampled, period = partial(snapshots, drive.fine, alpha, law, growth), drive.period
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
    found = snapshots(drive, alpha, law, growth, times, cells)
    return np.array([found.velocity.mean(), found.power.mean()])


def speeds_at(
    drive: Drive, alpha: float, law: FrictionLaw, growth: Piece, times: Array, cells: int
) -> Array:
    """Speeds at given times, also of a wave that does not repeat, the length of the body being 1."""
    return snapshots(drive, alpha, law, growth, times, cells).velocity


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
