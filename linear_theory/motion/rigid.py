"""The size of a rigid motion: sideways, along and turning, in one unit.

The motion is that of the centre of mass of the undeformed area and a rotation Omega about it, which
gives the points of the sheet the root-mean-square velocity Omega g, with g the radius of gyration of
that area about that centre (for a rectangle, g^2 = (W^2 + L^2)/12). The size of a motion is

    |V| = (V_x^2 + V_y^2 + (g Omega)^2)^(1/2),

the root mean square of the velocities of all points. Tolerances are relative to that size: the ratio of
V_y to V_x depends on the orientation of the axes, and V_y is 0 for a wave along x.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common.tolerance import Tolerance

Array = NDArray[np.float64]


def centre_and_gyration(place: Array, weights: Array) -> tuple[Array, float]:
    """Centre of mass (2,) of an area and its radius of gyration about it, units of length.

    place: (2, n) points of the area, weights: (n,) quadrature weights. The sums are taken about one of
    the points and then about the centre, to avoid cancellation for an area far from the origin.
    """
    shares, origin = weights / weights.sum(), place[:, :1]
    centre = origin[:, 0] + (place - origin) @ shares
    return centre, float(np.sqrt(((place - centre[:, None]) ** 2).sum(0) @ shares))


@dataclass(frozen=True)
class RigidNorm:
    """Norm of the rigid motions of a sheet; for mirror-symmetric motions V_y alone.

    gyration: radius of gyration, units of length.
    """

    gyration: float
    mirrored: bool

    def speeds(self, motion: ArrayLike) -> Array:
        """V_x, V_y, g Omega for motions V_x, V_y, Omega (3, ...), or V_y alone, (1, ...)."""
        v_x, v_y, omega = np.asarray(motion, float)
        return np.stack([v_y] if self.mirrored else [v_x, v_y, self.gyration * omega])

    def size(self, motion: ArrayLike) -> float:
        """The norm |V| of one motion (3,)."""
        return float(np.hypot.reduce(self.speeds(motion)))

    def each(self, speed: float) -> Array:
        """V_x, V_y and Omega of that size each, (3,); 0 where they vanish by symmetry."""
        return speed * np.array([0.0, 1.0, 0.0] if self.mirrored else [1.0, 1.0, 1 / self.gyration])

    def allowed(self, mean: ArrayLike, tolerance: Tolerance) -> float:
        """Largest admissible error of a mean motion (3,)."""
        return tolerance.allowed(self.size(mean))

    def meets(self, mean: ArrayLike, error: ArrayLike, tolerance: Tolerance) -> bool:
        """Whether the errors (3,) of a mean motion (3,) meet the tolerance."""
        return self.size(error) <= self.allowed(mean, tolerance)
