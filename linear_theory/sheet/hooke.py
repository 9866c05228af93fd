"""Isotropic plane stress with growth, per unit alpha and Young modulus 1.

The strain is the elastic one plus alpha c times the identity (plane stress), not (1 + nu) alpha c
as eq. 10b of the paper prints: that is the plane-strain form and contradicts its eq. 14.
Symmetric tensors have their components (xx, yy, xy) on the first axis.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def strain(stress: Array, growth: Array, poisson: float) -> Array:
    """Strain (xx, yy, xy) for a stress (3, ...) and growth c (...)."""
    xx, yy, xy = stress
    return np.stack([xx - poisson * yy + growth, yy - poisson * xx + growth, (1 + poisson) * xy])


def stress(strain: Array, growth: Array, poisson: float) -> Array:
    """Stress (xx, yy, xy) for a strain (3, ...) and growth c (...)."""
    xx, yy = strain[0] - growth, strain[1] - growth
    modulus = 1 / (1 - poisson**2)
    return np.stack(
        [modulus * (xx + poisson * yy), modulus * (yy + poisson * xx), strain[2] / (1 + poisson)]
    )
