"""The drive of any wave: what its values at random points and times tell of it.

The wave alone is looked at, in time at random points and along lines at random times, which costs
little.
"""

import math
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.phases import phases
from linear_theory.wave.places import SEED, Places, on_sheet, spread
from linear_theory.wave.protocol import FAINT, Drive, Wave
from linear_theory.wave.spectrum import Spectrum, chebyshev, fourier

Array = NDArray[np.float64]

TIMES, LINES = 192, 24
"""Random times of the period, random lines along or across the body."""

HARMONICS, DEGREES = (32, 4096), (16, 1024)
"""Fewest and most samples in time and along a line; waves that jump or have kinks need more."""

EXTREME_POINTS, EXTREME_TIMES = 2000, 64
"""Points, at most about so many, and times at which the largest growth is looked for."""

REPEATS = 1e-6
"""Share of the largest |c| by which c(t) and c(t + T) may differ."""

RATE_STEPS = 1 / 512, 1 / 1024, 1 / 2048
RATE_AGREES, RATE_RIGHT = 1e-4, 1e-3
"""Steps, in periods, of the differences by which a rate is judged where they agree to the first of
these shares of the largest rate; it may be off by the second."""

CHANGES_SIGN = 1e-12
"""Share of the largest |c| by which c(t + T/2) may differ from -c(t)."""


def drive(wave: Wave, sheet: Sheet, places: Places | None = None) -> Drive:
    """A wave on a body: `wave.on(sheet, places)` where it has that method, else what samples tell.

    sheet: the rectangle around the body; places: points (see `Places`) of a body that is not the whole
    rectangle.

    >>> import numpy as np
    >>> from linear_theory import FieldWave, Sheet
    >>> from linear_theory.wave.sampled import drive
    >>> w = 2 * np.pi
    >>> wave = FieldWave(lambda x, y, t: np.sin(w * (y - t)) + 0.1 * np.sin(40 * w * t), 1.0)
    >>> rates = drive(wave, Sheet()).rates
    >>> print(rates.highest(share=1e-3), rates.highest(share=0.99))
    40.0 1.0
    """
    on = getattr(wave, "on", None)
    return SampledDrive(wave, sheet, places) if on is None else on(sheet, places)


