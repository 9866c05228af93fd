"""Times at which a periodic wave is looked at."""

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def phases(period: float, count: int) -> Array:
    """Times in [0, period), ascending, (count,), at which errors are estimated: evenly, on no grid.

    Multiples of the golden section: no harmonic has the same value at all of them, and a front that
    travels lies on the lines of a mesh at no two.
    """
    return period * np.sort(np.arange(1, count + 1) * (math.sqrt(5) - 1) / 2 % 1)
