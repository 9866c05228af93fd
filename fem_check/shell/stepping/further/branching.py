"""Whether a sheet could have taken another way, so that only a further run tells its error.

The forward gait of the paper, dry, on flat ground, takes 48 steps a cycle to V = 0.109 and 64 or
more to 0.121, each with errors of its steps of 0.003: the steps themselves do not show it.
"""

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.model import ShellModel
from linear_theory.friction.regime import regime_of

Array = NDArray[np.float64]

DECISIVE = "buckled", "snapped", "fastest"
"""Columns of the record that tell."""


def may_branch(model: ShellModel, buckled: Array, snapped: Array, fastest: Array) -> bool:
    """Whether another way was open to a sheet in steps with these columns of the record, (n,) each.

    Where it jumps; and where negative curvature was met, if the sheet has inertia, since long steps
    damp vibrations by which it would leave a shape that is not stable, or friction is not viscous,
    since what holds the sheet then depends on the way that it came. A sheet in the plane has one shape.
    """
    if np.any(snapped):
        return True
    if model.planar or not np.any(buckled):
        return False
    return model.heavy or _holds(model, float(fastest.max()))


def _holds(model: ShellModel, fastest: float) -> bool:
    """Whether friction can hold a part of a sheet whose fastest point has that speed."""
    law = model.scene.contact.friction
    return law.regularised and regime_of(law.slip_ratio(fastest)) != "viscous"
