"""The growth fields for which the elastic problem is solved, and the wave as their superposition.

    c(x, y, t) = sum_j amplitude_j(t) growth_j(x, y)

For waves that are Fourier series in y and t a few growth fields serve all times (`Harmonics`); for any
other wave the fields are c and dc/dt themselves at the requested times (`Snapshots`).
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from linear_theory.wave.phases import phases
from linear_theory.wave.protocol import Drive
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]

SAMPLES = 16
"""Phases at which the error for a general wave is estimated."""

MOST_TIMES = 512
"""Largest number of different times of a general wave in one call."""

BLOCK = 1 << 16
"""Points times times for which a wave is asked in one call: few enough to stay in the cache."""


class Harmonics:
    """cos(2 pi r y/L) and sin(2 pi r y/L) of all harmonics, and 1 if the wave has a mean."""

    def __init__(self, series: TravellingWave, length: float) -> None:
        self.series, self.length = series, length

    def amplitudes(self, t: Array) -> Array:
        """Of c, (cases, *t.shape)."""
        return self._with_mean(*self.series.factors(t), self.series.mean)

    def rates(self, t: Array) -> Array:
        """Of dc/dt, (cases, *t.shape)."""
        return self._with_mean(*self.series.factor_rates(t), 0.0)

    def growths(self, x: Array, y: Array) -> Array:
        """Growth of each case, (cases, *broadcast(x, y).shape)."""
        _, y = np.broadcast_arrays(x, y)
        angle = np.multiply.outer(2 * np.pi / self.length * self.series.orders, y)
        return self._with_mean(np.cos(angle), np.sin(angle), 1.0)

    def samples(self) -> Array:
        """Amplitudes at 8 phases per period of the highest harmonic, 256 at most, (cases, phases)."""
        count = max(SAMPLES, min(8 * len(self.series.orders), 256))
        return self.amplitudes(phases(self.series.period, count))

    def at(self, t: Array) -> "Harmonics":
        """The same object: the cases serve all times."""
        return self

    def _with_mean(self, even: Array, odd: Array, value: float) -> Array:
        last = [np.full((1, *even.shape[1:]), value)] if self.series.mean else []
        return np.concatenate([even, odd, *last])


class Snapshots:
    """c at each of the times, then dc/dt at each; every amplitude is 0 or 1.

    times: (T,), all different.
    """

    def __init__(self, drive: Drive, times: Array) -> None:
        self.drive, self.times = drive, times

    def amplitudes(self, t: Array) -> Array:
        """Of c, (2 T, *t.shape); t must be among the times."""
        picked = self._picked(t)
        return np.concatenate([picked, np.zeros_like(picked)])

    def rates(self, t: Array) -> Array:
        """Of dc/dt, (2 T, *t.shape); t must be among the times."""
        picked = self._picked(t)
        return np.concatenate([np.zeros_like(picked), picked])

    def growths(self, x: Array, y: Array) -> Array:
        """Growth of each case, (2 T, *broadcast(x, y).shape)."""
        return np.concatenate([self.values(x, y), self._at_times(self.drive.rate, x, y)])

    def values(self, x: Array, y: Array) -> Array:
        """c at each of the times, (T, *broadcast(x, y).shape), without the costly rates."""
        return self._at_times(self.drive.value, x, y)

    def samples(self) -> Array:
        """Amplitudes at the times, (2 T, T)."""
        return self.amplitudes(self.times)

    def at(self, t: Array) -> "Snapshots":
        """The snapshots at these times. Raises ValueError if there are too many."""
        times = np.unique(t)
        if times.size > MOST_TIMES:
            raise ValueError(f"t has {times.size} different times: must be <= {MOST_TIMES} in one call")
        return Snapshots(self.drive, times)

    def _at_times(self, function: Callable[[Array, Array, Array], Array], x: Array, y: Array) -> Array:
        """A function at all of the times, (T, *broadcast(x, y).shape), of several in one call."""
        points = np.broadcast(x, y)
        times = self.times.reshape(-1, *(1,) * points.ndim)
        step = max(1, BLOCK // max(points.size, 1))
        return np.concatenate([function(x, y, times[i : i + step]) for i in range(0, len(times), step)])

    def _picked(self, t: Array) -> Array:
        return np.asarray(self.times.reshape(-1, *(1,) * t.ndim) == t, float)


LoadCases = Harmonics | Snapshots
"""Growth fields and their amplitudes."""


def load_cases(drive: Drive) -> LoadCases:
    """The load cases of a wave on a sheet."""
    if drive.series is not None:
        return Harmonics(drive.series, drive.sheet.length)
    return Snapshots(drive, phases(drive.period, SAMPLES))


def mixed_norms(parts: Array, amplitudes: Array) -> Array:
    """Euclidean norms of sum_j amplitudes[j] parts[j], (times,), for parts (cases, ...)."""
    flat = parts.reshape(len(parts), -1)
    square = np.einsum("jt,jk,kt->t", amplitudes, flat @ flat.T, amplitudes)
    return np.asarray(np.sqrt(np.maximum(square, 0.0)))
