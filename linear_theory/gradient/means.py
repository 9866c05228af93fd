"""Means over a period of derivatives along directions, with their errors.

The cells of a balance over a period are frozen. A derivative along a direction has a value at every
time: its mean is taken by the rule for that of V, with the same estimate of its error, and times are
added where that is too large. What finer cells and higher degrees of the deformation change at three
times is the error of the rest.

Harmonics that the wave does not have may be shorter than the cells of its balance. Where friction is
smooth, the weights of its adjoint are as long as the wave itself, and polynomials in each cell of these
(`sensitivity.Wanted.exact`); where finer cells say otherwise, the cells are made as short as the
harmonics.

V of a wave with c(t + T/2) = -c(t) is of second order in alpha, as the leading q_0 has no mean,
exactly; nor has its derivative along a direction that keeps this symmetry: it is left out there.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance import crawl as limits
from linear_theory.balance.course import Course
from linear_theory.balance.crawl import Crawl, Known
from linear_theory.balance.rigid_motion import RigidMotion
from linear_theory.balance.time_grid import TimeGrid
from linear_theory.deformation.ritz import RitzField
from linear_theory.deformation.ritz import error as ritz_error
from linear_theory.deformation.ritz.solver import RitzSolver
from linear_theory.gradient.adjoint import LawChange
from linear_theory.gradient.along import along
from linear_theory.gradient.direction import Direction
from linear_theory.gradient.quantity import Quantity
from linear_theory.gradient.sensitivity import Linearised, MapChange, Wanted, sensitivities

Array = NDArray[np.float64]

CHECKED = 0.07, 0.41, 0.77
"""Shares of the times at which finer cells and higher degrees are tried."""

MORE_DEGREES = 8
"""By which the deformation is finer there."""

SAFETY = 2.0
"""Of the largest change there, for the mean over all times."""

MOST_REFINEMENTS = 2

PER_HARMONIC = 2.5
"""Times per period of the highest harmonic of the directions at first, enough for its error to show."""

AGREE = 0.1
"""Of the tolerance: what finer cells may change, if those of the wave are to be enough."""

MORE_POINTS = 4
"""Per cell and direction, if cells are longer than the harmonics."""

COARSE = 3e-2
"""Tolerance by which the deformation resolves harmonics that the wave does not have."""


class Means(NamedTuple):
    """Derivatives (k, directions) of the means of quantities per unit alpha, and their errors.

    flat: whether at some time there is a motion that friction does not resist.
    """

    values: Array
    errors: Array
    flat: bool


@dataclass(frozen=True)
class Derivatives:
    """Of quantities along directions, for a course of motion.

    rtol: largest error of a mean that is aimed at, over the root mean square of the derivative in time.
    """

    course: Course
    directions: Sequence[Direction]
    quantities: Sequence[Quantity]
    rtol: float

    def means(self) -> Means:
        """Over the period."""
        course = self.course
        some = np.unique((np.array(CHECKED) * course.grid.times.size).astype(int))
        checks = course.grid.times[some], _some(course.motion, some)
        crawl, finer = self._sufficient(checks)
        times, values, flat = self._resolved(crawl)
        means, errors = TimeGrid(times).means(values.reshape(-1, times.size))
        change = abs(finer - values[..., np.searchsorted(times, checks[0])]).max(-1)
        shape = values.shape[:2]
        return Means(means.reshape(shape), errors.reshape(shape) + SAFETY * change, flat)

    def _sufficient(self, checks: tuple[Array, RigidMotion]) -> tuple[Crawl, Array]:
        """With the cells of the wave if they are enough, else with those of all harmonics.

        Second: derivatives at the checks with finer ones.
        """
        if self._shorter and self.course.crawl.contact.friction.width > 0:
            values, finer = (self._at(one, *checks)[0] for one in (self._long, _finer(self._long)))
            change = abs(finer - values).max(-1).ravel()
            if np.all(change <= AGREE * self.rtol * self._sizes(finer)):
                return self._long, finer
        return self._short, self._at(_finer(self._short), *checks)[0]

    def _resolved(self, crawl: Crawl) -> tuple[Array, Array, bool]:
        """Times, and derivatives there, (k, directions, T), with times added as needed."""
        course = self.course
        if self._highest:
            step = crawl.drive.period / (PER_HARMONIC * self._highest)
            course = course.on(course.grid.with_steps(step))
        values, flat = self._at(crawl, course.grid.times, course.motion)
        for _ in range(MOST_REFINEMENTS):
            grid, added = self._refined(course.grid, values)
            if not added.any() or grid.times.size > limits.MOST_TIMES or not crawl.affords(grid.times):
                break
            known = Known(course.grid.times, course.motion)
            more = crawl.balance(grid.times[added], known)
            others, also = self._at(crawl, grid.times[added], more)
            course = replace(course, grid=grid, motion=course.motion.joined(more, added))
            whole = np.empty((*values.shape[:2], added.size))
            whole[..., ~added], whole[..., added] = values, others
            values, flat = whole, flat or also
        return course.grid.times, values, flat

    def _refined(self, grid: TimeGrid, values: Array) -> tuple[TimeGrid, NDArray[np.bool_]]:
        """With more times where the error of a mean is too large."""
        flat, size = values.reshape(-1, grid.times.size), self._sizes(values)
        poor = grid.means(flat)[1] > self.rtol * size
        if not poor.any():
            return grid, np.zeros(grid.times.size, bool)
        return grid.refined(flat[poor] / size[poor, None], self.rtol)

    def _sizes(self, values: Array) -> Array:
        """Of derivatives in time, (k directions,); the largest of all harmonics for each of these."""
        size = np.sqrt(np.mean(values**2, axis=-1))
        waves = np.array([bool(one.harmonics) for one in self.directions])
        if waves.any():
            size[:, waves] = size[:, waves].max(1, keepdims=True)
        return np.maximum(size, np.finfo(float).tiny).ravel()

    def _at(self, crawl: Crawl, times: Array, motion: RigidMotion) -> tuple[Array, bool]:
        """Derivatives at times (T,), (k, directions, T), and whether friction resists all motions."""
        own = self.course.crawl
        near = crawl is not own
        whole = Linearised(motion.leading + crawl.alpha * motion.remainder, crawl.alpha, near)
        first = Linearised(motion.leading, 0.0, near)
        aside = bool(self._without_leading.any())
        wanted = self._wanted
        if self._shorter and not crawl.waves:
            assert isinstance(own.field, RitzField)
            wanted = wanted._replace(exact=own.field.degree[1])
        at, *others = sensitivities(crawl, times, [whole, first] if aside else [whole], wanted)
        found = along(at, times, self.directions, crawl)
        for other in others:
            part = along(other, times, self.directions, crawl)
            found -= np.where(self._without_leading[..., None], part, 0.0)
        return found, bool(at.flat.any())

    @cached_property
    def _long(self) -> Crawl:
        """That of the course, whose deformation resolves the harmonics of the directions, too.

        Its cells stay as long as the own wave asks for, with more points.
        """
        crawl, field = self.course.crawl, self.course.crawl.field
        if not self._shorter:
            return crawl
        assert isinstance(field, RitzField)
        least = ritz_error.first_degrees(field.sheet, math.ceil(self._wanted.waves), COARSE)
        across, along = (max(pair) for pair in zip(least, field.degree, strict=True))
        if (across, along) != field.degree:
            field = RitzField(field.drive, RitzSolver(field.sheet, (across, along)))
        sharper = replace(crawl.resolution, order=crawl.resolution.order + MORE_POINTS)
        return replace(crawl, field=field, resolution=sharper)

    @cached_property
    def _short(self) -> Crawl:
        """With cells that resolve them, too."""
        if not self._shorter:
            return self.course.crawl
        waves = math.ceil(self._wanted.waves / 2)
        return replace(self._long, resolution=self.course.crawl.resolution, waves=waves)

    @cached_property
    def _shorter(self) -> bool:
        """Whether directions have harmonics that the wave has not."""
        series = self.course.crawl.drive.series
        return series is not None and self._highest > series.harmonics[-1]

    @cached_property
    def _highest(self) -> int:
        """The highest harmonic of the directions."""
        return max((one.highest for one in self.directions), default=0)

    @cached_property
    def _wanted(self) -> Wanted:
        crawl, directions = self.course.crawl, self.directions
        alpha, mirrored = crawl.alpha, crawl.mirrored
        return Wanted(
            self.quantities,
            sheet=any(d.width or d.poisson for d in directions),
            across=any(d.growth is not None and d.growth.across for d in directions),
            waves=self._highest * abs(getattr(crawl.drive.wave, "count", 1)),
            laws=law_changes(directions, alpha, mirrored),
            maps=[MapChange(*d.map, mirrored) for d in directions if d.map is not None],
        )

    @cached_property
    def _without_leading(self) -> NDArray[np.bool_]:
        """Of which motions, and along which directions, q_0 keeps no mean, (k, directions)."""
        crawl = self.course.crawl
        second = crawl.starts_at_second_order
        kept = np.array([second and d.keeps_sign(crawl.drive) for d in self.directions], bool)
        return np.array([kept & (one.work == 0) for one in self.quantities])


def law_changes(directions: Sequence[Direction], alpha: float, mirrored: bool) -> list[LawChange]:
    """Of the directions that change the law, for velocities per unit of that alpha."""
    return [
        LawChange(d.law.ahead.per(alpha), d.law.behind.per(alpha), d.law.apart, mirrored)
        for d in directions
        if d.law is not None
    ]


def _some(motion: RigidMotion, which: Array) -> RigidMotion:
    return motion._replace(leading=motion.leading[which], remainder=motion.remainder[which])


def _finer(crawl: Crawl) -> Crawl:
    """With finer cells and a deformation of higher degree."""
    field = crawl.field
    assert isinstance(field, RitzField)
    across, along = (d + MORE_DEGREES for d in field.degree)
    finer = RitzField(field.drive, RitzSolver(field.sheet, (across, along)))
    return replace(crawl, field=finer, resolution=crawl.resolution.finer())
