"""A wave of growth c(x, y, t), and the drive: that wave on a body of known length.

A user gives a `Wave`: values, rate and period. Solvers use its `Drive` on their body: values there,
symmetries, the shortest scales in space and time. The wave itself decides which of these are known
exactly and which are estimated from samples (see `sampled.drive`).

Solvers sample a wave at discrete times and points and can miss features in between: on N equidistant
times a harmonic k aliases to k - N, so that results for N and 2 N may agree on a wrong answer.
Velocities are proportional to dc/dt, so that harmonics in time are weighted by their part of that rate.
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
"""Times per period needed to resolve a harmonic: two, and every second of four, can all coincide with
its zeros."""

FAINT, FEW = 0.1, 0.01
"""Fractions of a wave that may lie in wavelengths shorter than `short_waves` (cells have several
points) and than `waves_along` (for default meshes, whose error is estimated)."""


class Wave(Protocol):
    """A wave as given by the user: c(x, y, t), its rate and its period.

    A wave with further information also has `on(sheet, places=None)`, which returns its `Drive` on a
    body. sheet: the rectangle around the body; places: x and y (n,) of points distributed over a body
    that is not the whole rectangle, at which the wave is sampled. One that is not known exactly has
    `uncertainty`, which the errors of speeds include (see `uncertain`).
    """

    @property
    def period(self) -> float:
        """Units of time."""

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """Growth c on a sheet of that length."""

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """Time derivative dc/dt on a sheet of that length."""


class Drive(Shown, ABC):
    """A wave on a body: the information on c(x, y, t) needed by solvers.

    wave: the wave; sheet: the rectangle around the body. Points x, y (units of length) and times t
    broadcast. series: c as a travelling wave, whose harmonics in time are the load cases of an elastic
    problem; None if c is not such a series. mirrored: whether c(-x, y, t) = c(x, y, t) is known, so
    that half of a symmetric body suffices. has_state: whether c depends on the motion of the sheet,
    so that only a level that steps both together (`followed`) knows it.

    The defaults given here are those of a wave without further information.

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
        """Time after which c repeats, required by all levels so far, even for a wave with a state."""
        return float(self.wave.period)

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """c at points of the body."""
        return self.wave.value(x, y, t, self.sheet.length)

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """dc/dt at points of the body."""
        return self.wave.rate(x, y, t, self.sheet.length)

    @property
    def alone(self) -> "Drive":
        """The drive of the wave on which nothing acts back, with which one that has a state starts."""
        return self

    def followed(self, coarse: bool = False) -> "Drive":
        """The drive of one run, which moves on with it; the same object if c is a function of time.

        coarse: with about twice the error, to estimate it.
        """
        return self

    @property
    def fine(self) -> "Drive":
        """The drive with the step of a rate by differences adapted to the harmonics of the wave."""
        return self

    @property
    @abstractmethod
    def changes_sign(self) -> bool:
        """Whether c(t + T/2) = -c(t), so that terms of odd order in alpha have no mean."""

    @property
    def reversal_time(self) -> float | None:
        """t_0 with c(-y, t_0 - t) = c(y, t), so that V(t_0 - t) = V(t); None if none is known."""
        return None

    @property
    @abstractmethod
    def depends_on_x(self) -> bool:
        """Whether c off the axis x = 0 differs from that on it."""

    @property
    @abstractmethod
    def size(self) -> float:
        """Root mean square of c."""

    @property
    @abstractmethod
    def rates(self) -> Spectrum:
        """Spectrum of dc/dt in time: root mean squares of the harmonics, 1/time."""

    @property
    @abstractmethod
    def short_waves(self) -> tuple[int, int]:
        """Wave numbers across and along the body up to which all of c but FAINT is resolved."""

    @property
    def waves_along(self) -> int:
        """Wave number along the body up to which all of c but FEW is resolved; 1 if unknown."""
        return 1

    def degree_along(self, share: float) -> float:
        """Degree of polynomials in y that resolve c but for that fraction; inf if unknown."""
        return math.inf

    @abstractmethod
    def growths(self, x: Array, y: Array) -> Array:
        """c at points and times dense enough to come close to every extremum of a smooth wave.

        x, y: (n,), points of the body; a subset is used if there are many.
        """

    @abstractmethod
    def check_period(self) -> None:
        """Raise ValueError if c does not repeat after its period."""

    def check_until(self, end: float) -> None:
        """Raise ValueError unless c is known from t = 0 to `end`, for solvers that follow it in time.

        A wave that repeats is; one that need not repeat says how far it is known.
        """
        self.check_period()

    def check(self) -> None:
        """Raise ValueError if c does not repeat after its period or `rate` is not its derivative."""
        self.check_period()

    def speed_per_rate(self, alpha: float, leading: bool) -> float:
        """Largest V for dc/dt of root mean square 1, with half of the sheet growing in phase.

        leading: whether terms of order alpha have a non-zero mean; else V is smaller by alpha c.
        """
        size = abs(alpha) * self.sheet.length / 2
        return size if leading else size * abs(alpha) * self.size

    def times_for(self, rate: float) -> float:
        """Equidistant times per period that resolve dc/dt but for `rate`; may be inf."""
        return PER_HARMONIC * self.rates.needed(rate)

    def hidden(self, step: float, steps: int = PER_HARMONIC) -> float:
        """Root mean square of dc/dt in harmonics with fewer than `steps` time steps per period."""
        return self.rates.beyond(self.period / step / steps * (1 + 1e-9))
