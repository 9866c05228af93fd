"""The coefficient of friction that a rigid sheet feels: the mean of a map over its body."""

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.estimate import Estimate
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.maps import FixedTo, FrictionMap

Array = NDArray[np.float64]

PLAIN = Estimate(1.0, 0.0)
"""Of a law without a map."""

UNKNOWN = Estimate(np.nan, np.nan)
"""Of a map for which it has no value, or is not computed."""

COUNTS = 64, 256, 32
"""Intervals across, along, and in time if the map is kinetic."""


def mean_map(law: FrictionLaw, width: float, length: float, period: float) -> Estimate:
    """Mean of the map of a law over a rectangle around the origin, and over the period if kinetic.

    width 0 for a body on a line. NaN for a map on the ground: the friction of a sheet that is dragged
    over it depends on where it is. By trapezoids; the error is that of
    a jump within an interval, as far as values there bend, and at least the change from half as many.

    >>> from linear_theory import Coulomb, GivenMap, Mapped
    >>> front = Mapped(Coulomb(), GivenMap(lambda x, y: 1 + (y > 0.25)))
    >>> mean = mean_map(front, width=0.25, length=1.0, period=1.0)
    >>> print(f"{mean.value:.2f}", abs(mean.value - 1.25) <= mean.error < 0.01)
    1.25 True
    """
    found = law.map
    if found is None:
        return PLAIN
    if found.fixed_to is FixedTo.GROUND:
        return UNKNOWN
    counts = COUNTS if found.kinetic else (*COUNTS[:2], 1)
    finest, coarse = (
        _values(found, width, length, period, tuple(max(n // k, 1) for n in counts)) for k in (1, 2)
    )
    missed = sum(_bends(finest, axis) / (4 * n) for axis, n in enumerate(counts))
    change = abs(_mean(coarse) - _mean(finest))
    return Estimate(_mean(finest), float(max(change, missed)))


def _values(
    found: FrictionMap, width: float, length: float, period: float, counts: tuple[int, ...]
) -> Array:
    """At the ends of so many intervals across, along and in time."""
    x, y, t = (np.linspace(0, 1, n + 1) for n in counts)
    place = width * (x[:, None] - 0.5), length * (y - 0.5)
    shape = x.size, y.size
    times = [np.broadcast_to(found.values(*place, period * float(s)), shape) for s in t]
    return np.stack(times, axis=-1)


def _mean(values: Array) -> float:
    """By trapezoids along each axis."""
    for _ in range(values.ndim):
        values = (values[:-1] + values[1:]).mean(0) / 2
    return float(values)


def _bends(values: Array, axis: int) -> float:
    """Sum of the sizes of second differences along an axis, mean over the others: twice a jump."""
    return float(abs(np.diff(values, 2, axis)).sum(axis).mean())
