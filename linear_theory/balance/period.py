"""The rigid motion of a sheet over one period, and its mean with an error estimate."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance import crawl as limits
from linear_theory.balance.course import Course
from linear_theory.balance.crawl import CellErrors, Crawl, Known
from linear_theory.balance.rigid_motion import RigidMotion
from linear_theory.balance.time_grid import TimeGrid, first_grid
from linear_theory.common.estimate import Estimate
from linear_theory.common.tolerance import Tolerance

Array = NDArray[np.float64]

_STICKING = 0.01  # share of the sheet at rest that counts as sticking


class Works(NamedTuple):
    """Rates of work p_0 and p_1 of friction per unit |alpha| (see `Balance.works`) and load at rest.

    rates (2, T) at the times of a `Period`; means, errors (2,): over the period.
    """

    rates: Array
    means: Array
    errors: Array

    def at(self, alpha: float) -> tuple[Estimate, Array]:
        """The mean power over mu times the weight, length/time, and its course (T,)."""
        orders = abs(alpha) * np.array([1.0, alpha])
        mean = Estimate(float(orders @ self.means), float(abs(orders) @ self.errors))
        return mean, np.asarray(orders @ self.rates)


class Period(NamedTuple):
    """One period of motion.

    times (T,); orders (2, 3, T): V_x, V_y, Omega of q_0 and q_1; rigid (3, T): of both together;
    rigid_mean, rigid_error (3,): means of `rigid` and their estimated errors, absolute; means,
    mean_errors (2, 3): means of `orders` and their errors from times and cells;
    fastest: the largest speed relative to the ground; sticks: whether part of the sheet is at rest at
    some time; works: rates of work of friction.
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
    works: Works

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


class Resolved(NamedTuple):
    """The motion over a period, resolved in time, with the errors of its cells."""

    course: Course
    cells: CellErrors

    def period(self) -> Period:
        """The means of the motion and their errors."""
        course, cells = self.course, self.cells
        crawl, grid, motion = course.crawl, course.grid, course.motion
        means, errors = course.means()
        powers, power_errors = course.works()
        field_error = crawl.norm.each(crawl.field_error(motion))
        times, orders = _whole_period(
            crawl, grid.times, np.stack([motion.leading.T, motion.remainder.T])
        )
        rates = _whole_period(crawl, grid.times, motion.works[:, :2].T)[1]
        return Period(
            times=times,
            orders=orders,
            rigid=crawl.alpha * (orders[0] + crawl.alpha * orders[1]),
            rigid_mean=course.mean,
            rigid_error=course.error() + cells.counted + field_error + 1e-13 * abs(course.mean),
            means=means,
            mean_errors=errors + cells.orders,
            fastest=abs(crawl.alpha) * motion.fastest,
            sticks=bool(motion.rest.max() > _STICKING),
            works=Works(rates, powers, power_errors + cells.works + crawl.work_errors(motion)),
        )


def resolved(crawl: Crawl, tolerance: Tolerance) -> Resolved:
    """The motion over a period, with as many times and as fine cells as the tolerance requires.

    Refinement stops at the work limit; the error then stays above the tolerance. Raises ValueError for
    a wave that does not repeat after its period, or whose rate is not its derivative.
    """
    crawl.drive.check()
    grid = _first_grid(crawl)
    crawl, motion, cells = _with_fine_cells(crawl, grid.times, tolerance)
    return Resolved(_with_enough_times(Course(crawl, grid, motion), tolerance), cells)


def average(crawl: Crawl, tolerance: Tolerance) -> Period:
    """Rigid motion over a period and its means, see `resolved`."""
    return resolved(crawl, tolerance).period()


def _with_enough_times(course: Course, tolerance: Tolerance) -> Course:
    """Add times until their error meets its share of the tolerance or the work limit is reached."""
    crawl = course.crawl
    while True:
        course, finer = course.improved(0.5 * crawl.norm.allowed(course.mean, tolerance))
        if (
            finer is None
            or course.grid.times.size > limits.MOST_TIMES
            or not crawl.affords(finer.times)
        ):
            return course.checked()
        course = course.on(finer)


def _with_fine_cells(
    crawl: Crawl, times: Array, tolerance: Tolerance
) -> tuple[Crawl, RigidMotion, CellErrors]:
    """Refine the cells until they meet their share of the tolerance at the first times."""
    known = None
    for last in (False, False, True):
        motion = crawl.balance(times, known)
        errors = crawl.quadrature_errors(times, motion)
        goal = 0.3 * crawl.norm.allowed(crawl.counted(motion).mean(1), tolerance)
        finer = replace(crawl, resolution=crawl.resolution.finer())
        if last or crawl.norm.size(errors.counted) <= goal or not finer.affords(times):
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
