"""A travelling wave of which any number is on the sheet, whole or not."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.common.shown import Value
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.places import Places
from linear_theory.wave.protocol import Wave
from linear_theory.wave.sampled import SampledDrive
from linear_theory.wave.spectrum import Spectrum
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]


@dataclass(frozen=True)
class FractionalWave(Value):
    """c = f(2 pi (count y/L - t/T)) with the profile f and the period T of a travelling wave.

    profile: that wave, whose own count is without effect; count: waves on the sheet, any real number
    but 0 (negative runs towards -y). Where it is whole, a `TravellingWave` gives the same at less cost.
    Raises ValueError for anything else.

    >>> from linear_theory import FractionalWave, SineWave
    >>> wave = FractionalWave(SineWave(), count=1.5)
    >>> print(wave.value(x=0.0, y=[0.0, 0.5], t=0.0).round(6))  # sin(1.5 pi) at the end
    [ 0. -1.]
    """

    profile: TravellingWave
    count: float

    def __post_init__(self) -> None:
        validation.instance("profile", self.profile, TravellingWave)
        count = validation.real("count", self.count)
        if count == 0 or abs(count) > validation.MOST_WAVES:
            most = validation.MOST_WAVES
            raise ValueError(f"count = {count:g}: must be from -{most} to {most}, and not 0")
        object.__setattr__(self, "count", count)

    @property
    def period(self) -> float:
        """Units of time."""
        return self.profile.period

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """c, the common shape of x, y, t; y in the unit of `length`."""
        return self.profile.profile(self._phase(x, y, t, length))

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """dc/dt, likewise."""
        slope = self.profile.profile_slope(self._phase(x, y, t, length))
        return np.asarray(-2 * np.pi / self.period * slope)

    def on(self, sheet: Sheet, places: Places | None = None) -> "FractionalDrive":
        """The wave on a body within that rectangle."""
        return FractionalDrive(self, sheet, places)

    def _phase(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float) -> Array:
        named = ("x", x), ("y", y), ("t", t)
        _, y, t = np.broadcast_arrays(*(validation.real_array(name, v) for name, v in named))
        return np.asarray(2 * np.pi * (self.count * y / length - t / self.period))


class FractionalDrive(SampledDrive):
    """A fractional wave on a body: its symmetries and its spectrum in time are known exactly."""

    wave: FractionalWave
    mirrored = True

    def _contents(self) -> Mapping[str, Any]:
        return {"wave": self.wave, "sheet": self.sheet}

    @cached_property
    def changes_sign(self) -> bool:
        """Whether c(t + T/2) = -c(t)."""
        return self.wave.profile.is_half_period_antisymmetric

    @property
    def reversal_time(self) -> float | None:
        """t_0 with c(-y, t_0 - t) = c(y, t), if the profile has one."""
        return self.wave.profile.reversal_time

    @cached_property
    def depends_on_x(self) -> bool:
        """Never."""
        return False

    @cached_property
    def rates(self) -> Spectrum:
        """Spectrum of dc/dt in time: root mean squares of the harmonics, 1/time."""
        own = self.wave.profile
        return Spectrum(np.hypot(own.cosine, own.sine) / np.sqrt(2), 0.0).of_rates(self.period)


def profile_of(wave: Wave) -> TravellingWave | None:
    """The profile of a travelling wave, of which a whole or any number is on the sheet; None for other
    waves.

    >>> from linear_theory import FractionalWave, SineWave
    >>> print(profile_of(FractionalWave(SineWave(), 1.5)) == SineWave() == profile_of(SineWave()))
    True
    """
    if isinstance(wave, FractionalWave):
        return wave.profile
    return wave if isinstance(wave, TravellingWave) else None


def count_of(wave: Wave) -> float:
    """How many waves are on the sheet. Raises ValueError for a wave that does not travel."""
    if not isinstance(wave, FractionalWave | TravellingWave):
        raise ValueError(f"wave = {validation.shown(wave)}: must be a TravellingWave or FractionalWave")
    return float(wave.count)


def with_profile(wave: Wave, profile: TravellingWave) -> Wave:
    """The travelling wave with another profile, as many on the sheet as before if it is fractional."""
    return FractionalWave(profile, wave.count) if isinstance(wave, FractionalWave) else profile
