"""The rigid motion of a sheet over one period, and its mean with an error estimate."""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.balance import Balance, RigidMotion
from linear_theory.balance.course import Course, Known
from linear_theory.balance.load_check import check_load
from linear_theory.balance.time_grid import TimeGrid, first_grid
from linear_theory.common.progress import track
from linear_theory.common.tolerance import Tolerance
from linear_theory.deformation.field import LinearField
from linear_theory.friction.contact import Contact
from linear_theory.friction.load import Load
from linear_theory.motion.motion import CellGrid, Motion
from linear_theory.motion.rigid import RigidNorm
from linear_theory.wave.protocol import Drive

Array = NDArray[np.float64]

_MOST_TIMES = 4096
_MOST_WORK = 8_000_000  # work at all times together (see `Crawl.work`), some tens of seconds
_LOT = 10_000  # points per batch; halving of cells makes ten times as many, which fit in the cache
_STICKING = 0.01  # fraction of the sheet at rest that counts as sticking


class Period(NamedTuple):
    """One period of motion.

    times (T,); orders (2, 3, T): V_x, V_y, Omega of q_0 and q_1; rigid (3, T): of both together;
    rigid_mean, rigid_error (3,): means of `rigid` and their estimated errors, absolute; means,
    mean_errors (2, 3): means of `orders` and their errors from times and cells;
    fastest: the largest speed relative to the ground; sticks: whether part of the sheet is at rest at
    some time.
    """

    times: Array
    orders: Array
    rigid: Array
    rigid_mean: Array
    rigid_error: Array
    means: Array
    mean_errors: Array
    fastest: float
    sticks: bool

    @property
    def mean(self) -> float:
        """Mean of V_y."""
        return float(self.rigid_mean[1])

    @property
    def error(self) -> float:
        """Estimated error of `mean`, absolute."""
        return float(self.rigid_error[1])

    @property
    def first_order(self) -> float:
        """V_1 in mean = V_1 alpha + O(alpha^2)."""
        return float(self.means[0, 1])


@dataclass(frozen=True)
class Resolution:
    """Cells per wave, Gauss points per cell and direction, halvings, tolerance of q."""

    density: float
    order: int
    halvings: int
    tolerance: float

    def finer(self) -> "Resolution":
        """The next finer resolution, for error estimates and for refinement."""
        return Resolution(1.5 * self.density, self.order + 1, self.halvings + 6, 0.1 * self.tolerance)


def first_resolution(rtol: float) -> Resolution:
    """Four cells per wave, halved until the cell at a stagnation point has an area of about rtol^1.6.

    Near such a point the integrand of the remainder behaves like 1/distance, so that the error falls
    like the square root of the area of the last cell.
    """
    digits = -math.log10(rtol)
    order = min(max(math.ceil(2.5 + 0.8 * digits), 5), 14)
    return Resolution(4.0, order, max(math.ceil(5.3 * digits - 7), 2), 0.02 * rtol)


