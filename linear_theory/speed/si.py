"""Results in SI units: the theory knows only the sheet's length L and the wave's period T."""

from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.shown import Value

Number = TypeVar("Number", float, NDArray[np.float64])


@dataclass(frozen=True)
class Scale(Value):
    """Scales in SI units: L = `length_m` metres, the length of the sheet, T = `period_s` seconds.

    Its methods take numbers and arrays in L and T. Raises ValueError unless both are finite and
    positive.

    >>> from linear_theory import Scale, Sheet, SineWave, crawl_speed
    >>> scale = Scale(length_m=0.04, period_s=8.0)
    >>> speed = crawl_speed(Sheet(), SineWave(), alpha=0.12, rtol=1e-3)
    >>> print(f"{1000 * scale.speed(speed.mean):.3f} mm/s")
    0.134 mm/s
    """

    length_m: float
    period_s: float

    def __post_init__(self) -> None:
        for name in ("length_m", "period_s"):
            object.__setattr__(self, name, validation.positive(name, getattr(self, name)))

    def length(self, length: Number) -> Number:
        """A length in L, in metres."""
        return length * self.length_m

    def time(self, time: Number) -> Number:
        """A time in T, in seconds."""
        return time * self.period_s

    def speed(self, speed: Number) -> Number:
        """A speed in L/T, in metres per second."""
        return speed * (self.length_m / self.period_s)


def speed_si(speed: Number, length_m: float, period_s: float) -> Number:
    """A speed in L/T (number or array), in m/s, for a sheet of `length_m` and a wave of `period_s`.

    Raises ValueError unless both are finite and positive.

    >>> from linear_theory import speed_si
    >>> print(f"{speed_si(0.05, length_m=0.02, period_s=0.5) * 1000:.3g} mm/s")
    2 mm/s
    """
    return Scale(length_m, period_s).speed(speed)
