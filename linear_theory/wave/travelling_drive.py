"""The drive of a travelling wave, known exactly from the series."""

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
"""Phases per harmonic at which the largest growth is sought."""


class TravellingDrive(Drive):
    """A travelling wave on a body; returned by `TravellingWave.on`."""

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
        """t_0 with c(-y, t_0 - t) = c(y, t), if the series has one."""
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
        """Spectrum of dc/dt in time: root mean squares of the harmonics, 1/time."""
        return Spectrum(self._amplitudes / math.sqrt(2), 0.0).of_rates(self.period)

    @property
    def short_waves(self) -> tuple[int, int]:
        """1 across, and along the wave number of the shortest harmonic whose rate exceeds FAINT."""
        rates = self.series.harmonics * self._amplitudes
        return 1, int(self.series.orders[rates >= FAINT * rates.max()][-1])

    @property
    def waves_along(self) -> int:
        """Wave number along the body up to which all of c but FEW is resolved."""
        highest = Spectrum(self._amplitudes, 0.0).highest(FEW)
        return int(self.series.orders[int(highest) - 1])

    def growths(self, x: Array, y: Array) -> Array:
        """c at equidistant phases; every point goes through all of them."""
        wave, count = self.series, PHASES * self.series.cosine.size
        spectrum = np.concatenate([[2 * wave.mean], wave.cosine - 1j * wave.sine]) * (count / 2)
        return np.fft.irfft(spectrum, count)

    def check_period(self) -> None:
        """Nothing to check: the series is periodic."""

    @property
    def _amplitudes(self) -> Array:
        """Amplitudes of the harmonics, (harmonics,)."""
        return np.hypot(self.series.cosine, self.series.sine)
