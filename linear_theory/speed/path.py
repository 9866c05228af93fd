"""The path of a sheet that crawls and turns: the rigid motion of one period, repeated.

The body frame moves and turns with the sheet as a whole. Its origin is the centre of mass of the sheet
and its axes are oriented so that the mean rotation is zero, with means over the undeformed area: for
small strains that of (du_y/dx - du_x/dy)/2, else the rotation of the mean deformation gradient.
`CrawlSpeed.rigid` is the velocity of the origin along these axes and their rate of rotation,

    dX/dt = R(theta) (V_x, V_y),   dtheta/dt = Omega.

One period moves the frame by d, in its axes at the start of the period, and turns it by phi. After n
periods it is, in complex numbers x + i y, at

    z_n = d (1 + q + ... + q^(n - 1)) = d (1 - q^n)/(1 - q),   q = exp(i phi),

on a circle of radius |d|/(2 sin(phi/2)). d is not T times the mean of V: a sheet that oscillates at
order alpha both in position and in heading advances by order alpha^2 from that alone.
"""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.time_grid import TimeGrid
from linear_theory.common import validation
from linear_theory.common.tables import LENGTH, RADIANS, TIME, Column, Tabular
from linear_theory.common.threads import one_blas_thread
from linear_theory.speed.result import CrawlSpeed

if TYPE_CHECKING:
    from scipy.interpolate import CubicHermiteSpline

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

SAME = 1e-6
"""Relative difference below which time steps count as equal, the roundoff of times."""

_NODES = np.arange(5.0)
_POWERS = np.arange(5)
_CUMULATIVE = (_NODES[:, None] ** (_POWERS + 1) / (_POWERS + 1)) @ np.linalg.inv(
    _NODES[:, None] ** _POWERS
)
"""Integrals from the first of five equidistant nodes to each, by the quartic through them; Boole's rule
in the last row. Step 1."""


@dataclass(frozen=True)
class Poses(Tabular):
    """Poses of the body frame: times (N,), position (2, N) of its origin, heading (N,).

    The heading is the angle of its axes relative to those of the sheet at rest, anticlockwise, radians,
    not reduced modulo 2 pi.
    """

    times: Array
    position: Array
    heading: Array

    def seen_from(self, index: int) -> "Poses":
        """Positions and headings relative to the pose with that index; the times are unchanged."""
        origin = self.position[0, index] + 1j * self.position[1, index]
        place = self.position[0] + 1j * self.position[1] - origin
        place = place * np.exp(-1j * self.heading[index])
        heading = self.heading - self.heading[index]
        return Poses(self.times, np.stack([place.real, place.imag]), heading)

    def _columns(self) -> Sequence[Column]:
        x, y = self.position
        return [
            Column("time", self.times, "time", TIME),
            Column("x", x, "position of the centre of mass across", LENGTH),
            Column("y", y, "position of the centre of mass along", LENGTH),
            Column("heading", self.heading, "angle of the axes of the sheet, anticlockwise", RADIANS),
        ]


@dataclass(frozen=True)
class Path(Poses):
    """The path of a sheet over many periods, from the origin with heading 0 at the first time.

    step (2,), turn: displacement d and angle phi of one period in the axes at its start, length and
    radians (anticlockwise); period: T. step_error, turn_error: their estimated numerical errors,
    absolute. position_error, heading_error (N,): errors of the path, which accumulate over the periods.
    Like the error of the speed they do not include the model error. seconds: computing time of the
    path.
    """

    period: float
    step: Array
    turn: float
    step_error: float
    turn_error: float
    position_error: Array
    heading_error: Array
    seconds: float

    @property
    def is_straight(self) -> bool:
        """Whether the turning angle is zero within its error."""
        return abs(self.turn) <= self.turn_error

    @property
    def radius(self) -> float:
        """Radius of the circle through the origins at the ends of periods; infinite if straight."""
        if self.is_straight:
            return math.inf
        return float(np.linalg.norm(self.step) / abs(2 * math.sin(self.turn / 2)))

    @property
    def radius_error(self) -> float:
        """Estimated error of `radius`, absolute; infinite if straight."""
        if self.is_straight:
            return math.inf
        relative = self.turn_error / abs(self.turn)
        return self.radius * relative + self.step_error / abs(2 * math.sin(self.turn / 2))

    @property
    def speed(self) -> float:
        """Mean speed along that circle, or along the line, length per time."""
        arc_over_chord = 1 / abs(np.sinc(self.turn / (2 * math.pi)))
        return float(np.linalg.norm(self.step) * arc_over_chord / self.period)

    def _title(self) -> str:
        count = round(float(self.times[-1] - self.times[0]) / self.period) if self.period else 0
        way = "straight" if self.is_straight else f"on a circle of radius {self.radius:.6g} length"
        return f"Path: {count} periods, {way}"

    def _columns(self) -> Sequence[Column]:
        errors = self.position_error, self.heading_error
        return [
            *super()._columns(),
            Column("position_error", errors[0], "estimated error of the position", LENGTH),
            Column("heading_error", errors[1], "estimated error of the heading", RADIANS),
        ]


