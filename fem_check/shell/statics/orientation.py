"""Detection of local inversion of the sheet.

Koiter's energy depends only on metric and curvature and does not detect a point where the sheet is
folded over. In the plane the sign of the determinant of the deformation gradient shows it. In space a
sheet may turn over as a whole, so each state is compared with the previous one: in one step no normal
may rotate by a right angle or more.
"""

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.kinematics.point_state import PointState, dot
from fem_check.shell.kinematics.region import Region

Array = NDArray[np.float64]

SMALLEST_AREA = 1e-3
"""Smallest ratio of deformed to undeformed area: below it the sheet is about to invert."""


class Orientation:
    """Directors a_1 x a_2 over the undeformed area, at all points of a region."""

    def __init__(self, region: Region) -> None:
        self._region = region
        a11, a22, a12 = region.metric
        self._scale = 1 / np.sqrt(a11 * a22 - a12**2)

    def directors(self, u: Array, shape: PointState | None = None) -> Array:
        """Directors (3, points); in the plane the deformation gradient's determinant, (1, points).

        shape: that of the region at u, if it is known.
        """
        shape = PointState(self._region, u, (1, 2)) if shape is None else shape
        return np.asarray(shape.director * self._scale)

    def keeps(self, before: Array, after: Array) -> bool:
        """Whether no point is inverted between two states given by their directors."""
        if not np.all(np.isfinite(after)):
            return False
        size = np.sqrt(dot(after, after))
        aligned = dot(before, after) if len(before) == 3 else after[0]
        return bool(np.all(size > SMALLEST_AREA) and np.all(aligned > 0))
