"""The rotation of a deformed sheet as a whole, and its centre."""

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.kinematics.discretisation import Discretisation

Array = NDArray[np.float64]


def moments(discretisation: Discretisation, states: Array) -> Array:
    """Means of x, y, F_xx + F_yy and F_yx - F_xy for states (n, size), (n, 4).

    By quadrature over the whole sheet.
    """
    region = discretisation.interior
    mass = region.measure / region.measure.sum()
    found = []
    for state in states:
        place, along_x, along_y = region.position(state, (0, 1, 2))[:, :2] @ mass
        found.append([*place, along_x[0] + along_y[1], along_x[1] - along_y[0]])
    return np.array(found)


def heading(discretisation: Discretisation, state: Array) -> float:
    """Rotation of the mean deformation gradient of a state (size,), anticlockwise, radians."""
    _, _, along, across = moments(discretisation, state[None])[0]
    return float(np.arctan2(across, along))
