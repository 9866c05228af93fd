"""The drive of a travelling wave: all of it known from the series."""

import math
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.protocol import FAINT, FEW, Drive
from linear_theory.wave.spectrum import Spectrum

if TYPE_CHECKING:
    from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]

PHASES = 256
"""Phases per harmonic at which the largest growth is looked for."""


class TravellingDrive(Drive):
    """A travelling wave on a body; made by `TravellingWave.on`."""

    series: "TravellingWave"
    mirrored = True

    def __init__(self, wave: "TravellingWave", sheet: Sheet) -> None:
        super().__init__(wave, sheet)
        self.series = wave

    @property
    def changes_sign(self) -> bool:
        """Whether c(t + T/2) = -c(t)."""
        return self.series.is_half_period_antisymmetric

    @property
    def reversal_time(self) -> float | None:
        """t_0 with c(-y, t_0 - t) = c(y, t), where the series has one."""
        return self.series.reversal_time

    @property
    def depends_on_x(self) -> bool:
        """Never."""
        return False

    @cached_property
    def size(self) -> float:
        """Root mean square of c."""
        wave = self.series
        return math.sqrt(wave.mean**2 + np.sum(wave.cosine**2 + wave.sine**2) / 2)

    @cached_property
    def rates(self) -> Spectrum:
        """Root mean squares of the harmonics in time of dc/dt, per time."""
        return Spectrum(self._amplitudes / math.sqrt(2), 0.0).of_rates(self.period)

    @property
    def short_waves(self) -> tuple[int, int]:
        """1, and that of the shortest harmonic whose rate is not FAINT."""
        rates = self.series.harmonics * self._amplitudes
        return 1, int(self.series.orders[rates >= FAINT * rates.max()][-1])

    @property
    def waves_along(self) -> int:
        """Waves along the body in which there is all but FEW of c."""
        highest = Spectrum(self._amplitudes, 0.0).highest(FEW)
        return int(self.series.orders[int(highest) - 1])

    def growths(self, x: Array, y: Array) -> Array:
        """c at phases, all of which are seen at any point."""
        wave, count = self.series, PHASES * self.series.cosine.size
        spectrum = np.concatenate([[2 * wave.mean], wave.cosine - 1j * wave.sine]) * (count / 2)
        return np.fft.irfft(spectrum, count)

    def check_period(self) -> None:
        """Nothing to check: the series repeats."""

    @property
    def _amplitudes(self) -> Array:
        """Of the harmonics, (harmonics,)."""
        return np.hypot(self.series.cosine, self.series.sine)
