"""The depth to which a sheet sinks into its ground before growth."""

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.model import ShellModel

Array = NDArray[np.float64]


def laid_down(model: ShellModel) -> Array:
    """Unknowns (size,) of the undeformed sheet, lowered to where the ground carries its weight.

    On uneven ground it follows the height at every point. Without ground it is not moved.
    """
    ground, gravity = model.find(Ground), model.find(Gravity)
    if ground is None:
        return model.discretisation.zeros()
    depth, height = np.sqrt(gravity.weight / ground.stiffness), ground.height

    def jets(x: Array, y: Array) -> Array:
        out = np.zeros((6, 3, x.size))
        if height is not None:  # derivatives in the order x, y, xx, yy, xy, as for a surface
            out[:, 2] = height(x, y)
        out[0, 2] -= depth
        return out

    return model.discretisation.interpolate(jets)
