"""The frame that moves and turns with a deforming sheet as a whole.

Its origin is the centre of mass (of the undeformed area) and its axes are turned against those of the
reference by the angle that brings the reference closest to the shape in the least squares sense,

    tan(theta) = int X x x dA / int X . x dA,    X, x from the centres of mass.

For small strains that is the frame of zero mean displacement and zero mean rotation. The supports of a
static shape fix some vertex and hold some slope, and so turn with the shape of the sheet there.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.cycle.shapes import Shapes, time_factors

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class BodyFrame:
    """The frame of a cycle of shapes.

    moments: (2K + 1, 4), harmonics in time of the mean of x (2), of X . x and of X x x; period: of
    the wave.
    """

    moments: Array
    period: float

    @classmethod
    def of(cls, shapes: Shapes) -> "BodyFrame":
        """From the whole sheet, at the quadrature points of its elements."""
        region = shapes.discretisation.interior
        mass = region.measure / region.measure.sum()
        place = region.reference[0, :2]
        arm = (place - (place @ mass)[:, None]) * mass
        weights = np.zeros((4, 2, mass.size))
        weights[0, 0] = weights[1, 1] = mass
        weights[2], weights[3] = arm, np.stack([-arm[1], arm[0]])
        fields = np.stack([region.displacement(u, (0,))[0, :2] for u in shapes.harmonics])
        fields[0] += place
        return cls(np.einsum("hcp,wcp->hw", fields, weights), shapes.scene.period)

    def seen(self, times: Array, place: Array, velocity: Array) -> tuple[Array, Array]:
        """Positions and velocities (2, T, points) at times (T,) as seen in the frame."""
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
