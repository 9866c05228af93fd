"""A common interface of all results that can be drawn: positions of the points and forces on them.

Points are those of the undeformed sheet, (2, n), units of length; places, (2 or 3, n), are positions in
the frame of the ground, where the centre of a speed starts at that of the undeformed sheet.
"""

from collections.abc import Iterator
from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from fem_check.output.works import Energies
from linear_theory.speed.result import CrawlSpeed

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


CONSTANT = 2
"""Times up to which a speed does not change: a line has both ends of the period and
a sheet at rest one."""


class Frame(NamedTuple):
    """The sheet at one time: place (2 or 3, n); still (2 or 3, n), the undeformed sheet moving along;
    growth (n,), alpha c; wave (n,), c; centre (2,) of mass; heading, anticlockwise, radians."""

    time: float
    place: Array
    still: Array
    growth: Array
    wave: Array
    centre: Array
    heading: float


class Course(NamedTuple):
    """V_y(t): times and velocity (n,); the interval over which its mean was taken and is shown."""

    times: Array
    velocity: Array
    counted: tuple[float, float]
    shown: tuple[float, float]


@runtime_checkable
class Moving(Protocol):
    """The interface used by `panels` and `movies`."""

    @property
    def speed(self) -> CrawlSpeed:
        """The answer."""

    @property
    def period(self) -> float:
        """Of the wave."""

    @property
    def length(self) -> float:
        """Of the sheet."""

    @property
    def words(self) -> str:
        """Description of the shape."""

    @property
    def components(self) -> int:
        """2 in the plane, 3 in space."""

    @property
    def has_shape(self) -> bool:
        """Whether the shape can be drawn, not only V(t) and the path."""

    @property
    def most_periods(self) -> int | None:
        """Largest number of periods that can be shown; None for any number."""

    @property
    def direction(self) -> int:
        """1 for a wave towards +y, -1 for one towards -y, 0 if unknown."""

    def covering(self) -> tuple[Array, Integers]:
        """Points and triangles (m, 3) of the undeformed sheet."""

    def course(self) -> Course:
        """V(t)."""

    def waves(self, points: Array, times: Array) -> Array:
        """The wave c at the points at given times, (times, n)."""

    @property
    def energies(self) -> Energies | None:
        """Where the work of growth went, if the result tells."""

    def way(self, periods: int, samples: int) -> tuple[Array, Array]:
        """Times (n,) and the positions of the centre (2, n)."""

    def at(self, points: Array, phase: float) -> Frame:
        """The sheet at a phase, in periods."""

    def friction(self, points: Array, phase: float) -> Array:
        """Friction force per undeformed area, divided by mu times the weight, (2, n)."""

    @property
    def presses(self) -> bool:
        """Whether `pressure` is known: of a sheet in space with something below it."""

    def pressure(self, points: Array, phase: float) -> Array:
        """Normal load per undeformed area over the weight per area, (n,); 0 where the sheet is off the
        ground."""

    def ground(self, x: Array, y: Array) -> Array:
        """Height of the ground at places (n,)."""

    def frames(self, points: Array, periods: int, samples: int) -> "Frames":
        """Frames at equal intervals."""


class Frames(Protocol):
    """A sequence of frames, each computed when accessed."""

    def __len__(self) -> int: ...

    def __getitem__(self, index: int) -> Frame: ...

    def __iter__(self) -> Iterator[Frame]: ...


def closed(times: Array, velocity: Array, period: float) -> Course:
    """V(t) over the period that starts at 0, extended slightly so that the curve is closed."""
    whole = (0.0, period)
    if times.size <= CONSTANT:
        return Course(np.array(whole), np.full(2, velocity[0]), whole, whole)
    share = np.mod(times, period)
    order = np.argsort(share)
    times, velocity = share[order], velocity[order]
    times = np.concatenate([times[-1:] - period, times, times[:1] + period])
    return Course(times, np.concatenate([velocity[-1:], velocity, velocity[:1]]), whole, whole)


def turned(place: Array, heading: float) -> Array:
    """Positions (2 or 3, n) rotated anticlockwise about the vertical."""
    cosine, sine = np.cos(heading), np.sin(heading)
    x, y = place[:2]
    return np.concatenate([[cosine * x - sine * y, sine * x + cosine * y], place[2:]])


def friction_at(moving: Moving, points: Array, time: float) -> tuple[Array, float]:
    """Friction (2, n) at the time of a frame, and the heading of the sheet to which it belongs.

    A motion that repeats is known in one period: turn the force by the heading of the frame minus that.
    """
    phase = (time - moving.at(points, 0.0).time) / moving.period
    return moving.friction(points, phase), moving.at(points, phase).heading
