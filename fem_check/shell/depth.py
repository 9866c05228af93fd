"""How deep a sheet lies in its ground before it grows."""

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.model import ShellModel

Array = NDArray[np.float64]


def laid_down(model: ShellModel) -> Array:
    """Unknowns (size,) of the undeformed sheet, lowered on its ground to where that carries the weight.

    On uneven ground it follows the height at every point. Without ground: where it was made.
    """
    ground, gravity = model.find(Ground), model.find(Gravity)
    if ground is None:
        return model.discretisation.zeros()
    depth, height = np.sqrt(gravity.weight / ground.stiffness), ground.height

    def jets(x: Array, y: Array) -> Array:
        out = np.zeros((6, 3, x.size))
        if height is not None:  # its derivatives come as x, y, xx, yy, xy, as those of a surface do
            out[:, 2] = height(x, y)
        out[0, 2] -= depth
        return out

    return model.discretisation.interpolate(jets)
