"""What a wave asks of those who sample it: how it depends on time and place, and whether it repeats.

Solvers see a wave at some times and places only, and what lies between can hide: N equidistant times do
not tell a harmonic k from k - N, so that doublings of N agree on a wrong answer. Here the wave alone,
which costs little, is looked at by its series in time at random points, and along lines at random
times. Velocities follow dc/dt, so that harmonics in time are weighed by their shares of that rate.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common.shown import Shown
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.given import FieldWave
from linear_theory.wave.spectrum import Spectrum, chebyshev, fourier
from linear_theory.wave.travelling import TravellingWave, Wave

Array = NDArray[np.float64]

POINTS, TIMES, LINES = 192, 192, 24
"""Random points of the body, random times of the period, random lines along or across the body."""

SEED = 20240607

HARMONICS, DEGREES = (32, 4096), (16, 1024)
"""Fewest and most samples in time and along a line; waves that jump or have kinks need more."""

REPEATS = 1e-6
"""Share of the largest |c| by which c(t) and c(t + T) may differ."""

RATE_STEPS = 1 / 512, 1 / 1024, 1 / 2048
RATE_AGREES, RATE_RIGHT = 1e-4, 1e-3
"""Steps, in periods, of the differences by which a rate is judged where they agree to the first of
these shares of the largest rate; it may be off by the second."""

CHANGES_SIGN = 1e-12
"""Share of the largest |c| by which c(t + T/2) may differ from -c(t)."""

FINE_SHARES = 1e-6, 1e-4
"""Of dc/dt, that may lie in harmonics for which a rate by differences is not made fine enough: the
first where it is known; a wave with kinks has neither."""

PER_HARMONIC = 5
"""Times to a period of a harmonic with which it is seen: two, and every second of four, can all fall on
its zeros."""

FAINT, FEW = 0.1, 0.01
"""Shares of a wave that may be shorter than `short_waves`, since cells have several points, and than
`waves_along`, after which meshes are chosen unless they are given: their errors are estimated."""


def spread(count: int, seed: int) -> Array:
    """Random numbers in [0, 1), one in each of `count` equal parts of it, in random order, (count,).

    No gap between them is longer than two parts: what is as wide as that is met, wherever it lies.
    """
    random = np.random.default_rng(seed)
    return np.asarray((random.permutation(count) + random.uniform(size=count)) / count)


@dataclass(frozen=True, eq=False)
class WaveSurvey(Shown):
    """A wave on a body; x, y (points,): places in it; sheet: the rectangle around it.

    >>> import numpy as np
    >>> from linear_theory import FieldWave, Sheet
    >>> from linear_theory.wave.survey import WaveSurvey
    >>> w = 2 * np.pi
    >>> wave = FieldWave(lambda x, y, t: np.sin(w * (y - t)) + 0.1 * np.sin(40 * w * t), 1.0)
    >>> survey = WaveSurvey.on_sheet(wave, Sheet())
    >>> print(survey.rates.highest(share=1e-3), survey.rates.highest(share=0.99))
    40.0 1.0
    """

    wave: Wave
    sheet: Sheet
    x: Array
    y: Array

    @classmethod
    def on_sheet(cls, wave: Wave, sheet: Sheet) -> "WaveSurvey":
        """At random points of a rectangle."""
        x, y = spread(POINTS, SEED) - 0.5, spread(POINTS, SEED + 3) - 0.5
        return cls(wave, sheet, sheet.width * x, sheet.length * y)

    @classmethod
    def on_line(cls, wave: Wave, length: float = 1.0) -> "WaveSurvey":
        """At random points of the axis x = 0."""
        y = spread(POINTS, SEED) - 0.5
        return cls(wave, Sheet(length), 0 * y, length * y)

    @classmethod
    def at_some(cls, wave: Wave, sheet: Sheet, x: Array, y: Array) -> "WaveSurvey":
        """At a random choice of points (n,) of a body of any outline."""
        along = np.argsort(y, axis=None)
        some = along[(x.size * spread(POINTS, SEED)).astype(int)]
        return cls(wave, sheet, x.ravel()[some], y.ravel()[some])

    def check(self) -> None:
        """Raise ValueError where c does not repeat after its period or `rate` is not its derivative."""
        self.check_period()
        known = TravellingWave, FieldWave
        if not isinstance(self.wave, known) or (
            isinstance(self.wave, FieldWave) and not self.wave.differenced
        ):
            self._check_rate()

    @cached_property
    def changes_sign(self) -> bool:
        """Whether c(t + T/2) = -c(t)."""
        if isinstance(self.wave, TravellingWave):
            return self.wave.is_half_period_antisymmetric
        again = self._at(self._times + self.wave.period / 2)
        return bool(abs(self._seen + again).max() <= CHANGES_SIGN * abs(self._seen).max())

    @cached_property
    def depends_on_x(self) -> bool:
        """Whether c is another one off the axis x = 0."""
        if isinstance(self.wave, TravellingWave):
            return False
        on_axis = self._value(0 * self.x, self.y, self._times[:, None])
        return bool(abs(self._seen - on_axis).max() > REPEATS * abs(self._seen).max())

    @cached_property
    def size(self) -> float:
        """Root mean square of c."""
        wave = self.wave
        if isinstance(wave, TravellingWave):
            return math.sqrt(wave.mean**2 + np.sum(wave.cosine**2 + wave.sine**2) / 2)
        return float(np.sqrt(np.mean(self._seen**2)))

    @cached_property
    def rates(self) -> Spectrum:
        """Root mean squares of the harmonics in time of dc/dt, per time."""
        wave = self.wave
        if isinstance(wave, TravellingWave):
            sizes, missed = np.hypot(wave.cosine, wave.sine) / math.sqrt(2), 0.0
        else:
            found = fourier(
                lambda share: self._at(wave.period * share), self._times / wave.period, *HARMONICS
            )
            sizes, missed = found.sizes, found.missed
        frequency = 2 * np.pi / wave.period
        harmonics = np.arange(1, sizes.size + 1)
        return Spectrum(frequency * harmonics * sizes, frequency * (sizes.size + 1) * missed)

    @cached_property
    def fine_wave(self) -> Wave:
        """The wave, its rate as fine as its harmonics ask for where it is a difference of values."""
        if not isinstance(self.wave, FieldWave):
            return self.wave
        known = [h for h in map(self.rates.highest, FINE_SHARES) if h < math.inf]
        return self.wave.resolving(known[0]) if known else self.wave

    @cached_property
    def along(self) -> Spectrum:
        """Root mean squares of c in Chebyshev polynomials of 2y/L, by degree."""
        x, t = self.x[:LINES], self._times[:LINES]
        return chebyshev(
            lambda s: self._value(x, self.sheet.length / 2 * s[:, None], t), self._places, *DEGREES
        )

    @cached_property
    def across(self) -> Spectrum:
        """Likewise of 2x/W."""
        y, t = self.y[:LINES], self._times[:LINES]
        return chebyshev(
            lambda s: self._value(self.sheet.width / 2 * s[:, None], y, t), self._places, *DEGREES
        )

    @cached_property
    def short_waves(self) -> tuple[int, int]:
        """Numbers of the shortest waves that matter across and along the body, at least 1 and 2.

        Those of a wave whose growth jumps may not be known: then the least, error estimates show the
        rest.
        """
        if isinstance(self.wave, TravellingWave):
            rates = self.wave.harmonics * np.hypot(self.wave.cosine, self.wave.sine)
            return 1, int(self.wave.orders[rates >= FAINT * rates.max()][-1])
        across, along = (_waves(spectrum.highest(FAINT)) for spectrum in (self.across, self.along))
        return max(across, 1), max(along, 2)

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
        return self.rates.beyond(self.wave.period / step / steps * (1 + 1e-9))

    @cached_property
    def _times(self) -> Array:
        return self.wave.period * spread(TIMES, SEED + 1)

    @cached_property
    def _places(self) -> Array:
        return 2 * spread(TIMES, SEED + 2) - 1

    @cached_property
    def _seen(self) -> Array:
        """c at the random points and times, (times, points)."""
        return self._at(self._times)

    def _at(self, times: Array) -> Array:
        """c at the random points and any times (n,), (n, points)."""
        return self._value(self.x, self.y, times[:, None])

    def _value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        shape = np.broadcast_shapes(np.shape(x), np.shape(y), np.shape(t))
        return np.broadcast_to(np.asarray(self.wave.value(x, y, t, self.sheet.length)), shape)

    def check_period(self) -> None:
        """Raise ValueError where c does not repeat after its period."""
        if isinstance(self.wave, TravellingWave):
            return
        period, size = self.wave.period, abs(self._seen).max()
        apart = abs(self._at(self._times + period) - self._seen)
        i, j = np.unravel_index(apart.argmax(), apart.shape)
        if apart[i, j] > REPEATS * size:
            raise ValueError(
                f"period = {period:g}: c must repeat after it, but c(t) and c(t + period) differ by "
                f"{apart[i, j]:.3g} (largest |c| {size:.3g}) at {self._place(i, j)}; "
                "give the time after which the wave repeats"
            )

    def _check_rate(self) -> None:
        """At places where differences of value with several steps agree: elsewhere c has a kink."""
        quotients = np.stack([self._quotient(share * self.wave.period) for share in RATE_STEPS])
        rate = self.wave.rate(self.x, self.y, self._times[:, None], self.sheet.length)
        rate = np.broadcast_to(np.asarray(rate), quotients.shape[1:])
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


def waves_along(wave: Wave) -> int:
    """Waves on the body in which there is all but FEW of a TravellingWave; 1 of any other."""
    if not isinstance(wave, TravellingWave):
        return 1
    sizes = Spectrum(np.hypot(wave.cosine, wave.sine), 0.0)
    return int(wave.orders[int(sizes.highest(FEW)) - 1])


def _waves(degree: float) -> int:
    """Waves that polynomials up to a degree carry, pi of them each; 0 for inf."""
    return 0 if math.isinf(degree) else int(degree / math.pi)