@one_blas_thread
def rigid_path(speed: CrawlSpeed, periods: int = 1, samples: int = 16) -> Path:
    """The path from repeating the rigid motion of one period.

    speed: result of `crawl_speed`, `field_speed` or `cycle_speed`; if its `rigid` is None the motion is
    mirror symmetric and the path straight. The path is that of the centre of mass, starting at 0, 0 at
    speed.times[0] (for any outline), with N = periods * samples + 1 times: `periods` periods of
    `samples` equal intervals.

    The mean velocities and their errors are those of the speed. Turning within the period contributes
    (R(theta) - 1)(V_x, V_y) to d; the error of its quadrature in time comes from a coarser one.

    Raises ValueError for numbers below 1, for a speed whose times are not those of a solver (panels of
    five equidistant times, neighbours sharing their ends), and for one with `rigid` but without
    rigid_mean and rigid_error. A sheet at rest (alpha = 0) has a single time.

    >>> import numpy as np
    >>> from linear_theory import FieldWave, Sheet, crawl_speed, rigid_path
    >>> lopsided = FieldWave(lambda x, y, t: (1 + 2 * x) * np.sin(2 * np.pi * (y - t)), period=1.0)
    >>> path = rigid_path(crawl_speed(Sheet(), lopsided, alpha=0.25, rtol=1e-2), periods=10)
    >>> print(f"turns left by {path.turn:.2f} rad a period, on a circle of radius {path.radius:.1f} L")
    turns left by 0.08 rad a period, on a circle of radius 1.4 L
    """
    start = time.perf_counter()
    periods = validation.integer("periods", periods, 1)
    samples = validation.integer("samples", samples, 1)
    cycle = _one_period(_checked_grid(speed), speed)
    shares = np.arange(samples) / samples
    whole = np.append(np.repeat(np.arange(periods), samples), periods)
    share = np.append(np.tile(shares, periods), 0.0)
    place, heading = cycle.repeated(whole, share)
    position_error, heading_error = cycle.errors(np.ceil(whole + share))
    return Path(
        times=cycle.start + cycle.length * (whole + share),
        position=np.stack([place.real, place.imag]),
        heading=heading,
        period=cycle.length,
        step=np.array([cycle.step.real, cycle.step.imag]),
        turn=cycle.turn,
        step_error=cycle.step_error,
        turn_error=cycle.turn_error,
        position_error=position_error,
        heading_error=heading_error,
        seconds=time.perf_counter() - start,
    )


class _Cycle(NamedTuple):
    """One period. spline: x, y, heading as functions of time; inner, inner_turn: errors within the
    period, which do not accumulate; swing: largest distance from the start."""

    spline: "CubicHermiteSpline"
    step_error: float
    turn_error: float
    inner: float
    inner_turn: float
    swing: float

    @property
    def start(self) -> float:
        return float(self.spline.x[0])

    @property
    def length(self) -> float:
        return float(self.spline.x[-1] - self.spline.x[0])

    @property
    def step(self) -> complex:
        x, y, _ = self.spline(self.spline.x[-1])
        return complex(x, y)

    @property
    def turn(self) -> float:
        return float(self.spline(self.spline.x[-1])[2])

    def repeated(self, whole: Array, share: Array) -> tuple[Complex, Array]:
        """Position (complex) and heading after whole periods and a fraction of the next."""
        x, y, angle = self.spline(self.start + share * self.length).T
        turned = np.exp(1j * self.turn * whole)
        return self.step * _powers(whole, self.turn) + turned * (x + 1j * y), self.turn * whole + angle

    def errors(self, periods: Array) -> tuple[Array, Array]:
        """First-order bounds of the errors of position and heading within given numbers of periods.

        Every period has the same errors of d and phi, which enter with the sums of q^k and of d k q^k,
        k < n. On a circle these sums stop growing like n and n^2.
        """
        chord = max(abs(math.sin(self.turn / 2)) - self.turn_error / 2, 1e-300)
        sums = np.minimum(periods, 1 / chord)
        slopes = np.maximum(np.minimum(periods / 2, 1 / chord) * (periods - 1), 0.0)
        turned = periods * self.turn_error
        place = self.step_error * sums + abs(self.step) * self.turn_error * slopes
        inside = periods > 0
        return place + turned * self.swing + self.inner * inside, turned + self.inner_turn * inside


