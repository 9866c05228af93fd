"""Results in SI units: the theory knows only the sheet's length L and the wave's period T."""

from dataclasses import dataclass
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.shown import Shown, Value
from linear_theory.speed.result import POWERED, CrawlSpeed


class _EnergySI(NamedTuple):
    power_w: float
    work_j: float
    cost_of_transport: float


class EnergySI(Shown, _EnergySI):
    """Net power of growth in watts, its work per period in joules, and that per weight and distance,
    J/(N m), a number."""


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

    def energy(self, speed: CrawlSpeed, weight_n: float, friction: float) -> EnergySI:
        """Power, work per period and cost of transport of a speed in L/T.

        weight_n: weight of the undeformed sheet, newtons; friction: its coefficient mu. Raises
        ValueError unless both are finite and positive, and for a speed whose energy is not known.

        >>> from linear_theory import Scale, Sheet, SineWave, crawl_speed
        >>> speed = crawl_speed(Sheet(), SineWave(), alpha=0.12, rtol=1e-3)
        >>> used = Scale(length_m=0.04, period_s=8.0).energy(speed, weight_n=2e-3, friction=0.4)
        >>> print(f"{1e9 * used.power_w:.0f} nW, {used.cost_of_transport:.2f} J/(N m)")
        431 nW, 1.61 J/(N m)
        """
        force = validation.positive("weight_n", weight_n) * validation.positive("friction", friction)
        if speed.energy is None:
            raise ValueError(f"speed: has no known power, {POWERED}")
        power = force * self.speed(speed.power.value)
        cost = friction * speed.cost_of_transport.value
        return EnergySI(power, power * self.period_s, cost)


def speed_si(speed: Number, length_m: float, period_s: float) -> Number:
    """A speed in L/T (number or array), in m/s, for a sheet of `length_m` and a wave of `period_s`.

    Raises ValueError unless both are finite and positive.

    >>> from linear_theory import speed_si
    >>> print(f"{speed_si(0.05, length_m=0.02, period_s=0.5) * 1000:.3g} mm/s")
    2 mm/s
    """
    return Scale(length_m, period_s).speed(speed)
