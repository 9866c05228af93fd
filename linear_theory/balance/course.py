"""The motion of a sheet at sampling times, and the error from what happens between them.

The quadrature in time estimates its error from differences of the motion on its grid. It misses
harmonics of the wave that alias to lower ones on the grid, but these are known from the wave. Where
aliased harmonics can matter, the motion is also computed at random times: for any wave, the expected
deviation from the grid's interpolating polynomials is the error of the grid's mean.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.crawl import Crawl, Known
from linear_theory.balance.rigid_motion import RigidMotion
from linear_theory.balance.time_grid import TimeGrid

Array = NDArray[np.float64]

CHECKS, SEED = 16, 7
"""Number of random times at which a motion is checked."""

HIDDEN = 0.1
"""Fraction of the tolerance of the quadrature in time; aliased harmonics above it are checked."""


@dataclass(frozen=True)
class Course:
    """The motion at the times of a grid; checks: the motion at random times off the grid.

    hides: whether the error from aliased harmonics may exceed the tolerance.
    """

    crawl: Crawl
    grid: TimeGrid
    motion: RigidMotion
    checks: RigidMotion | None = None
    hides: bool = False

    @property
    def mean(self) -> Array:
        """Means of V_x, V_y, Omega, of the orders that are counted, (3,)."""
        return self.grid.means(self.crawl.counted(self.motion))[0]

    def error(self) -> Array:
        """Estimated errors of `mean`, (3,)."""
        seen = self.grid.means(self.crawl.counted(self.motion))[1]
        if self.checks is None:
            return np.asarray(seen + self.crawl.norm.each(self._hidden))
        counted = (self.crawl.counted(m) for m in (self.motion, self.checks))
        return np.maximum(seen, self._off(*counted))

    def means(self) -> tuple[Array, Array]:
        """Means of q_0 and q_1, (2, 3), and their errors; 0 where a mean vanishes by symmetry."""
        orders = _orders(self.motion)
        means, errors = np.stack([self.grid.means(order) for order in orders], axis=1)
        if self.checks is not None:
            errors = np.maximum(errors, self._off(orders, _orders(self.checks)))
        else:
            drive = self.crawl.drive
            rate = drive.hidden(self.grid.longest_step)
            speeds = (rate * drive.speed_per_rate(1.0, leading) for leading in (True, False))
            errors = errors + np.stack([self.crawl.norm.each(speed) for speed in speeds])
        if self.crawl.starts_at_second_order:
            means[0] = errors[0] = 0.0
        return means, errors

    def works(self) -> tuple[Array, Array]:
        """Means of the rates of work p_0 and p_1 (see `Balance.works`), (2,), and their errors."""
        rates = self.motion.works[:, :2].T
        means, errors = self.grid.means(rates)
        if self.checks is not None:
            return means, np.maximum(errors, self._off(rates, self.checks.works[:, :2].T))
        drive = self.crawl.drive
        return means, errors + drive.hidden(self.grid.longest_step) * drive.speed_per_rate(1.0, True)

    def improved(self, tolerance: float) -> tuple["Course", TimeGrid | None]:
        """This course, with checks where needed, and the finer grid that the tolerance requires.

        The grid is None where the tolerance is met, or where the smallest larger tolerance that an
        affordable number of times can resolve is met.
        """
        crawl, norm = self.crawl, self.crawl.norm
        speeds, goal = norm.speeds(crawl.counted(self.motion)), self._within_reach(tolerance)
        course = replace(self, hides=self._hidden > HIDDEN * tolerance)
        if self.grid.error(speeds) > goal:
            return course, self.grid.refined(speeds, goal)[0]
        if self._hidden <= HIDDEN * goal:
            return course, None
        course = course.checked()
        if norm.size(course._between) <= goal:
            return course, None
        times = self._times(goal)
        step = crawl.drive.period / times if math.isfinite(times) else self.grid.longest_step / 2
        return course, self.grid.with_steps(step)

    def _within_reach(self, tolerance: float) -> float:
        """The tolerance, doubled until an affordable number of times resolves the wave, if any does."""
        fewest = self._times(math.inf)
        while fewest < (times := self._times(tolerance)) < math.inf and not self.crawl.reaches(times):
            tolerance *= 2
        return tolerance

    def _times(self, tolerance: float) -> float:
        """Equidistant times per period such that aliased harmonics do not matter; inf if unknown."""
        unit = self.crawl.speed_per_rate
        return self.crawl.drive.times_for(HIDDEN * tolerance / unit if unit > 0 else math.inf)

    def on(self, grid: TimeGrid) -> "Course":
        """The motion on a grid with more times."""
        added = ~np.isin(grid.times, self.grid.times)
        if not added.any():
            return self
        more = self.crawl.balance(grid.times[added], Known(self.grid.times, self.motion))
        return replace(self, grid=grid, motion=self.motion.joined(more, added))

    def checked(self) -> "Course":
        """This course with the motion at random times, unless that is known or not needed."""
        if not self.hides or self.checks is not None:
            return self
        known = Known(self.grid.times, self.motion)
        return replace(self, checks=self.crawl.balance(self._check_times, known))

    @property
    def _hidden(self) -> float:
        """Largest V from the harmonics of the wave that alias to lower ones on the grid."""
        return self.crawl.speed_per_rate * self.crawl.drive.hidden(self.grid.longest_step)

    @property
    def _between(self) -> Array:
        """Error of the mean estimated from the checks, (3,)."""
        assert self.checks is not None
        return self._off(*(self.crawl.counted(m) for m in (self.motion, self.checks)))

    def _off(self, values: Array, checks: Array) -> Array:
        """Error of means of values (..., grid times), from values at the random times.

        The mean deviation from the polynomials plus twice the standard deviation of that mean.
        """
        off = checks - self.grid.interpolated(values, self._check_times)
        return np.asarray(abs(off.mean(-1)) + 2 * off.std(-1) / math.sqrt(CHECKS))

    @property
    def _check_times(self) -> Array:
        start, end = self.grid.times[[0, -1]]
        return np.asarray(
            start + (end - start) * np.sort(np.random.default_rng(SEED).uniform(size=CHECKS))
        )


def _orders(motion: RigidMotion) -> Array:
    """q_0 and q_1, (2, 3, times)."""
    return np.stack([motion.leading.T, motion.remainder.T])
