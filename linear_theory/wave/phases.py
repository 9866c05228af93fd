"""Times at which a periodic wave is sampled."""

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def phases(period: float, count: int) -> Array:
    """Ascending times in [0, period), (count,), for error estimates: evenly distributed, not a grid.

    Multiples of the golden ratio: no harmonic has the same value at all of them, and a travelling front
    lies on a mesh line at one of them at most.
    """
    return period * np.sort(np.arange(1, count + 1) * (math.sqrt(5) - 1) / 2 % 1)
