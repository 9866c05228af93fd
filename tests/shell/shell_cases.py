"""Problems of thin shells with known answers, and helpers of the shell tests.

The problems of the validation page are used as they are: figures/validation/problems.
"""

import numpy as np
from numpy.typing import NDArray

from figures.validation.problems.plates import clamped_plate
from figures.validation.problems.sheets import (
    ELEMENTS,
    Path,
    affine,
    at,
    displacement,
    koiter,
    linear_response,
    loaded,
    rectangle,
    shell,
)
from figures.validation.problems.shells import (
    end_moment,
    end_shear,
    scordelis_lo,
    semi_cylinder,
    slit_annulus,
)

__all__ = [
    "ELEMENTS",
    "Path",
    "affine",
    "at",
    "clamped_plate",
    "displacement",
    "end_moment",
    "end_shear",
    "koiter",
    "linear_response",
    "loaded",
    "rectangle",
    "scordelis_lo",
    "semi_cylinder",
    "shell",
    "slit_annulus",
]

Array = NDArray[np.float64]


def trapezoid(xi1: Array, xi2: Array) -> Array:
    """A flat `Surface`, 0.5 wide at xi_2 = -1/2 and 0.8 at 1/2: its parameter lines are oblique."""
    slope = 0.3
    width = 0.65 + slope * xi2
    jet = np.zeros((6, 3, *xi1.shape))
    jet[0, 0], jet[0, 1] = xi1 * width, xi2
    jet[1, 0] = width
    jet[2, 0], jet[2, 1] = xi1 * slope, 1
    jet[5, 0] = slope
    return jet
