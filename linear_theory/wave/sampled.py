"""The drive of a general wave, with its properties estimated from values at random points and times.

Only the wave is sampled, in time at random points and along lines at random times, which is cheap.
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
"""Numbers of random times in the period and of random lines along or across the body."""

HARMONICS, DEGREES = (32, 4096), (16, 1024)
"""Smallest and largest number of samples in time and along a line; jumps and kinks would need more."""

EXTREME_POINTS, EXTREME_TIMES = 2000, 64
"""Approximate largest number of points, and number of times, at which the largest growth is sought."""

REPEATS = 1e-6
"""Largest difference of c(t) and c(t + T), relative to the largest |c|."""

RATE_STEPS = 1 / 512, 1 / 1024, 1 / 2048
RATE_AGREES, RATE_RIGHT = 1e-4, 1e-3
"""Steps, in periods, of the differences that check a rate where they agree to the first of these
fractions of the largest rate; the rate may deviate by the second."""

CHANGES_SIGN = 1e-12
"""Largest difference of c(t + T/2) and -c(t), relative to the largest |c|."""


def drive(wave: Wave, sheet: Sheet, places: Places | None = None) -> Drive:
    """A wave on a body: `wave.on(sheet, places)` if it has that method, else estimated from samples.

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
    """A wave on a body, known only by its values; x, y (points,): sampling points."""

    def __init__(self, wave: Wave, sheet: Sheet, places: Places | None = None) -> None:
        super().__init__(wave, sheet)
        self.x, self.y = on_sheet(sheet) if places is None else places

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """c at points of the body, broadcast if the wave returns a smaller shape."""
        return _spread_over(super().value(x, y, t), x, y, t)

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """dc/dt at points of the body, broadcast in the same way."""
        return _spread_over(super().rate(x, y, t), x, y, t)

    @cached_property
    def changes_sign(self) -> bool:
        """Whether c(t + T/2) = -c(t)."""
        again = self._at(self._times + self.period / 2)
        return bool(abs(self._seen + again).max() <= CHANGES_SIGN * abs(self._seen).max())

    @cached_property
    def depends_on_x(self) -> bool:
        """Whether c off the axis x = 0 differs from that on it."""
        on_axis = self.value(0 * self.x, self.y, self._times[:, None])
        return bool(abs(self._seen - on_axis).max() > REPEATS * abs(self._seen).max())

    @cached_property
    def size(self) -> float:
        """Root mean square of c."""
        return float(np.sqrt(np.mean(self._seen**2)))

    @cached_property
    def rates(self) -> Spectrum:
        """Spectrum of dc/dt in time: root mean squares of the harmonics, 1/time."""
        found = fourier(
            lambda share: self._at(self.period * share), self._times / self.period, *HARMONICS
        )
        return found.of_rates(self.period)

    @cached_property
    def along(self) -> Spectrum:
        """Spectrum of c in Chebyshev polynomials of 2y/L: root mean squares by degree."""
        x, t = self.x[:LINES], self._times[:LINES]
        return chebyshev(
            lambda s: self.value(x, self.sheet.length / 2 * s[:, None], t), self._stations, *DEGREES
        )

    @cached_property
    def across(self) -> Spectrum:
        """Spectrum of c in Chebyshev polynomials of 2x/W: root mean squares by degree."""
        y, t = self.y[:LINES], self._times[:LINES]
        return chebyshev(
            lambda s: self.value(self.sheet.width / 2 * s[:, None], y, t), self._stations, *DEGREES
        )

    def degree_along(self, share: float) -> float:
        """Degree of polynomials in y that resolve c but for that fraction; inf if unknown."""
        return self.along.highest(share)

    @cached_property
    def short_waves(self) -> tuple[int, int]:
        """Wave numbers across and along the body up to which c is resolved, at least 1 and 2.

        They may be unknown for discontinuous growth: then the minimum, and shorter waves show in error
        estimates.
        """
        across, along = (_waves(spectrum.highest(FAINT)) for spectrum in (self.across, self.along))
        return max(across, 1), max(along, 2)

    def growths(self, x: Array, y: Array) -> Array:
        """c at some of the points, at times incommensurate with all harmonics, (times, points)."""
        some = slice(None, None, math.ceil(x.size / EXTREME_POINTS))
        return self.value(x.ravel()[some], y.ravel()[some], phases(self.period, EXTREME_TIMES)[:, None])

    def check(self) -> None:
        """Raise ValueError if c does not repeat after its period or `rate` is not its derivative."""
        self.check_period()
        self._check_rate()

    def check_period(self) -> None:
        """Raise ValueError if c does not repeat after its period."""
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
        """Check the rate where differences with several steps agree: elsewhere c has a kink."""
        quotients = np.stack([self._quotient(share * self.period) for share in RATE_STEPS])
        rate = self.rate(self.x, self.y, self._times[:, None])
        size = max(abs(quotients).max(), abs(rate).max())
        apart = np.where(np.ptp(quotients, axis=0) <= RATE_AGREES * size, abs(rate - quotients[-1]), 0)
        i, j = np.unravel_index(apart.argmax(), apart.shape)
        if apart[i, j] > RATE_RIGHT * size:
            raise ValueError(
                f"rate = {rate[i, j]:.6g} at {self._place(i, j)}: must be the time derivative of "
                f"value, whose differences give {quotients[-1, i, j]:.6g} there; correct or omit rate"
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
        """Stratified random positions along a line, in [-1, 1)."""
        return 2 * spread(TIMES, SEED + 2) - 1

    @cached_property
    def _seen(self) -> Array:
        """c at the random points and times, (times, points)."""
        return self._at(self._times)

    def _at(self, times: Array) -> Array:
        """c at the random points and given times (n,), (n, points)."""
        return self.value(self.x, self.y, times[:, None])


def _spread_over(values: ArrayLike, *points: ArrayLike) -> Array:
    """Values broadcast to the common shape of the points."""
    values, shape = np.asarray(values), np.broadcast(*points).shape
    return values if values.shape == shape else np.broadcast_to(values, shape)


def _waves(degree: float) -> int:
    """Waves resolved by polynomials up to a degree, pi degrees per wave; 0 for inf."""
    return 0 if math.isinf(degree) else int(degree / math.pi)