class SampledDrive(Drive):
    """A wave on a body, known by its values alone; x, y (points,): places at which it is looked at."""

    def __init__(self, wave: Wave, sheet: Sheet, places: Places | None = None) -> None:
        super().__init__(wave, sheet)
        self.x, self.y = on_sheet(sheet) if places is None else places

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """c at points of the body, spread where the wave leaves out what it does not depend on."""
        return _spread_over(super().value(x, y, t), x, y, t)

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """dc/dt likewise."""
        return _spread_over(super().rate(x, y, t), x, y, t)

    @cached_property
    def changes_sign(self) -> bool:
        """Whether c(t + T/2) = -c(t)."""
        again = self._at(self._times + self.period / 2)
        return bool(abs(self._seen + again).max() <= CHANGES_SIGN * abs(self._seen).max())

    @cached_property
    def depends_on_x(self) -> bool:
        """Whether c is another one off the axis x = 0."""
        on_axis = self.value(0 * self.x, self.y, self._times[:, None])
        return bool(abs(self._seen - on_axis).max() > REPEATS * abs(self._seen).max())

    @cached_property
    def size(self) -> float:
        """Root mean square of c."""
        return float(np.sqrt(np.mean(self._seen**2)))

    @cached_property
    def rates(self) -> Spectrum:
        """Root mean squares of the harmonics in time of dc/dt, per time."""
        found = fourier(
            lambda share: self._at(self.period * share), self._times / self.period, *HARMONICS
        )
        return found.of_rates(self.period)

    @cached_property
    def along(self) -> Spectrum:
        """Root mean squares of c in Chebyshev polynomials of 2y/L, by degree."""
        x, t = self.x[:LINES], self._times[:LINES]
        return chebyshev(
            lambda s: self.value(x, self.sheet.length / 2 * s[:, None], t), self._stations, *DEGREES
        )

    @cached_property
    def across(self) -> Spectrum:
        """Likewise of 2x/W."""
        y, t = self.y[:LINES], self._times[:LINES]
        return chebyshev(
            lambda s: self.value(self.sheet.width / 2 * s[:, None], y, t), self._stations, *DEGREES
        )

    def degree_along(self, share: float) -> float:
        """Degree of polynomials of y that carry all but that share of c; inf where it is not known."""
        return self.along.highest(share)

    @cached_property
    def short_waves(self) -> tuple[int, int]:
        """Numbers of the shortest waves that matter across and along the body, at least 1 and 2.

        Those of a wave whose growth jumps may not be known: then the least, error estimates show the
        rest.
        """
        across, along = (_waves(spectrum.highest(FAINT)) for spectrum in (self.across, self.along))
        return max(across, 1), max(along, 2)

    def growths(self, x: Array, y: Array) -> Array:
        """c at some of the points and at times that no harmonic has in common, (times, points)."""
        some = slice(None, None, math.ceil(x.size / EXTREME_POINTS))
        return self.value(x.ravel()[some], y.ravel()[some], phases(self.period, EXTREME_TIMES)[:, None])

    def check(self) -> None:
        """Raise ValueError where c does not repeat after its period or `rate` is not its derivative."""
        self.check_period()
        self._check_rate()

    def check_period(self) -> None:
        """Raise ValueError where c does not repeat after its period."""
        size = abs(self._seen).max()
        apart = abs(self._at(self._times + self.period) - self._seen)
        i, j = np.unravel_index(apart.argmax(), apart.shape)
        if apart[i, j] > REPEATS * size:
            raise ValueError(
                f"period = {self.period:g}: c must repeat after it, but c(t) and c(t + period) differ "
                f"by {apart[i, j]:.3g} (largest |c| {size:.3g}) at {self._place(i, j)}; "
                "give the time after which the wave repeats"
            )

    def _check_rate(self) -> None:
        """At places where differences of value with several steps agree: elsewhere c has a kink."""
        quotients = np.stack([self._quotient(share * self.period) for share in RATE_STEPS])
        rate = self.rate(self.x, self.y, self._times[:, None])
        size = max(abs(quotients).max(), abs(rate).max())
        apart = np.where(np.ptp(quotients, axis=0) <= RATE_AGREES * size, abs(rate - quotients[-1]), 0)
        i, j = np.unravel_index(apart.argmax(), apart.shape)
        if apart[i, j] > RATE_RIGHT * size:
            raise ValueError(
                f"rate = {rate[i, j]:.6g} at {self._place(i, j)}: must be the time derivative of "
                f"value, whose differences give {quotients[-1, i, j]:.6g} there; correct it, or leave "
                "it out"
            )

    def _quotient(self, step: float) -> Array:
        """Central difference of fourth order at the random times, (times, points)."""
        near, far = (
            self._at(self._times + k * step) - self._at(self._times - k * step) for k in (1, 2)
        )
        return (8 * near - far) / (12 * step)

    def _place(self, i: np.intp, j: np.intp) -> str:
        return f"x, y, t = {self.x[j]:.3g}, {self.y[j]:.3g}, {self._times[i]:.3g}"

    @cached_property
    def _times(self) -> Array:
        return self.period * spread(TIMES, SEED + 1)

    @cached_property
    def _stations(self) -> Array:
        """Random places along a line, in [-1, 1)."""
        return 2 * spread(TIMES, SEED + 2) - 1

    @cached_property
    def _seen(self) -> Array:
        """c at the random points and times, (times, points)."""
        return self._at(self._times)

    def _at(self, times: Array) -> Array:
        """c at the random points and any times (n,), (n, points)."""
        return self.value(self.x, self.y, times[:, None])


def _spread_over(values: ArrayLike, *points: ArrayLike) -> Array:
    """Values at points, of their common shape."""
    values, shape = np.asarray(values), np.broadcast(*points).shape
    return values if values.shape == shape else np.broadcast_to(values, shape)


def _waves(degree: float) -> int:
    """Waves that polynomials up to a degree carry, pi of them each; 0 for inf."""
    return 0 if math.isinf(degree) else int(degree / math.pi)
