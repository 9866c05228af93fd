"""Channels of the values of a balance at a point, and moments about the centre."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

VELOCITY, AREA, RATE, ARMS = slice(0, 2), 2, 3, slice(4, 6)
"""v_x, v_y, area, e; x, y from the centre if the sheet may turn; then v_2 and u if there are any."""


def moment(arms: Array, force: Sequence[Array] | Array) -> Array:
    """x f_y - y f_x, for arms and forces (2, ...)."""
    return np.asarray(arms[0] * force[1] - arms[1] * force[0])
