"""How large a rigid motion is: sideways, along and turning, in one unit.

The motion is that of the centre of mass of the undeformed area and a rotation Omega about it, which
moves the points of the sheet with the root mean square Omega g, g the radius of gyration of that area
about that centre; of a rectangle, g^2 = (W^2 + L^2)/12. With it a motion has the size

    |V| = (V_x^2 + V_y^2 + (g Omega)^2)^(1/2),

the root mean square of the velocities of all points. Tolerances are shares of that size: what V_y is
next to V_x depends on how the axes lie, and where a wave runs along x it is 0.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common.tolerance import Tolerance

Array = NDArray[np.float64]


def centre_and_gyration(place: Array, weights: Array) -> tuple[Array, float]:
    """Centre of mass (2,) of an area and its radius of gyration about it, units of length.

    place: (2, n) points of the area, weights: (n,) of a quadrature. The sums are about one of the
    points and then about the centre, so that nothing cancels where the area is far from the origin.
    """
    shares, origin = weights / weights.sum(), place[:, :1]
    centre = origin[:, 0] + (place - origin) @ shares
    return centre, float(np.sqrt(((place - centre[:, None]) ** 2).sum(0) @ shares))


@dataclass(frozen=True)
class RigidNorm:
    """Size of the motions of a sheet; of mirror symmetric ones V_y alone counts.

    gyration: radius of gyration, units of length.
    """

    gyration: float
    mirrored: bool

    def speeds(self, motion: ArrayLike) -> Array:
        """V_x, V_y, g Omega of a motion V_x, V_y, Omega (3, ...), or V_y alone, (1, ...)."""
        v_x, v_y, omega = np.asarray(motion, float)
        return np.stack([v_y] if self.mirrored else [v_x, v_y, self.gyration * omega])

    def size(self, motion: ArrayLike) -> float:
        """|V| of one motion (3,)."""
        return float(np.hypot.reduce(self.speeds(motion)))

    def each(self, speed: float) -> Array:
        """V_x, V_y and Omega that have that size each, (3,); 0 where symmetry makes them 0."""
        return speed * np.array([0.0, 1.0, 0.0] if self.mirrored else [1.0, 1.0, 1 / self.gyration])

    def allowed(self, mean: ArrayLike, tolerance: Tolerance) -> float:
        """The error that a mean motion (3,) may have."""
        return tolerance.allowed(self.size(mean))

    def meets(self, mean: ArrayLike, error: ArrayLike, tolerance: Tolerance) -> bool:
        """Whether errors (3,) of a mean motion (3,) are within the tolerance."""
        return self.size(error) <= self.allowed(mean, tolerance)