def _powers(count: Array, angle: float) -> Complex:
    """1 + q + ... + q^(count - 1) for q = exp(i angle)."""
    half = math.remainder(angle, 2 * math.pi) / 2
    if half == 0:
        return count.astype(complex)
    return np.asarray(np.exp(1j * (count - 1) * half) * np.sin(count * half) / math.sin(half))


def _checked_grid(speed: CrawlSpeed) -> TimeGrid:
    """Panels of the whole period with its end. Raises ValueError if the times do not form panels."""
    hint = "use crawl_speed, field_speed or cycle_speed"
    times = validation.instance("speed", speed, CrawlSpeed, hint).times
    if times.size < 4 or times.size % 4:
        raise ValueError(f"speed.times has {times.size} times: must be panels of four, 4 or more")
    closed = np.append(times, 2 * times[-1] - times[-2])
    steps = np.diff(closed).reshape(-1, 4)
    if not np.all(steps > 0) or np.any(np.ptp(steps, axis=1) > SAME * steps.min(1)):
        raise ValueError("speed.times: must be panels of equal, positive steps")
    return TimeGrid(closed)


def _one_period(grid: TimeGrid, speed: CrawlSpeed) -> _Cycle:
    """The motion over one period and its errors."""
    times, length = grid.times, grid.lengths.sum()
    rigid, mean_errors = _closed_velocities(grid, speed)
    along, omega = rigid[0] + 1j * rigid[1], rigid[2]
    heading = _integral(grid, omega)
    velocity = along * np.exp(1j * heading)
    place = _integral(grid, velocity)
    poses = np.stack([place.real, place.imag, heading], 1)
    rates = np.stack([velocity.real, velocity.imag, omega], 1)
    inner, inner_turn = _inner_errors(times, poses, rates)
    mean_error = math.hypot(mean_errors[0], mean_errors[1])
    # an error of the heading within the period rotates the displacements there
    wrong_way = inner_turn * float(grid.mean(abs(along))[0])
    turning = grid.error(np.stack([(velocity - along).real, (velocity - along).imag]))
    return _Cycle(
        spline=_spline(times, poses, rates),
        step_error=length * (mean_error + wrong_way + turning),
        turn_error=length * mean_errors[2],
        inner=inner,
        inner_turn=inner_turn,
        swing=float(abs(place).max()),
    )


def _closed_velocities(grid: TimeGrid, speed: CrawlSpeed) -> tuple[Array, Array]:
    """V_x, V_y, Omega at all times of the grid, (3, times), and the errors of their means, (3,).

    The means are those of the speed, more accurate than means of the values: part of the motion has
        exactly zero mean.
    """
    if speed.turning is None:
        rigid = np.multiply.outer([0.0, 1.0, 0.0], speed.velocity)
        mean, error = np.array([0.0, speed.mean, 0.0]), np.array([0.0, speed.error, 0.0])
    else:
        rigid, mean, error = speed.turning.velocity, speed.turning.mean, speed.turning.error
    rigid = np.concatenate([rigid, rigid[:, :1]], axis=1)
    return rigid + (mean - grid.means(rigid)[0])[:, None], error


def _integral(grid: TimeGrid, values: NDArray[np.inexact]) -> NDArray[np.inexact]:
    """Integrals of values (times,) from the first time to each."""
    panels = np.lib.stride_tricks.sliding_window_view(values, 5)[::4]
    inside = panels @ _CUMULATIVE.T * (grid.lengths / 4)[:, None]
    before = np.concatenate([[0.0], np.cumsum(inside[:, -1])])
    return np.append((before[:-1, None] + inside[:, :-1]).ravel(), before[-1])


def _spline(times: Array, poses: Array, rates: Array) -> "CubicHermiteSpline":
    from scipy.interpolate import CubicHermiteSpline  # here: scipy takes long to import

    return CubicHermiteSpline(times, poses, rates)


def _inner_errors(times: Array, poses: Array, rates: Array) -> tuple[float, float]:
    """Largest errors of position and heading within the period, from omitting every second time."""
    coarse = _spline(times[::2], poses[::2], rates[::2])
    x, y, angle = (coarse(times) - poses).T
    return float(np.hypot(x, y).max()), float(abs(angle).max())
