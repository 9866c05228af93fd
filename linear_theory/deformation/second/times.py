"""The time dependence of the second-order displacement u_2: a sum of functions of time times fields.

A wave c(y, t) has few harmonics, and u_2 has twice as many (`Series`); for any other wave the fields
are u_2 and du_2/dt themselves at the requested times (`AtTimes`).
"""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.load_cases import Harmonics, LoadCases, Snapshots
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]

SAMPLES = 16
"""Phases at which the error of u_2 is estimated, per period of its highest harmonic."""


class FirstOrder(Protocol):
    """The part of u_1 needed here: the amplitudes of its load cases at given times."""

    def _amplitudes(self, t: Array) -> Array: ...

    def _amplitude_rates(self, t: Array) -> Array: ...


class Source(Protocol):
    """A quadratic source of second order at given times."""

    def moments(self, times: Array, amplitudes: Array) -> Array:
        """Its moments at times (T,), (T, ...); amplitudes: of the load cases, (cases, T)."""

    def moment_rates(self, times: Array, amplitudes: Array, rates: Array) -> Array:
        """Time derivatives of `moments`; rates: of the amplitudes."""


class SecondTimes(Protocol):
    """Functions of time, and the sources that belong to them."""

    @property
    def phases(self) -> Array:
        """Times that cover a period, (phases,)."""

    def factors(self, t: Array) -> Array:
        """Amplitudes of the basis of u_2, (basis, *t.shape)."""

    def rates(self, t: Array) -> Array:
        """Time derivatives of `factors`."""

    def serve(self, t: Array) -> bool:
        """Whether the basis spans the motion at times t."""

    def moments(self, source: Source, first: FirstOrder) -> Array:
        """Moments of the source of each basis function, as for `RitzSolver.solve_stress`."""


def second_times(cases: LoadCases) -> SecondTimes:
    """The time dependence that matches the load cases of first order."""
    return Series(cases.series) if isinstance(cases, Harmonics) else AtTimes(cases)


class Series:
    """1, cosines and sines of the harmonics of u_2; even harmonics only if c(t + T/2) = -c(t)."""

    def __init__(self, wave: TravellingWave) -> None:
        step = 2 if wave.is_half_period_antisymmetric else 1
        self.period = wave.period
        self.highest = 2 * int(wave.harmonics[-1])
        self.harmonics = np.arange(step, self.highest + 1, step)

    @property
    def phases(self) -> Array:
        """Equidistant phases, SAMPLES per period of the highest harmonic."""
        return np.linspace(0, self.period, SAMPLES * self.highest, endpoint=False)

    def factors(self, t: Array) -> Array:
        """(2 harmonics + 1, *t.shape)."""
        angle = np.multiply.outer(2 * np.pi / self.period * self.harmonics, t)
        return np.concatenate([np.ones((1, *t.shape)), np.cos(angle), np.sin(angle)])

    def rates(self, t: Array) -> Array:
        """Time derivatives of `factors`."""
        frequency = 2 * np.pi / self.period * self.harmonics
        angle = np.multiply.outer(frequency, t)
        frequency = frequency.reshape(-1, *(1,) * t.ndim)
        parts = [np.zeros((1, *t.shape)), -frequency * np.sin(angle), frequency * np.cos(angle)]
        return np.concatenate(parts)

    def serve(self, t: Array) -> bool:
        """Always."""
        return True

    def moments(self, source: Source, first: FirstOrder) -> Array:
        """Moments from 4K + 1 phases, which resolve harmonics up to 2K."""
        times = np.linspace(0, self.period, 2 * self.highest + 1, endpoint=False)
        samples = source.moments(times, first._amplitudes(times))
        spectrum = np.fft.rfft(samples, axis=0) / len(samples)
        some = spectrum[self.harmonics]
        return np.concatenate([spectrum[:1].real, 2 * some.real, -2 * some.imag])


class AtTimes:
    """u_2 at given times, then du_2/dt at these times; every factor is 0 or 1."""

    def __init__(self, cases: Snapshots) -> None:
        self.cases = cases

    @property
    def phases(self) -> Array:
        """The times themselves."""
        return self.cases.times

    def factors(self, t: Array) -> Array:
        """(2 times, *t.shape); t must be among the times."""
        return self.cases.amplitudes(t)

    def rates(self, t: Array) -> Array:
        """Likewise."""
        return self.cases.rates(t)

    def serve(self, t: Array) -> bool:
        """Whether t are the given times."""
        return np.array_equal(np.unique(t), self.cases.times)

    def moments(self, source: Source, first: FirstOrder) -> Array:
        """Moments of P, then of dP/dt."""
        t = self.cases.times
        amplitudes, rates = first._amplitudes(t), first._amplitude_rates(t)
        return np.concatenate(
            [source.moments(t, amplitudes), source.moment_rates(t, amplitudes, rates)]
        )