@dataclass(frozen=True)
class Crawl:
    """A crawling sheet (field, growth coupling, contact) and the resolution of its balance."""

    field: LinearField
    alpha: float
    contact: Contact
    resolution: Resolution

    @property
    def drive(self) -> Drive:
        """The wave on the sheet."""
        return self.field.drive

    @property
    def starts_at_second_order(self) -> bool:
        """Whether c(t + T/2) = -c(t), so that the leading q_0 has exactly no mean."""
        return self.drive.changes_sign

    @property
    def counts_leading(self) -> bool:
        """Whether q_0 is part of the counted motion."""
        return not self.starts_at_second_order

    def balance(self, times: Array, known: "Known | None" = None) -> RigidMotion:
        """Rigid motion at the given times, in batches; known: the motion at other times, as a guess."""
        lot = max(_LOT // self._motion(times[:1]).area.size, 1)
        lots = []
        for i in track("friction balance over the period", range(0, times.size, lot)):
            some = times[i : i + lot]
            lots.append(self._balance(some).solve(known and known.between(some)))
        leading, remainder, rest, fastest = zip(*lots, strict=True)
        return RigidMotion(
            np.concatenate(leading), np.concatenate(remainder), np.concatenate(rest), max(fastest)
        )

    @property
    def reversal_time(self) -> float | None:
        """t_0 with V(t_0 - t) = V(t), where the wave and the sheet have that symmetry."""
        return self.drive.reversal_time if self.field.mirrored else None

    @cached_property
    def work(self) -> int:
        """Work per time: points of the balance plus unknowns of the deformation solved for."""
        return int(self._motion(np.zeros(1)).area.size) + self.field.numbers

    def affords(self, times: Array) -> bool:
        """Whether the balance at these times is within the work limit."""
        return self.work * times.size <= _MOST_WORK

    def reaches(self, count: float) -> bool:
        """Whether a number of times is within the work limit."""
        return count <= min(_MOST_TIMES, _MOST_WORK / self.work)

    @property
    def speed_per_rate(self) -> float:
        """Largest counted V for dc/dt of root mean square 1."""
        return self.drive.speed_per_rate(self.alpha, self.counts_leading)

    @property
    def norm(self) -> RigidNorm:
        """The norm of motions and of their errors."""
        return RigidNorm(self.field.gyration, self.field.mirrored)

    def counted(self, motion: RigidMotion) -> Array:
        """V_x, V_y, Omega at each time, without terms whose mean vanishes by symmetry, (3, times)."""
        second = self.alpha**2 * motion.remainder.T
        return self.alpha * motion.leading.T + second if self.counts_leading else second

    def quadrature_errors(self, times: Array, motion: RigidMotion) -> tuple[Array, Array]:
        """Largest change of the counted motion (3,) and of q_0, q_1 (2, 3) on finer cells.

        From one Newton step at three times; 0 for a q_0 without a mean.
        """
        some = np.unique((np.array([0.07, 0.41, 0.77]) * times.size).astype(int))
        finer = replace(self, resolution=self.resolution.finer())
        step = finer._balance(times[some]).correction(motion.leading[some], motion.remainder[some])
        orders = abs(np.stack([step.leading, step.remainder])).max(1)
        if self.starts_at_second_order:
            orders[0] = 0.0
        return abs(self.counted(step)).max(1), orders

    def field_error(self, motion: RigidMotion) -> float:
        """Error of V_x, V_y and g Omega each (see `RigidNorm`) due to the error of the deformation.

        The missing short waves alternate in sign and nearly cancel in the balance: the factors measured
        for widths from 0.1 L to 2 L are at most 0.05 (sines) and 0.004 (pulses), against 0.2 and 0.02
        used here.
        """
        speed = self.field.error * abs(self.alpha) * motion.fastest
        by_load = 0.0 if self.contact.load is Load.MATERIAL else 0.4 * abs(self.alpha)
        return speed * (by_load + (0.0 if self.starts_at_second_order else 0.02))

    def _motion(self, times: Array) -> Motion:
        field, r = self.field, self.resolution
        across, along = self.drive.short_waves
        grid = CellGrid.graded(field.sheet, along, r.density, field.mirrored, across)
        return field.motion(times, grid, r.order)

    def _balance(self, times: Array) -> Balance:
        motion, r = self._motion(times), self.resolution
        rate = self.contact.load.rate(motion.dilation, motion.growth)
        check_load(motion, rate, self.alpha)
        law = self.contact.friction.scaled(abs(self.alpha))
        return Balance(motion, rate, self.alpha, law, r.halvings, r.tolerance)


def average(crawl: Crawl, tolerance: Tolerance) -> Period:
    """Rigid motion over a period, with as many times and as fine cells as the tolerance requires.

    Refinement stops at the work limit; the error then stays above the tolerance. Raises ValueError for
    a wave that does not repeat after its period, or whose rate is not its derivative.
    """
    crawl.drive.check()
    grid = _first_grid(crawl)
    crawl, motion, (quadrature_error, quadrature_errors) = _with_fine_cells(
        crawl, grid.times, tolerance
    )
    course = _with_enough_times(Course(crawl, grid, motion), tolerance)
    grid, motion = course.grid, course.motion
    means, errors = course.means()
    field_error = crawl.norm.each(crawl.field_error(motion))
    times, orders = _whole_period(crawl, grid.times, np.stack([motion.leading.T, motion.remainder.T]))
    return Period(
        times=times,
        orders=orders,
        rigid=crawl.alpha * (orders[0] + crawl.alpha * orders[1]),
        rigid_mean=course.mean,
        rigid_error=course.error() + quadrature_error + field_error + 1e-13 * abs(course.mean),
        means=means,
        mean_errors=errors + quadrature_errors,
        fastest=abs(crawl.alpha) * motion.fastest,
        sticks=bool(motion.rest.max() > _STICKING),
    )


def _with_enough_times(course: Course, tolerance: Tolerance) -> Course:
    """Add times until their error meets its share of the tolerance or the work limit is reached."""
    crawl = course.crawl
    while True:
        course, finer = course.improved(0.5 * crawl.norm.allowed(course.mean, tolerance))
        if finer is None or course.grid.times.size > _MOST_TIMES or not crawl.affords(finer.times):
            return course.checked()
        course = course.on(finer)


def _with_fine_cells(
    crawl: Crawl, times: Array, tolerance: Tolerance
) -> tuple[Crawl, RigidMotion, tuple[Array, Array]]:
    """Refine the cells until they meet their share of the tolerance at the first times."""
    known = None
    for last in (False, False, True):
        motion = crawl.balance(times, known)
        errors = crawl.quadrature_errors(times, motion)
        goal = 0.3 * crawl.norm.allowed(crawl.counted(motion).mean(1), tolerance)
        finer = replace(crawl, resolution=crawl.resolution.finer())
        if last or crawl.norm.size(errors[0]) <= goal or not finer.affords(times):
            break
        crawl, known = finer, Known(times, motion)
    return crawl, motion, errors


def _first_grid(crawl: Crawl) -> TimeGrid:
    """A period, or half of one where V(t_0 - t) = V(t) gives the other half."""
    period, reversal = crawl.drive.period, crawl.reversal_time
    if reversal is None:
        return first_grid(0.0, period, 5)
    return first_grid(reversal / 2, reversal / 2 + period / 2, 3)


def _whole_period(crawl: Crawl, times: Array, values: Array) -> tuple[Array, Array]:
    """Times (T,) and values (..., T) over one period, without its end."""
    if crawl.reversal_time is None:
        return times[:-1], values[..., :-1]
    back = slice(-2, 0, -1)
    whole = np.concatenate([values, values[..., back]], -1)
    return np.concatenate([times, 2 * times[-1] - times[back]]), whole
