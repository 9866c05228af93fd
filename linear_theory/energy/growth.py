"""Power of growth over a period, and its work where growth cannot take work back.

    growth(t) = d(stored)/dt + spent(t).

Of a stiff sheet the first is far larger than the second, and changes sign: growth stretches the sheet,
and lets go. Two conventions count the work over a period:

* net: what is let go is taken back. The stored energy has no part in it.
* positive: what is let go is lost, the mean of max(0, growth(t)). Within the sheet energy passes freely
  from where growth takes it to where it gives it: the sheet as a whole has one source.

Powers are over mu times the weight W; stored energy comes with E h, so that their ratio is needed, the
strain that friction can give the sheet, s = mu W/(A E h) L: d(stored)/dt over mu W is L/s times that
over E h A.
"""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.estimate import Estimate
from linear_theory.common.shown import Shown, with_error
from linear_theory.energy.energy import Energy

Array = NDArray[np.float64]

TIMES = 256
"""At which the power of growth is followed."""


class _GrowthPower(NamedTuple):
    times: Array
    stored: Array
    spent: Array
    net: Estimate
    positive: Estimate


class GrowthPower(Shown, _GrowthPower):
    """Power of growth over mu times the weight, length/time, at equidistant times of a period.

    stored, spent (T,): its parts, see the module docstring; net: its mean; positive: the mean of its
    positive part, which counts where growth cannot take work back.
    """

    def _rows(self) -> Mapping[str, Any]:
        counts = {
            name: f"{with_error(*getattr(self, name))} length/time" for name in ("net", "positive")
        }
        return {**counts, "times": self.times, "stored": self.stored, "spent": self.spent}

    @property
    def values(self) -> Array:
        """The power, (T,)."""
        return np.asarray(self.stored + self.spent)

    @classmethod
    def of(
        cls, energy: Energy, times: Array, spent: Array, stored: Array, doubt: float
    ) -> "GrowthPower":
        """From courses at equidistant times (T,), T even; doubt: mean error of `stored`."""
        power = stored + spent
        lost = _mean_below(power)
        resolution = abs(lost - _mean_below(power[::2]))
        value = energy.power.value + lost
        error = energy.power.error + resolution + doubt
        return cls(times, stored, spent, energy.power, Estimate(value, error))


def growth_times(period: float) -> Array:
    """Times at which to follow the power of growth."""
    return period / TIMES * np.arange(float(TIMES))


def checked_strain(friction_strain: object) -> float:
    """s > 0. Raises ValueError otherwise."""
    return validation.positive("friction_strain", friction_strain)


def _mean_below(values: Array) -> float:
    """Mean of max(0, -f) of a periodic function that is linear between its values."""
    a, b = values, np.roll(values, -1)
    below = (np.maximum(-a, 0) + np.maximum(-b, 0)) / 2
    turns = a * b < 0
    low, high = np.minimum(a, b)[turns], np.maximum(a, b)[turns]
    below[turns] = low**2 / (2 * (high - low))
    return float(below.mean())
