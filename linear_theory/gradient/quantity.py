"""What is differentiated: a linear function of the rigid motion and of the work of friction."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Quantity(NamedTuple):
    """rigid . (V_x, V_y, Omega) + work times the rate of work of friction, all per unit alpha.

    The rate of work is per load at rest, as p_0 + alpha p_1 of `Balance.works`: a speed.
    """

    rigid: tuple[float, float, float]
    work: float = 0.0


ACROSS = Quantity((1.0, 0.0, 0.0))
"""V_x."""

ALONG = Quantity((0.0, 1.0, 0.0))
"""V_y."""

WORK = Quantity((0.0, 0.0, 0.0), 1.0)
"""The rate of work of friction."""
