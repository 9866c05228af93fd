"""What drives a sheet: a wave of growth c(x, y, t), and that wave on a body of known length.

A user gives a `Wave`: values, their rate and a period. All who solve something for it ask its `Drive`
on their body: values there, symmetries, the shortest scales in space and time. What is known exactly
and what must be looked for in samples is settled once, by the wave itself (see `sampled.drive`).

Solvers see a wave at some times and places only, and what lies between can hide: N equidistant times do
not tell a harmonic k from k - N, so that doublings of N agree on a wrong answer. Velocities follow
dc/dt, so that harmonics in time are weighed by their shares of that rate.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common.shown import Shown
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.spectrum import Spectrum

if TYPE_CHECKING:
    from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]

PER_HARMONIC = 5
"""Times to a period of a harmonic with which it is seen: two, and every second of four, can all fall on
its zeros."""

FAINT, FEW = 0.1, 0.01
"""Shares of a wave that may be shorter than `short_waves`, since cells have several points, and than
`waves_along`, after which meshes are chosen unless they are given: their errors are estimated."""


class Wave(Protocol):
    """What a user must give: c(x, y, t), its rate and its period.

    A wave that knows more of itself has `on(sheet, places=None)`, too, which returns its `Drive` on a
    body. sheet: the rectangle around the body; places: x and y (n,) of points all over it where it is
    not the whole rectangle, to look at the wave there. One that is not known exactly has `uncertainty`,
    which the errors of speeds count (see `uncertain`).
    """

    @property
    def period(self) -> float:
        """Units of time."""

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """Growth c on a sheet of that length."""

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """Its time derivative."""


class Drive(Shown, ABC):
    """A wave on a body: all that solvers ask of c(x, y, t).

    wave: what is driven with; sheet: the rectangle around the body. Points x, y (units of length) and
    times t broadcast. series: the travelling wave that c is, whose harmonics in time are the load cases
    of an elastic problem; None where c is no such series. mirrored: whether c(-x, y, t) = c(x, y, t) is
    known, so that half of a symmetric body will do. has_state: whether c comes of an equation in time
    and must be brought on by `advance`; no wave so far.

    What has an answer here is that of a wave of which nothing is known.

    >>> from linear_theory import Sheet, SineWave
    >>> drive = SineWave(count=2).on(Sheet(length=3.0))
    >>> print(drive.value(x=0.0, y=0.375, t=0.0).round(12), drive.changes_sign, drive.short_waves)
    1.0 True (1, 2)
    """

    series: "TravellingWave | None" = None
    mirrored: bool = False
    has_state: bool = False

    def __init__(self, wave: Wave, sheet: Sheet) -> None:
        self.wave, self.sheet = wave, sheet

    def _contents(self) -> Mapping[str, Any]:
        return {"wave": self.wave, "sheet": self.sheet}

    @property
    def period(self) -> float:
        """Time after which c repeats; all levels so far need one, also of a wave that has a state."""
        return float(self.wave.period)

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """c at points of the body."""
        return self.wave.value(x, y, t, self.sheet.length)

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """dc/dt at points of the body."""
        return self.wave.rate(x, y, t, self.sheet.length)

    def advance(self, t: float) -> "Drive":
        """The drive whose state is known up to time t: itself where c is a function of time."""
        return self

    @property
    def fine(self) -> "Drive":
        """The drive whose rate, where it is a difference of values, is as fine as its harmonics ask."""
        return self

    @property
    @abstractmethod
    def changes_sign(self) -> bool:
        """Whether c(t + T/2) = -c(t), so that terms of odd order in alpha have no mean."""

    @property
    def reversal_time(self) -> float | None:
        """t_0 with c(-y, t_0 - t) = c(y, t), so that V(t_0 - t) = V(t); None where none is known."""
        return None

    @property
    @abstractmethod
    def depends_on_x(self) -> bool:
        """Whether c is another one off the axis x = 0."""

    @property
    @abstractmethod
    def size(self) -> float:
        """Root mean square of c."""

    @property
    @abstractmethod
    def rates(self) -> Spectrum:
        """Root mean squares of the harmonics in time of dc/dt, per time."""

    @property
    @abstractmethod
    def short_waves(self) -> tuple[int, int]:
        """Numbers of the shortest waves that matter across and along the body, all but FAINT."""

    @property
    def waves_along(self) -> int:
        """Waves along the body in which there is all but FEW of c; 1 where it is not known."""
        return 1

    def degree_along(self, share: float) -> float:
        """Degree of polynomials of y that carry all but that share of c; inf where it is not known."""
        return math.inf

    @abstractmethod
    def growths(self, x: Array, y: Array) -> Array:
        """c at such places and times that no extreme of a smooth wave is left out by much.

        x, y: (n,), points of the body; not all are taken where they are many.
        """

    @abstractmethod
    def check_period(self) -> None:
        """Raise ValueError where c does not repeat after its period."""

    def check(self) -> None:
        """Raise ValueError where c does not repeat after its period or `rate` is not its derivative."""
        self.check_period()

    def speed_per_rate(self, alpha: float, leading: bool) -> float:
        """Largest V that dc/dt of root mean square 1 makes: half of the sheet grows in phase.

        leading: whether terms of order alpha have a mean; else V is alpha c times smaller.
        """
        size = abs(alpha) * self.sheet.length / 2
        return size if leading else size * abs(alpha) * self.size

    def times_for(self, rate: float) -> float:
        """Equidistant times per period from which no more than that part of dc/dt hides; may be inf."""
        return PER_HARMONIC * self.rates.needed(rate)

    def hidden(self, step: float, steps: int = PER_HARMONIC) -> float:
        """Root mean square of dc/dt in harmonics to a period of which there are fewer such steps."""
        return self.rates.beyond(self.period / step / steps * (1 + 1e-9))
