"""One view of all results that can be drawn: where the points of the sheet are, and what pulls at them.

Points are those of the undeformed sheet, (2, n), units of length; places, (2 or 3, n), are in the frame
of the ground, in which the centre of a speed starts where that of the undeformed sheet is.
"""

from collections.abc import Iterator
from typing import NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from linear_theory.speed.result import CrawlSpeed

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


class Frame(NamedTuple):
    """The sheet at one time: place (2 or 3, n), still (2 or 3, n), the undeformed sheet carried along,
    growth (n,), alpha c, centre (2,), its centre of mass, and heading, anticlockwise, radians."""

    time: float
    place: Array
    still: Array
    growth: Array
    centre: Array
    heading: float


class Course(NamedTuple):
    """V_y(t): times and velocity (n,); from when to when its mean was taken, and is shown."""

    times: Array
    velocity: Array
    counted: tuple[float, float]
    shown: tuple[float, float]


@runtime_checkable
class Moving(Protocol):
    """What `panels` and `movies` read."""

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
        """What the shape is."""

    @property
    def components(self) -> int:
        """2 in the plane, 3 in space."""

    @property
    def has_shape(self) -> bool:
        """Whether there is more to draw than V(t) and a path."""

    @property
    def most_periods(self) -> int | None:
        """That can be shown; None for any number."""

    @property
    def direction(self) -> int:
        """1 for a wave towards +y, -1 for one towards -y, 0 where that is not known."""

    def covering(self) -> tuple[Array, Integers]:
        """Points and triangles (m, 3) of the undeformed sheet."""

    def course(self) -> Course:
        """V(t)."""

    def way(self, periods: int, samples: int) -> tuple[Array, Array]:
        """Times (n,), and the centre at them (2, n)."""

    def at(self, points: Array, phase: float) -> Frame:
        """The sheet at a phase, in periods."""

    def friction(self, points: Array, phase: float) -> Array:
        """Force of the ground per undeformed area, over mu times the weight, (2, n)."""

    def ground(self, x: Array, y: Array) -> Array:
        """Height of the ground at places (n,)."""

    def frames(self, points: Array, periods: int, samples: int) -> "Frames":
        """Frames at equal intervals."""


class Frames(Protocol):
    """A sequence of frames, each made when it is asked for."""

    def __len__(self) -> int: ...

    def __getitem__(self, index: int) -> Frame: ...

    def __iter__(self) -> Iterator[Frame]: ...


def turned(place: Array, heading: float) -> Array:
    """Places (2 or 3, n) turned anticlockwise about the vertical."""
    cosine, sine = np.cos(heading), np.sin(heading)
    x, y = place[:2]
    return np.concatenate([[cosine * x - sine * y, sine * x + cosine * y], place[2:]])
