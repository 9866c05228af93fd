"""Travelling waves of growth c(y, t).

Every wave here is periodic along the sheet, a finite Fourier series in y/L:

    c(y, t) = mean + sum_k [ p_k cos(k phi) + q_k sin(k phi) ],   phi = 2 pi (n y/L - t/T),

with n = `count` waves on the sheet. Splitting the sums into parts even and odd in y separates y from t,
as a linear theory requires: one elastic problem for each of cos(2 pi r y/L) and sin(2 pi r y/L),
r = |k n|, times a factor that depends on t alone.

Sign convention: n > 0 runs towards +y. The printed amplitudes of the paper (appendix A.1,
a_r = delta_1r cos wt, b_s = delta_1s sin wt) belong to cos(2 pi y/L - wt), not to this sine.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.common.shown import Shown, Value
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.places import Places
from linear_theory.wave.travelling_drive import TravellingDrive

Array = NDArray[np.float64]

EPS = float(np.finfo(float).eps)


class _Factors(NamedTuple):
    even: Array
    odd: Array


class TimeFactors(Shown, _Factors):
    """Coefficients of cos(2 pi r y/L) and of sin(2 pi r y/L), each (harmonics, *t.shape)."""


@dataclass(frozen=True, eq=False)
class TravellingWave(Value):
    """c = mean + sum_k cosine[k-1] cos(k phi) + sine[k-1] sin(k phi), phi as in the module docstring.

    cosine, sine: (harmonics,) dimensionless amplitudes; count: waves on the sheet, any non-zero
    integer (negative runs towards -y); period in units of time. Raises ValueError otherwise.
    Amplitudes and a mean below 2.2e-16 of the largest amplitude are set to 0, and zero harmonics at the
    end are dropped: they are lost in the rounding of c, but would require fine meshes and break
    symmetries.

    Waves with the same amplitudes, mean, count and period are equal, also a SineWave and the
        TravellingWave with this single harmonic.

    >>> from linear_theory import TravellingWave
    >>> pulse = TravellingWave(cosine=[1.0, 0.5], sine=[0.0, 0.0])
    >>> print(pulse.value(x=0.0, y=[0.0, 0.5], t=0.0).round(12))
    [ 1.5 -0.5]
    >>> print(pulse.is_half_period_antisymmetric)  # if it were, V would be of order alpha^2
    False
    """

    cosine: Array
    sine: Array
    count: int = 1
    period: float = 1.0
    mean: float = 0.0

    def __post_init__(self) -> None:
        cosine, sine = (validation.real_array(name, getattr(self, name)) for name in ("cosine", "sine"))
        if cosine.ndim != 1 or cosine.shape != sine.shape or not cosine.size:
            raise ValueError(
                f"cosine, sine have shapes {cosine.shape}, {sine.shape}: "
                "must be one-dimensional, of one length >= 1"
            )
        series = _Series(cosine, sine, validation.real("mean", self.mean))
        for name, value in zip(_Series._fields, series.rounded(EPS * series.largest), strict=True):
            object.__setattr__(self, name, value)
        object.__setattr__(self, "count", validation.wave_count(self.count))
        object.__setattr__(self, "period", validation.positive("period", self.period))

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        for array in (self.cosine, self.sine):
            array.setflags(write=False)  # unpickled arrays are writeable

    def __eq__(self, other: object) -> bool:
        return self._key == other._key if isinstance(other, TravellingWave) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._key)

    @property
    def _key(self) -> tuple[object, ...]:
        """All numbers of the wave."""
        return *self.cosine.tolist(), *self.sine.tolist(), self.count, self.period, self.mean

    @classmethod
    def from_samples(cls, samples: ArrayLike, count: int = 1, period: float = 1.0) -> "TravellingWave":
        """The wave whose profile takes `samples` at N equidistant phases phi = 2 pi j/N.

        samples: (N,), N >= 3, over one full wavelength; interpolated trigonometrically. Amplitudes and
        a mean within rounding, up to 9e-16 of the largest sample, are dropped: a sampled sine gives
        exactly one harmonic.
        """
        values = validation.real_array("samples", samples)
        if values.ndim != 1 or values.size < 3:
            raise ValueError(f"samples has shape {values.shape}: must be (N,) with N >= 3")
        spectrum = np.fft.rfft(values) * (2 / values.size)
        if values.size % 2 == 0:  # the Nyquist term has no partner at negative frequency
            spectrum[-1] /= 2
        series = _Series(spectrum.real[1:], -spectrum.imag[1:], spectrum.real[0] / 2)
        cosine, sine, mean = series.rounded(_roundoff(values))
        return cls(cosine, sine, count, period, mean)

    @property
    def harmonics(self) -> NDArray[np.int64]:
        """Wave numbers k = 1, 2, ... of the profile, (harmonics,)."""
        return np.arange(1, self.cosine.size + 1)

    @property
    def orders(self) -> NDArray[np.int64]:
        """r = |k count|, the number of waves on the sheet for each harmonic, (harmonics,)."""
        return self.harmonics * abs(self.count)

    @property
    def moves(self) -> bool:
        """Whether growth changes in time."""
        return bool(np.any(self.cosine) or np.any(self.sine))

    @property
    def is_half_period_antisymmetric(self) -> bool:
        """Whether c(t + T/2) = -c(t): then there is no speed of first order in alpha."""
        return self.mean == 0 and not np.any(self.cosine[1::2]) and not np.any(self.sine[1::2])

    @property
    def reversal_time(self) -> float | None:
        """t_0 with c(-y, t_0 - t) = c(y, t), so that V(t_0 - t) = V(t); None if there is none."""
        if not np.any(self.sine):
            return 0.0
        if self.is_half_period_antisymmetric and not np.any(self.cosine):
            return self.period / 2
        return None

    @property
    def sine_amplitude(self) -> float | None:
        """a for a single sine, c = a sin(2 pi n y/L - 2 pi t/T + b), else None."""
        if self.mean != 0 or np.any(self.cosine[1:]) or np.any(self.sine[1:]):
            return None
        return float(np.hypot(self.cosine[0], self.sine[0]))

    def on(self, sheet: Sheet, places: Places | None = None) -> TravellingDrive:
        """The wave on a body of any outline within that rectangle, see `protocol.Drive`."""
        return TravellingDrive(self, sheet)

    def profile(self, phase: ArrayLike) -> Array:
        """The profile f(phi) in c = f(2 pi (n y/L - t/T)), same shape as `phase` (radians)."""
        k, cosine, sine = self._present
        angle = np.multiply.outer(k, validation.real_array("phase", phase))
        value = np.tensordot(cosine, np.cos(angle), 1) + np.tensordot(sine, np.sin(angle), 1)
        return np.asarray(self.mean + value)

    def profile_slope(self, phase: ArrayLike) -> Array:
        """Slope df/dphi of the profile, same shape as `phase` (radians)."""
        k, cosine, sine = self._present
        angle = np.multiply.outer(k, validation.real_array("phase", phase))
        return np.asarray(
            np.tensordot(k * sine, np.cos(angle), 1) - np.tensordot(k * cosine, np.sin(angle), 1)
        )

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """c at points of a sheet of that `length`; x, y, t broadcast (c does not depend on x)."""
        return self._on_points(self.profile, x, y, t, length)

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """dc/dt at points of a sheet of that `length`; x, y, t broadcast."""
        return -2 * np.pi / self.period * self._on_points(self.profile_slope, x, y, t, length)

    def factors(self, t: ArrayLike) -> TimeFactors:
        """even, odd in c = mean + sum_j even[j] cos(2 pi r_j y/L) + odd[j] sin(...), r = `orders`."""
        p, q, angle = self._phasors(t)
        even = p * np.cos(angle) - q * np.sin(angle)
        odd = p * np.sin(angle) + q * np.cos(angle)
        return TimeFactors(even, np.sign(self.count) * odd)

    def factor_rates(self, t: ArrayLike) -> TimeFactors:
        """Time derivatives of `factors`."""
        p, q, angle = self._phasors(t)
        shape = (-1,) + (1,) * (angle.ndim - 1)
        rate = (2 * np.pi / self.period * self.harmonics).reshape(shape)
        even = -rate * (p * np.sin(angle) + q * np.cos(angle))
        odd = rate * (p * np.cos(angle) - q * np.sin(angle))
        return TimeFactors(even, np.sign(self.count) * odd)

    def _on_points(
        self,
        function: Callable[[Array], Array],
        x: ArrayLike,
        y: ArrayLike,
        t: ArrayLike,
        length: float,
    ) -> Array:
        """A function of the phase at points; once for all x, on which no phase depends."""
        named = ("x", x), ("y", y), ("t", t)
        x, y, t = (validation.real_array(name, value) for name, value in named)
        shape = np.broadcast_shapes(x.shape, y.shape, t.shape)
        found = function(2 * np.pi * (self.count * y / length - t / self.period))
        return found if found.shape == shape else np.broadcast_to(found, shape).copy()

    @cached_property
    def _present(self) -> tuple[NDArray[np.int64], Array, Array]:
        """Wave numbers and amplitudes of the non-zero harmonics."""
        some = (self.cosine != 0) | (self.sine != 0)
        return self.harmonics[some], self.cosine[some], self.sine[some]

    def _phasors(self, t: ArrayLike) -> tuple[Array, Array, Array]:
        t = validation.real_array("t", t)
        angle = np.multiply.outer(2 * np.pi / self.period * self.harmonics, t)
        shape = (-1,) + (1,) * t.ndim
        return self.cosine.reshape(shape), self.sine.reshape(shape), angle


class _Series(NamedTuple):
    """Amplitudes of cos k phi and sin k phi, (harmonics,) each, and the mean."""

    cosine: Array
    sine: Array
    mean: float

    @property
    def largest(self) -> float:
        """Largest amplitude."""
        return float(max(abs(self.cosine).max(), abs(self.sine).max()))

    def rounded(self, smallest: float) -> "_Series":
        """The series with terms up to `smallest` set to 0 and zero harmonics at the end dropped."""
        parts = [np.where(abs(part) > smallest, part, 0.0) for part in (self.cosine, self.sine)]
        last = np.flatnonzero((parts[0] != 0) | (parts[1] != 0)).max(initial=0)
        cosine, sine = (part[: last + 1].copy() for part in parts)
        for part in (cosine, sine):
            part.setflags(write=False)
        return _Series(cosine, sine, self.mean if abs(self.mean) > smallest else 0.0)


def _roundoff(samples: Array) -> float:
    """Largest amplitudes due to the rounding of samples: 4 units in the last place of the largest.

    A sample has an error of half a unit, and of 2 more if it is a function of a phase rounded near
    2 pi; errors of the same sign everywhere would give an amplitude of that size. Measured for sines,
    cosines, their squares and sums at phases from 0 to 2 pi, N from 3 to 4096: up to 1.5 units.
    """
    return 4 * EPS * float(abs(samples).max())


@dataclass(frozen=True, eq=False)
class SineWave(TravellingWave):
    """c(y, t) = sin(2 pi count y/L - 2 pi t/period), the wave of the paper's section 3.1.

    count: any non-zero integer; count > 0 runs towards +y. period in units of time. Raises ValueError
    otherwise.

    >>> from linear_theory import SineWave
    >>> wave = SineWave(count=1, period=1.0)
    >>> print(wave.value(x=0.0, y=[0.25, 0.5], t=[0.0, 0.25]).round(12))  # the crest runs along +y
    [1. 1.]
    """

    cosine: Array = field(init=False)
    sine: Array = field(init=False)
    count: int = 1
    period: float = 1.0
    mean: float = field(default=0.0, init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "cosine", np.zeros(1))
        object.__setattr__(self, "sine", np.ones(1))
        super().__post_init__()

    def _contents(self) -> Mapping[str, Any]:
        return {"count": self.count, "period": self.period}
