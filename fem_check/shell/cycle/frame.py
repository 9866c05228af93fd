"""The frame that moves and turns with a deforming sheet as a whole.

Its origin is the centre of mass (of the undeformed area), and its axes are rotated relative to those of
the reference by the rotation of the mean deformation gradient F over that area,

    tan(theta) = (F_yx - F_xy)/(F_xx + F_yy),

which brings F closest to the unit matrix. For small strains this is the frame of linear theory, with
zero mean displacement and zero mean of (du_y/dx - du_x/dy)/2. The supports of a static shape, in
contrast, fix a vertex and a slope, and so rotate with the local deformation.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.cycle.shapes import Shapes, harmonics, time_factors
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.heading import moments
from linear_theory.common.shown import Shown
from linear_theory.motion.rigid import centre_and_gyration
from linear_theory.speed.path import Poses

Array = NDArray[np.float64]


def gyration(discretisation: Discretisation) -> float:
    """Radius of gyration of the undeformed area about its centre of mass, units of length."""
    region = discretisation.interior
    return centre_and_gyration(region.reference[0, :2], region.measure)[1]


def poses(discretisation: Discretisation, times: Array, states: Array) -> Poses:
    """Poses of the frame at the times (n,) of consecutive states (n, size)."""
    x, y, along, across = moments(discretisation, states).T
    return Poses(times, np.stack([x, y]), np.unwrap(np.arctan2(across, along)))


@dataclass(frozen=True, eq=False)
class BodyFrame(Shown):
    """The frame of a cycle of shapes.

    moments: (2K + 1, 4), harmonics in time of the means (see the function `moments`); period: of the
        wave.
    """

    moments: Array
    period: float

    @classmethod
    def of(cls, shapes: Shapes) -> "BodyFrame":
        """The frame from all phases, as the means are linear in the shape."""
        return cls(harmonics(moments(shapes.discretisation, shapes.states)), shapes.scene.period)

    def seen(self, times: Array, place: Array, velocity: Array) -> tuple[Array, Array]:
        """Positions and velocities (2, T, points) at times (T,), transformed to the frame."""
        values, slopes = time_factors(times, self.period, len(self.moments) // 2)
        x, y, along, across = (values @ self.moments).T[:, :, None]
        x_rate, y_rate, along_rate, across_rate = (slopes @ self.moments).T[:, :, None]
        size = np.hypot(along, across)
        cosine, sine = along / size, across / size
        spin = (along * across_rate - across * along_rate) / size**2
        x, y = place[0] - x, place[1] - y
        v_x, v_y = velocity[0] - x_rate + spin * y, velocity[1] - y_rate - spin * x
        return (
            np.stack([cosine * x + sine * y, cosine * y - sine * x]),
            np.stack([cosine * v_x + sine * v_y, cosine * v_y - sine * v_x]),
        )
